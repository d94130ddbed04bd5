"""Counts of a quantity once more, in exact fractions."""

from fractions import Fraction
from math import trunc

from tests.loop.block_bench import Case


def counted(step, offset, whole):
    def law(samples, times, cycle):
        exact = [whole((Fraction(u) - Fraction(offset)) / Fraction(step)) for u in samples["input"]]
        return {
            "OUT": [min(max(each, -(2**15)), 2**15 - 1) for each in exact],
            "overflow": [float(not -(2**15) <= each < 2**15) for each in exact],
        }

    return law


CASES = [
    Case(
        block="to_int",
        inputs={"input": "wave"},
        parameters={"step": "0.5 m", "offset": "25 cm"},
        law=counted(0.5, 0.25, round),
    ),
    Case(
        block="to_int",
        inputs={"input": "-stairs"},
        parameters={"step": "2 m", "rounding": "truncate"},
        law=counted(2, 0, trunc),
    ),
    Case(
        block="to_int",
        inputs={"input": "ramp"},
        parameters={"step": f"{2.0**-14} m"},
        law=counted(Fraction(1, 2**14), 0, round),
    ),
]
