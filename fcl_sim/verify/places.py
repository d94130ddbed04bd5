"""Where terms lie along the axis of their variable."""

from collections.abc import Iterable, Iterator, Sequence

from fcl_sim.model import Curve, CurveKind, Formula, Points, Shape, Singleton, Singletons, Term

PLACES = {
    CurveKind.GAUSSIAN: (0,),
    CurveKind.GAUSSIAN_PRODUCT: (0, 2),
    CurveKind.BELL: (2,),
    CurveKind.SIGMOID: (1,),
    CurveKind.SIGMOID_DIFFERENCE: (1, 3),
    CurveKind.SIGMOID_DISTANCE: (1, 3),
    CurveKind.SIGMOID_PRODUCT: (1, 3),
    CurveKind.COSINE: (1,),
    CurveKind.Z_SHAPE: (0, 1),
    CurveKind.S_SHAPE: (0, 1),
    CurveKind.PI_SHAPE: (0, 1, 2, 3),
    CurveKind.SPIKE: (0,),
    CurveKind.CONCAVE: (0, 1),
}
"""Which parameters of a curve are places on the axis; the others are widths and slopes."""


def places_of(shape: Shape) -> tuple[float, ...]:
    """Return the different places on the axis that a shape names as numbers, rising."""
    return tuple(sorted({each for each in _named(shape) if not isinstance(each, str)}))


def _named(shape: Shape) -> Iterator[float | str]:
    match shape:
        case Points(points) | Singletons(points):
            yield from (each.x for each in points)
        case Singleton(value):
            yield value
        case Curve(kind, parameters):
            yield from (parameters[each] for each in PLACES[kind])
        case Formula():
            return


def all_places(terms: Iterable[Term]) -> tuple[float, ...]:
    """Return the different places of several terms, rising."""
    return tuple(sorted({place for each in terms for place in places_of(each.shape)}))


def in_order(terms: Sequence[Term]) -> tuple[str, ...]:
    """Return the names of terms as they lie along the axis.

    A term lies where its degree is highest, or at the middle of its places if it
    is a curve. Where a place is not known as a number, the order is that of the text.
    """
    centres = [_centre(each.shape) for each in terms]
    known = [each for each in centres if each is not None]
    if len(known) < len(centres):
        return tuple(each.name for each in terms)
    by_place = sorted(zip(known, range(len(terms)), strict=True))
    return tuple(terms[at].name for _, at in by_place)


def _centre(shape: Shape) -> float | None:
    if any(isinstance(each, str) for each in _named(shape)):
        return None
    places = places_of(shape)
    if isinstance(shape, Points | Singletons):
        highest = max(each.degree for each in shape.points)
        places = tuple(float(each.x) for each in shape.points if each.degree == highest)
    return min(places) / 2 + max(places) / 2 if places else None
