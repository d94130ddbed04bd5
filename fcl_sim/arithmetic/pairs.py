"""AND on degrees that come with their complements (Table 3).

`a` and `1 - a` are each known to their own digits, and so are those of the
result: where a + b is near 1, BDIF is the difference of the smaller degree and
the other's complement, and 1 minus a product is a sum of positive numbers. OR is AND of the
complements, by de Morgan's law, which holds for every pair of Table 3.
"""

from fcl_sim.arithmetic.operators import maximum, minimum
from fcl_sim.jit import inlined

AND_MIN, AND_PROD, AND_BDIF = range(-2, -5, -1)
"""The operators, as in postfix code (engine.program)."""


@inlined
def conjunction(operator: int, a: float, not_a: float, b: float, not_b: float) -> tuple[float, float]:
    """Return AND of two degrees, and its complement."""
    if operator == AND_MIN:
        return minimum(a, b), maximum(not_a, not_b)
    if operator == AND_PROD:
        return a * b, not_a + a * not_b
    difference = a - not_b if a < b else b - not_a
    return maximum(0.0, difference), minimum(1.0, not_a + not_b)
