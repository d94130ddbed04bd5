"""Whether two function blocks give the same where runs went, and where they differ most."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from fcl_sim.concept.function_block import IntegerInstance
from fcl_sim.loop.diagram import FuzzyNode
from fcl_sim.loop.trace import FuzzyRecord, Values
from fcl_sim.model import FunctionBlock
from fcl_sim.verify.places import all_places

SAME = 1e-9
"""Up to which share of an output's range two numbers count as the same."""

DIGITS = 6
"""Significant digits with which inputs are told."""


@dataclass(frozen=True, eq=False, slots=True)
class Visits:
    """Where a fuzzy block was in a run: `inputs` (n, inputs), `previous` (n, outputs) what NC would keep.

    `given` is what the block gives there in its arithmetic. `law` (n, outputs) is
    the same without the rounding of REAL: one unit in the last place of binary32
    is no other law.
    """

    inputs: Values
    previous: Values
    given: "Given"
    law: Values


@dataclass(frozen=True, eq=False, slots=True)
class Given:
    """Outputs (n, outputs) of a block, and whether by a rule."""

    outputs: Values
    active: NDArray[np.bool_]

    def same(self, other: "Given") -> bool:
        """Return whether not a bit differs, and no rule is active for an output in one of them alone."""
        equal = np.array_equal(self.outputs, other.outputs, equal_nan=True)
        return equal and np.array_equal(self.active, other.active)


@dataclass(frozen=True, slots=True, kw_only=True)
class Difference:
    """Where two blocks differ most: at `inputs` in `output`, `before` and `after`, a `share` of its range.

    `same` says that they differ in nothing anywhere, not in a bit of what their arithmetic gives.
    """

    inputs: Mapping[str, float]
    output: str
    before: float
    after: float
    share: float
    same: bool


def visits(node: FuzzyNode, record: FuzzyRecord) -> Visits:
    """Return where a block was in a run, and what it gives there when it is asked once more.

    Scan by scan the previous outputs are those of the run: two blocks that give
    the same from there give the same run.
    """
    program = node.program
    initial = program.initial[program.outputs_at : program.active_at].astype(np.float64)
    previous = np.vstack([initial, record.outputs])[: len(record.outputs)]
    given = _given(node, record.inputs, previous)
    return Visits(record.inputs, previous, given, _law(node, record.inputs, previous, given))


def difference(original: FuzzyNode, other: FuzzyNode, visited: Visits) -> Difference:
    """Return where another block of the same inputs and outputs differs most from the one that was visited.

    Of equal shares the first visit counts. An output that one of them alone
    cannot compute differs by infinity. The inputs are told with `DIGITS` digits
    where that shows the same difference.
    """
    given = _given(other, visited.inputs, visited.previous)
    law = _law(other, visited.inputs, visited.previous, given)
    shares = _shares(original, visited.law, law)
    if not shares.size:
        return Difference(inputs={}, output="", before=0.0, after=0.0, share=0.0, same=True)
    at, column = divmod(int(np.argmax(shares)), shares.shape[1])
    share = float(shares[at, column])
    spot = _Spot(visited.inputs[at], float(visited.law[at, column]), float(law[at, column]), share)
    if 0.0 < share < np.inf:
        spot = _rounded(original, other, spot, visited.previous[at : at + 1], column)
    return Difference(
        inputs=dict(zip(original.program.input_names, spot.inputs.tolist(), strict=True)),
        output=original.program.output_names[column],
        before=spot.before,
        after=spot.after,
        share=spot.share,
        same=given.same(visited.given),
    )


@dataclass(frozen=True, slots=True)
class _Spot:
    inputs: Values
    before: float
    after: float
    share: float


def _rounded(original: FuzzyNode, other: FuzzyNode, spot: _Spot, previous: Values, column: int) -> _Spot:
    """Return a spot with inputs of few digits, if the difference there is as good as the same."""
    inputs = np.array([[float(f"{each:.{DIGITS}g}") for each in spot.inputs]])
    before, after = (_law(each, inputs, previous) for each in (original, other))
    share = float(_shares(original, before, after)[0, column])
    if abs(share - spot.share) > 0.1 * spot.share:
        return spot
    return _Spot(inputs[0], float(before[0, column]), float(after[0, column]), share)


def _shares(node: FuzzyNode, before: Values, after: Values) -> Values:
    """Return by how much outputs (n, outputs) differ, as shares of their ranges."""
    with np.errstate(invalid="ignore"):
        shares: Values = np.abs(after - before) / _ranges(
            node.block.function_block, node.program.output_names
        )
    shares[np.isnan(after) & np.isnan(before)] = 0.0
    shares[np.isnan(shares)] = np.inf
    return shares


def _ranges(block: FunctionBlock, names: Sequence[str]) -> Values:
    """Return the width (outputs,) of each output's range, else that of its terms' places; 1 of a degree."""
    widths = dict.fromkeys((each.casefold() for each in names), 1.0)
    for output in block.defuzzifications:
        ends = output.range or all_places(output.terms)
        if ends:
            width = ends[-1] - ends[0]
            widths[output.variable.casefold()] = width if width > 0.0 else abs(ends[0]) or 1.0
    return np.array([widths[each.casefold()] for each in names])


def _given(node: FuzzyNode, inputs: Values, previous: Values) -> Given:
    """Return what a block gives from inputs (n, inputs) and previous outputs (n, outputs)."""
    if node.in_int:
        return _in_int(node, inputs, previous)
    names, outputs = node.program.input_names, node.program.output_names
    found = node.block.evaluation(
        dict(zip(names, inputs.T, strict=True)),
        dict(zip(outputs, previous.T, strict=True)),
        node.arithmetic,
    )
    shape = previous.shape
    return Given(
        np.stack([found.outputs[each] for each in outputs], axis=-1).reshape(shape),
        np.stack([found.active[each] for each in outputs], axis=-1).reshape(shape),
    )


def _law(node: FuzzyNode, inputs: Values, previous: Values, given: Given | None = None) -> Values:
    """Return outputs (n, outputs) without the rounding of REAL; in INT, as they are `given`."""
    if node.in_real:
        return _given(replace(node, arithmetic="LREAL"), inputs, previous).outputs
    return (given or _given(node, inputs, previous)).outputs


def _in_int(node: FuzzyNode, inputs: Values, previous: Values) -> Given:
    """Return the same in INT, visit by visit, since NC keeps what was; each different one once."""
    instance = node.integer_instance()
    keys, where = np.unique(np.hstack([inputs, previous]), axis=0, return_inverse=True)
    outputs = np.empty((len(keys), previous.shape[1]))
    active = np.zeros(outputs.shape, np.bool_)
    for at, key in enumerate(keys):
        outputs[at], active[at] = _once(instance, node, key[: inputs.shape[1]], key[inputs.shape[1] :])
    return Given(outputs[where.ravel()], active[where.ravel()])


def _once(
    instance: IntegerInstance, node: FuzzyNode, inputs: Values, previous: Values
) -> tuple[list[float], list[bool]]:
    names = node.program.output_names
    try:
        instance.resume(**dict(zip(names, previous.tolist(), strict=True)))
        instance(**dict(zip(node.program.input_names, inputs.tolist(), strict=True)))
    except (ValueError, OverflowError):
        return [np.nan] * len(names), [False] * len(names)
    return [instance.outputs[each] for each in names], [instance.active[each] for each in names]
