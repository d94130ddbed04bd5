"""The manual's example of a valve (pp. 33 to 35), at every pressure and temperature.

The text joins rules 2 and 4 by AND, the diagrams by OR. INT is held against
the same kernels on binary64.
"""

import numpy as np
import pytest

from fcl_sim import concept
from fcl_sim.arithmetic.integer import ROUND, TRUNCATE
from fcl_sim.concept.aterm import aterm_int, aterm_real
from fcl_sim.concept.defuz import defuz_int, defuz_real
from fcl_sim.concept.operators import max_int, max_real, min_int, min_real
from fcl_sim.jit import F, I, compiled, entry, flat, i8, signature, void

PRESSURES = np.array([0, 3900, 4000, 4100])
TEMPERATURES = np.array([0, 5000, 6500, 8000, 9500])
CLOSED, NEARLY_CLOSED, NEARLY_OPEN, OPEN = 0, 3333, 6667, 10_000

STRIDE = 1 if compiled() else 101
"""Every point; uncompiled, one of a hundred."""


@flat
def valve_int(pressure, temperature, disjunction, rounding, p, t, low, mid, pair, out, defuzzed, y):  # noqa: PLR0917
    p[0] = pressure
    t[0] = temperature
    aterm_int(p, 3, low, rounding)
    aterm_int(t, 4, mid, rounding)
    for place, (of_p, of_t, extreme) in enumerate(((2, 3, True), (1, 2, False), (1, 1, False), (0, 0, True))):
        pair[0] = low[of_p]
        pair[1] = mid[of_t]
        if extreme and disjunction:
            max_int(pair, 2, out, rounding)
        else:
            min_int(pair, 2, out, rounding)
        defuzzed[1 + 2 * place] = out[0]
    defuz_int(defuzzed, 8, y, rounding)


@flat
def valve_real(pressure, temperature, disjunction, p, t, low, mid, pair, out, defuzzed, y):  # noqa: PLR0917
    p[0] = pressure
    t[0] = temperature
    aterm_real(p, 3, low)
    aterm_real(t, 4, mid)
    for place, (of_p, of_t, extreme) in enumerate(((2, 3, True), (1, 2, False), (1, 1, False), (0, 0, True))):
        pair[0] = low[of_p]
        pair[1] = mid[of_t]
        if extreme and disjunction:
            max_real(pair, 2, out)
        else:
            min_real(pair, 2, out)
        defuzzed[1 + 2 * place] = out[0]
    defuz_real(defuzzed, 8, y)


@entry(signature(void, i8, i8, i8, *[I] * 8, *[F] * 8, F))
def compare(  # noqa: PLR0917
    disjunction, rounding, stride,
    p, t, low, mid, pair, out, defuzzed, y,
    rp, rt, rlow, rmid, rpair, rout, rdefuzzed, ry,
    found,
):  # fmt: skip
    """Write how many points were compared, how many have no rule, the largest and the summed difference."""
    points = without = 0
    largest = summed = 0.0
    for index in range(0, 301 * 4701, stride):
        pressure = 3850 + index // 4701
        temperature = 4900 + index % 4701
        valve_int(pressure, temperature, disjunction, rounding, p, t, low, mid, pair, out, defuzzed, y)
        valve_real(pressure, temperature, disjunction, rp, rt, rlow, rmid, rpair, rout, rdefuzzed, ry)
        none = True
        for place in range(4):
            none = none and defuzzed[1 + 2 * place] == 0
        points += 1
        if none:
            without += 1
        else:
            difference = abs(y[0] - ry[0])
            summed += difference
            largest = max(largest, difference)
    found[0] = points
    found[1] = without
    found[2] = largest
    found[3] = summed


def buffers(dtype):
    defuzzed = np.array([0, 0, CLOSED, 0, NEARLY_CLOSED, 0, NEARLY_OPEN, 0, OPEN])
    places = (
        PRESSURES,
        TEMPERATURES,
        np.zeros(9),
        np.zeros(9),
        np.zeros(2),
        np.zeros(1),
        defuzzed,
        np.zeros(1),
    )
    return tuple(each.astype(dtype) for each in places)


