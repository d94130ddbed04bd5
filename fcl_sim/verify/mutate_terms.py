"""Mutants of terms: base points, smooth shapes, singletons."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from math import isfinite

from fcl_sim.fcl.write_numbers import number
from fcl_sim.model import (
    Curve,
    DataType,
    Defuzzification,
    Formula,
    FunctionBlock,
    Fuzzification,
    Point,
    Points,
    Shape,
    Singleton,
    Singletons,
    Term,
)
from fcl_sim.verify.mutant import Kind, Mutant
from fcl_sim.verify.places import PLACES, all_places, places_of

FRACTIONAL = frozenset((DataType.REAL, DataType.LREAL))

Changed = Iterator[tuple[str, Shape]]
"""What is changed in a shape, in words, and the shape then."""


def mutants_of_terms(block: FunctionBlock, share: float) -> Iterator[Mutant]:
    """Yield the mutants of each term, inputs first; whole places of variables of whole numbers stay so."""
    types = {each.name.casefold(): each.type for each in (*block.inputs, *block.outputs)}
    sections: tuple[Fuzzification | Defuzzification, ...]
    sections = (*block.fuzzifications, *block.defuzzifications)
    for section in sections:
        others = all_places(section.terms)
        whole = types[section.variable.casefold()] not in FRACTIONAL and all(
            place.is_integer() for place in others
        )
        for term in section.terms:
            kind, changes = _of_shape(term.shape, others, share, whole=whole)
            for what, shape in changes:
                yield Mutant(
                    kind=kind,
                    where=f"term {term.name} of {section.variable}",
                    what=what,
                    function_block=_with_term(block, section, term, replace(term, shape=shape)),
                    span=term.span,
                )


def _with_term(
    block: FunctionBlock, section: Fuzzification | Defuzzification, term: Term, changed: Term
) -> FunctionBlock:
    terms = tuple(changed if each is term else each for each in section.terms)
    return replace(
        block,
        fuzzifications=tuple(
            replace(each, terms=terms) if each is section else each for each in block.fuzzifications
        ),
        defuzzifications=tuple(
            replace(each, terms=terms) if each is section else each for each in block.defuzzifications
        ),
    )


def _of_shape(shape: Shape, others: Sequence[float], share: float, *, whole: bool) -> tuple[Kind, Changed]:
    """Return the kind of the changes of a shape, and these; `others` are the places of all terms."""
    own = places_of(shape)
    match shape:
        case Points(points) | Singletons(points):
            moves = _moves(own, own if len(own) > 1 else others, share, whole=whole)
            return Kind.BREAKPOINT_SHIFTED, _of_points(shape, points, moves)
        case Singleton():
            moves = _moves(own, others, share, whole=whole)
            return Kind.SINGLETON_SHIFTED, ((_told(old, new), Singleton(new)) for old, new in moves)
        case Curve():
            return Kind.CURVE_CHANGED, _of_curve(shape, others, share, whole=whole)
        case Formula():
            return Kind.SINGLETON_SHIFTED, iter(())


def _told(old: float, new: float) -> str:
    return f"{number(old)} → {number(new)}"


def _of_points(
    shape: Points | Singletons, points: Sequence[Point], moves: Iterator[tuple[float, float]]
) -> Changed:
    """Yield a shape with each of its breakpoints moved; the points of a vertical edge move together."""
    for old, new in moves:
        moved = tuple(replace(each, x=new) if each.x == old else each for each in points)
        yield _told(old, new), replace(shape, points=moved)


def _of_curve(curve: Curve, others: Sequence[float], share: float, *, whole: bool) -> Changed:
    places = PLACES[curve.kind]
    own = places_of(curve)

    def with_changed(old: float, new: float, at: Sequence[int]) -> Curve:
        parameters = tuple(
            new if index in at and each == old else each for index, each in enumerate(curve.parameters)
        )
        return replace(curve, parameters=parameters)

    for old, new in _moves(own, own if len(own) > 1 else others, share, whole=whole):
        yield f"place {_told(old, new)}", with_changed(old, new, places)
    for index, parameter in enumerate(curve.parameters):
        if index not in places and not isinstance(parameter, str):
            for factor in (1.0 - share, 1.0 + share):
                new = parameter * factor
                if new != parameter and isfinite(new):
                    what = f"parameter {index + 1}: {_told(parameter, new)}"
                    yield what, with_changed(parameter, new, (index,))


def _moves(
    places: Sequence[float], among: Sequence[float], share: float, *, whole: bool
) -> Iterator[tuple[float, float]]:
    """Yield each place with where it goes, each way: a share of the way to its neighbour `among` others.

    The outermost ones go as far outwards as inwards. One that stands alone goes
    by the share of its magnitude, or of 1 where it is 0.
    """
    for place in places:
        below = max((each for each in among if each < place), default=None)
        above = min((each for each in among if each > place), default=None)
        gaps = [abs(each - place) for each in (below, above) if each is not None] or [abs(place) or 1.0]
        for new in (place - share * gaps[0], place + share * gaps[-1]):
            moved = float(round(new)) if whole and isfinite(new) else new
            stays = (below is None or moved >= below) and (above is None or moved <= above)
            if moved != place and isfinite(moved) and stays:
                yield place, moved
