"""AND on degrees that come with their complements (Table 3, and the T-norms of the Open Level).

`a` and `1 - a` are each known to their own digits, and so are those of the
result: where a + b is near 1, BDIF is the difference of the smaller degree and
the other's complement, and 1 minus a product is a sum of positive numbers. OR is AND of the
complements, by de Morgan's law, which holds for every pair of norms.
"""

from fcl_sim.arithmetic.operators import maximum, minimum
from fcl_sim.jit import flat, inlined

AND_MIN, AND_PROD, AND_BDIF, AND_HPROD, AND_EPROD, AND_DPROD, AND_NMIN = range(-2, -9, -1)
"""The operators, as in postfix code (engine.program)."""


@inlined
def conjunction(operator: int, a: float, not_a: float, b: float, not_b: float) -> tuple[float, float]:
    """Return AND of two degrees, and its complement."""
    if operator == AND_MIN:
        return minimum(a, b), maximum(not_a, not_b)
    if operator == AND_PROD:
        return a * b, minimum(1.0, not_a + a * not_b)
    if operator != AND_BDIF:
        return open_conjunction(operator, a, not_a, b, not_b)
    difference = a - not_b if a < b else b - not_a
    return maximum(0.0, difference), minimum(1.0, not_a + not_b)


@flat
def open_conjunction(operator: int, a: float, not_a: float, b: float, not_b: float) -> tuple[float, float]:
    """Return AND by a T-norm of the Open Level, and its complement.

    a + b - a b is taken as a + b (1 - a), and 2 minus that as 1 + (1 - a) (1 - b).
    """
    if operator == AND_HPROD:
        either = a + b * not_a
        if either == 0.0:
            return 0.0, 1.0
        return minimum(1.0, b * (a / either)), minimum(1.0, (a * not_b + b * not_a) / either)
    if operator == AND_EPROD:
        bound = 1.0 + not_a * not_b
        return minimum(1.0, a * b / bound), minimum(1.0, (not_a + not_b) / bound)
    smaller = minimum(a, b), maximum(not_a, not_b)
    if operator == AND_DPROD:
        return smaller if minimum(not_a, not_b) == 0.0 else (0.0, 1.0)
    above = a > not_b if a < b else b > not_a
    return smaller if above else (0.0, 1.0)


@flat
def disjunction(operator: int, a: float, b: float) -> float:
    """Return OR of two degrees by the S-norm of the T-norm `operator`, from rounded complements."""
    return conjunction(operator, 1.0 - a, a, 1.0 - b, b)[1]
