"""Hedges on degrees that come with their complements (Open Level).

`a` and `1 - a` are each known to their own digits, and so are those of the
result: 1 - a² is (1 - a) (1 + a), and 1 - √a is (1 - a) / (1 + √a).
"""

from fcl_sim.arithmetic.functions import sqrt
from fcl_sim.jit import flat

VERY, EXTREMELY, SOMEWHAT, SELDOM = range(-17, -21, -1)
"""The hedges that change a degree, as in postfix code (engine.program)."""


@flat
def hedged(hedge: int, a: float, not_a: float) -> tuple[float, float]:
    """Return what a hedge makes of a degree, and the complement of that."""
    if hedge == VERY:
        return a * a, not_a * (1.0 + a)
    if hedge == EXTREMELY:
        low, high = 2.0 * a * a, 2.0 * not_a * not_a
        return (low, 1.0 - low) if a <= not_a else (1.0 - high, high)
    root = sqrt(a)
    if hedge == SOMEWHAT:
        return root, not_a / (1.0 + root)
    low, high = sqrt(0.5 * a), sqrt(0.5 * not_a)
    return (low, 1.0 - low) if a <= not_a else (1.0 - high, high)