@pytest.mark.parametrize(
    ("disjunction", "rounding", "largest", "mean", "without"),
    [
        (True, TRUNCATE, 1.202, 0.326, 0),
        (True, ROUND, 0.811, 0.196, 0),
        (False, TRUNCATE, 19.375, 0.205, 336_502),
        (False, ROUND, 9.688, 0.131, 336_502),
    ],
    ids=["OR truncated", "OR rounded", "AND truncated", "AND rounded"],
)
def test_int_differs_from_real_by_no_more_than_its_divisions_make(
    disjunction, rounding, largest, mean, without
):
    found = np.zeros(4)
    compare(int(disjunction), rounding, STRIDE, *buffers(np.int64), *buffers(np.float64), found)
    points, no_rule, most, summed = found
    if STRIDE == 1:
        assert points == 1_415_001
        assert no_rule == without
        assert most == pytest.approx(largest, abs=0.0005000001)
    assert most <= largest + 0.0005000001
    assert summed / (points - no_rule) == pytest.approx(mean, abs=0.0005 if STRIDE == 1 else 0.01)
    assert no_rule / points == pytest.approx(without / 1_415_001, abs=0.01)


class Valve:
    """The blocks of p. 34 and p. 35, wired in Python, in one arithmetic."""

    def __init__(self, number, disjunction):
        def of(name, **values):
            return getattr(concept, f"{name}_{number}")(**values)

        self.press = of("FUZ_ATERM", S1=3900, S2=4000, S3=4100)
        self.temp = of("FUZ_ATERM", S1=5000, S2=6500, S3=8000, S4=9500)
        outer = "FUZ_MAX" if disjunction else "FUZ_MIN"
        self.rules = [of("FUZ_MIN"), of(outer), of("FUZ_MIN"), of(outer)]
        self.valve = of(
            "DEFUZ", ZERO_Y=False, MDiSi2=CLOSED, MDiSi4=NEARLY_CLOSED, MDiSi6=NEARLY_OPEN, MDiSi8=OPEN
        )

    def __call__(self, pressure, temperature):
        press, temp = self.press, self.temp
        press(X=pressure)
        temp(X=temperature)
        nearly_closed, closed, nearly_open, opened = self.rules
        nearly_closed(IN1=press.MD2, IN2=temp.MD3)
        closed(IN1=press.MD3, IN2=temp.MD4)
        nearly_open(IN1=press.MD2, IN2=temp.MD2)
        opened(IN1=press.MD1, IN2=temp.MD1)
        self.valve(MDiSi1=closed.OUT, MDiSi3=nearly_closed.OUT, MDiSi5=nearly_open.OUT, MDiSi7=opened.OUT)
        return self.valve.Y


GOLDEN = [
    ((4000, 6500), 6667, 6667),
    ((4000, 7250), 5000, 5000),
    ((4050, 7250), 3333, 5000),
    ((3950, 5750), 8333, 8333),
    ((4100, 9500), 0, 0),
    ((4025, 8200), 2499, 2830),
    ((3900, 9500), 5000, 0),
]


@pytest.mark.parametrize(("point", "by_or", "by_and"), GOLDEN)
def test_the_golden_points_hold_in_both_readings(point, by_or, by_and):
    assert Valve("INT", disjunction=True)(*point) == by_or
    assert Valve("INT", disjunction=False)(*point) == by_and


@pytest.mark.parametrize(("point", "by_or", "by_and"), GOLDEN)
def test_real_blocks_give_the_example_to_the_roundings_of_int(point, by_or, by_and):
    assert Valve("REAL", disjunction=True)(*point) == pytest.approx(by_or, abs=1.21)
    assert Valve("REAL", disjunction=False)(*point) == pytest.approx(by_and, abs=1.21)


def test_where_the_text_has_no_rule_the_last_output_is_held():
    valve = Valve("INT", disjunction=False)
    assert valve(4025, 8200) == 2830
    assert valve(3900, 9500) == 2830
    assert valve.valve.ENO
