"""Linguistic terms and their membership functions (5.2.2, 5.2.3)."""

from dataclasses import dataclass, field

from fcl_sim.diagnostics import Span
from fcl_sim.model.curves import Curve
from fcl_sim.model.expressions import Expression


@dataclass(frozen=True, slots=True)
class Point:
    """A base point: abscissa `x`, in the unit of its variable, and degree in [0, 1].

    A text for `x` is the name of the input variable that moves it (figure 5).
    """

    x: float | str
    degree: float


@dataclass(frozen=True, slots=True)
class Points:
    """A piecewise linear membership function, constant outside its points.

    At least one point; constant abscissae never fall. Two points with one
    abscissa make a vertical edge.
    """

    points: tuple[Point, ...]


@dataclass(frozen=True, slots=True)
class Singleton:
    """A single value of an output (figure 6), or the name of the variable that holds it."""

    value: float | str


@dataclass(frozen=True, slots=True)
class Singletons:
    """Several single values (Open Level): the degree of each point at its abscissa, 0 elsewhere.

    An input's term that is a single value is one of these with the degree 1.
    """

    points: tuple[Point, ...]


@dataclass(frozen=True, slots=True)
class Formula:
    """A singleton of an output whose place is calculated at each evaluation (Open Level)."""

    expression: Expression


Shape = Points | Singleton | Singletons | Curve | Formula


@dataclass(frozen=True, slots=True)
class Term:
    """A linguistic term of a variable."""

    name: str
    shape: Shape
    span: Span | None = field(default=None, compare=False, repr=False)
