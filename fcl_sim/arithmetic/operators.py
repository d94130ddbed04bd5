"""Operators on degrees: Tables 3 and 5, and NOT (A.14)."""

from fcl_sim.jit import inlined


@inlined
def minimum(a: float, b: float) -> float:
    """Return AND by MIN, the smaller of two degrees."""
    return a if a < b else b  # noqa: FURB136  which of the two a NaN gives is written out


@inlined
def maximum(a: float, b: float) -> float:
    """Return OR by MAX, the larger of two degrees."""
    return a if a > b else b  # noqa: FURB136


@inlined
def clamped(a: float) -> float:
    """Return a number taken into [0, 1] (S27)."""
    return minimum(1.0, maximum(0.0, a))
