"""The numbers of a function block as a PLC compiles them: each rounded to the precision it has there."""

from collections.abc import Iterator
from dataclasses import fields, is_dataclass, replace
from math import inf
from typing import Any

from fcl_sim.diagnostics import Diagnostic, InputFault, Place, Span
from fcl_sim.engine.precision import LREAL, Precision
from fcl_sim.model import FunctionBlock


def narrowed(block: FunctionBlock, precision: Precision) -> FunctionBlock:
    """Return `block` with every number rounded.

    Raises InputFault, with every place, for numbers beyond the limit (FCL407).
    """
    if precision is LREAL:
        return block
    places = {span: Place(span) for span in _beyond(block, precision.limit, None) if span is not None}
    if any(True for _ in _beyond(block, precision.limit, None)):
        raise too_large(block, precision, tuple(places.values()))
    rounded: FunctionBlock = _rounded(block, precision)
    return rounded


def too_large(block: FunctionBlock, precision: Precision, places: tuple[Place, ...] = ()) -> InputFault:
    """Return the fault of a block that this arithmetic cannot carry."""
    if not places and block.span is not None:
        places = (Place(block.span),)
    return InputFault(
        [
            Diagnostic(
                code="FCL407",
                message=f"numbers of `{block.name}` exceed what {precision.name} can carry",
                places=places,
                hint=f"keep magnitudes below {precision.limit:g}, or evaluate in LREAL",
            )
        ]
    )


def _beyond(value: Any, limit: float, span: Span | None) -> Iterator[Span | None]:
    """Yield the place of every number beyond the limit: that of the innermost noun that has one."""
    if isinstance(value, float | int) and not isinstance(value, bool):
        if limit <= abs(value) < inf:
            yield span
    elif isinstance(value, tuple):
        for each in value:
            yield from _beyond(each, limit, span)
    elif is_dataclass(value):
        own = getattr(value, "span", None) or span
        for field in fields(value):
            if field.compare:
                yield from _beyond(getattr(value, field.name), limit, own)


def _rounded(value: Any, precision: Precision) -> Any:
    if isinstance(value, float | int) and not isinstance(value, bool):
        number = float(precision.dtype(value))
        return value if number == value else number
    if isinstance(value, tuple):
        return tuple(_rounded(each, precision) for each in value)
    if is_dataclass(value) and not isinstance(value, type):
        changed = {
            field.name: _rounded(getattr(value, field.name), precision)
            for field in fields(value)
            if field.compare
        }
        return replace(value, **changed)
    return value
