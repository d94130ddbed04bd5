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
def bounded_difference(a: float, b: float) -> float:
    """Return AND by BDIF, max(0, a + b - 1); 1 is taken from the larger, where that is exact."""
    return maximum(0.0, (maximum(a, b) - 1.0) + minimum(a, b))


@inlined
def algebraic_sum(a: float, b: float) -> float:
    """Return OR by ASUM, a + b - a b, written so that nothing cancels."""
    return a + b * (1.0 - a)


@inlined
def bounded_sum(a: float, b: float) -> float:
    """Return OR or accumulation by BSUM, min(1, a + b)."""
    return minimum(1.0, a + b)


@inlined
def clamped(a: float) -> float:
    """Return a number taken into [0, 1] (S27)."""
    return minimum(1.0, maximum(0.0, a))
