import copy
import gc
import sys
from decimal import Decimal
from fractions import Fraction
from math import inf, nan
from random import Random

import numpy as np
import pytest

from fcl_sim.engine.assemble import assemble
from fcl_sim.engine.instance import Instance
from fcl_sim.engine.precision import LREAL, REAL
from fcl_sim.jit import compiled
from fcl_sim.model import RuleBlock, Variable
from tests.engine.bases import CRANE, block, crane, every, output, points, rule, singleton

BAND = {"x": (points("low", (0, 1), (1, 0)), points("high", (2, 0), (3, 1)))}


def held(default=None, **initial):
    """Return an instance of a base that has no rule between 1 and 2."""
    base = block(
        BAND,
        (output("y", singleton("small", -1), singleton("big", 4), default=default),),
        RuleBlock(
            name="r",
            rules=(
                rule("1", every(("x", "low")), ("y", "small")),
                rule("2", every(("x", "high")), ("y", "big")),
            ),
        ),
        initial=initial,
    )
    return Instance(base, assemble(base))


def test_inputs_that_are_not_given_keep_their_value():
    instance = Instance(CRANE, assemble(CRANE))
    instance(distance=2.0, angle=3.0)
    once = instance.outputs
    instance(angle=1.0)
    assert instance.inputs == {"distance": 2.0, "angle": 1.0}
    assert instance.outputs != once
    instance(angle=3.0)
    assert instance.outputs == once


@pytest.mark.parametrize("precision", [LREAL, REAL], ids=lambda each: each.name)
def test_what_was_before_the_call_has_no_bearing_on_a_rule_base_without_memory(precision):
    program = assemble(CRANE, precision)
    instance, random = Instance(CRANE, program), Random(5)  # noqa: S311
    knots = [0.0, 5.0, 10.0, 22.0, -5.0, -50.0]
    distance, angle = 0.0, 0.0
    for step in range(2000):
        if step % 7 == 0:  # on a knot, or next to one
            knot = random.choice(knots)
            distance = float(
                np.nextafter(precision.dtype(knot), precision.dtype(random.choice((-99, knot, 99))))
            )
        else:  # mostly in the cell of the call before
            distance += random.uniform(-0.3, 0.3)
        angle = random.choice((angle, angle + random.uniform(-0.5, 0.5), random.uniform(-60.0, 60.0)))
        instance(distance=distance, angle=angle)
        fresh = Instance(CRANE, program)
        fresh(distance=distance, angle=angle)
        assert (instance.outputs, instance.degrees) == (fresh.outputs, fresh.degrees)


def test_a_number_too_long_for_a_float_is_an_error_and_changes_nothing():
    instance = Instance(CRANE, assemble(CRANE))
    instance(distance=2.0, angle=3.0)
    with pytest.raises(ValueError, match="distance is more than LREAL can hold"):
        instance(distance=10**400, angle=1.0)
    assert instance.inputs == {"distance": 2.0, "angle": 3.0}


def test_nc_keeps_the_previous_value_and_at_first_the_initial_one():
    instance = held(y=0.75)
    instance(x=1.5)
    assert (instance.y, instance.active) == (0.75, {"y": False})
    instance(x=3.0)
    assert (instance.y, instance.active) == (4.0, {"y": True})
    instance(x=1.5)
    assert (instance.y, instance.active) == (4.0, {"y": False})


def test_nc_goes_on_from_the_value_that_a_warm_restart_gives():
    instance = held(y=0.75)
    instance.resume(Y=3)
    assert instance.y == 3.0
    instance(x=1.5)
    assert instance.y == 3.0
    instance.reset()
    instance(x=1.5)
    assert instance.y == 0.75


def test_a_warm_restart_takes_known_outputs_only():
    instance = held(y=0.75)
    with pytest.raises(TypeError, match="no output z; there is y"):
        instance.resume(y=1.0, z=2.0)
    assert instance.y == 0.75


def test_default_is_taken_where_no_rule_is_active():
    instance = held(default=-8.0)
    instance(x=3.0)
    instance(x=1.5)
    assert instance.y == -8.0


def test_a_default_of_nan_is_given_out():
    instance = held(default=nan)
    instance(x=1.5)
    assert instance.y != instance.y


def test_reset_is_a_cold_restart():
    instance = held(x=2.5, y=0.75)
    instance(x=3.0)
    instance.reset()
    assert instance.inputs == {"x": 2.5}
    assert instance.outputs == {"y": 0.75}
    assert instance.active == {"y": False}


def test_instances_do_not_share_their_memory():
    first, second = held(), held()
    first(x=3.0)
    second(x=1.5)
    first(x=1.5)
    assert (first.y, second.y) == (4.0, 0.0)


@pytest.mark.parametrize("copied", [copy.copy, copy.deepcopy])
def test_a_copy_goes_on_by_itself_from_where_the_instance_stands(copied):
    first = Instance(crane(), assemble(crane()))
    first(distance=12.0, angle=4.0)
    second = copied(first)
    assert (second.inputs, second.power) == (first.inputs, first.power)
    power = first.power
    second(distance=1.0)
    assert first.power == power
    assert second.inputs == {"distance": 1.0, "angle": 4.0}


def test_names_are_found_in_any_letter_case():
    instance = Instance(CRANE, assemble(CRANE))
    instance(Distance=2.0, ANGLE=3.0)
    assert instance.inputs == {"distance": 2.0, "angle": 3.0}
    assert instance.Power == instance.power


def test_an_unknown_input_is_an_error_that_names_the_nearest():
    instance = Instance(CRANE, assemble(CRANE))
    with pytest.raises(TypeError) as error:
        instance(distnce=2.0)
    assert str(error.value) == "no input distnce; did you mean distance?"


def test_an_unknown_output_is_an_error_that_names_what_there_is():
    instance = Instance(CRANE, assemble(CRANE))
    with pytest.raises(AttributeError) as error:
        _ = instance.voltage
    assert str(error.value) == "no output voltage; there is power"
    assert not hasattr(instance, "distance")


@pytest.mark.parametrize("value", [nan, inf, -inf])
def test_a_value_that_is_not_finite_is_an_error_and_changes_nothing(value):
    instance = Instance(CRANE, assemble(CRANE))
    instance(distance=2.0, angle=3.0)
    before = (instance.inputs, instance.outputs)
    with pytest.raises(ValueError, match=rf"^angle is {value}$"):
        instance(distance=1.0, angle=value)
    assert (instance.inputs, instance.outputs) == before


def test_a_value_that_is_no_number_is_an_error():
    with pytest.raises(TypeError, match=r"^angle must be a number, not str$"):
        Instance(CRANE, assemble(CRANE))(angle="4")


@pytest.mark.parametrize("precision", [LREAL, REAL], ids=lambda each: each.name)
@pytest.mark.parametrize("kind", [int, Fraction, Decimal, np.float32, np.int16, np.array])
def test_a_number_of_another_kind_is_that_number(kind, precision):
    instance, other = (Instance(CRANE, assemble(CRANE, precision)) for _ in range(2))
    instance(distance=kind(12), angle=kind(4))
    other(distance=12.0, angle=4.0)
    assert (instance.inputs, instance.power) == (other.inputs, other.power)


def test_real_takes_no_number_that_it_cannot_hold():
    instance = Instance(CRANE, assemble(CRANE, REAL))
    with pytest.raises(ValueError, match=r"^angle is 4e\+38; REAL reaches to 3\.40282e\+38$"):
        instance(distance=1.0, angle=4e38)
    assert instance.inputs == {"distance": 0.0, "angle": 0.0}


@pytest.mark.parametrize("number", range(1, 8))
def test_any_number_of_inputs_goes_in(number):
    names = [f"x{place}" for place in range(number)]
    inputs = {name: (points("t", (0, 0), (10, 1)),) for name in names}
    rules = [rule(name, every((name, "t")), ("y", name)) for name in names]
    places = [singleton(name, 2.0**place) for place, name in enumerate(names)]
    base = block(inputs, (output("y", *places),), RuleBlock(name="r", rules=tuple(rules)))
    instance = Instance(base, assemble(base))
    values = {name: float(place) for place, name in enumerate(names)}
    instance(**values)
    assert instance.inputs == values
    assert list(instance.degrees.values()) == pytest.approx([place / 10 for place in range(number)])
    instance(**dict(reversed(values.items())))
    assert instance.inputs == values


def test_an_explanation_leaves_the_instance_alone():
    instance = held()
    instance(x=3.0)
    explanation = instance.explain(x=1.5)
    assert explanation.defuzzified[0].value == 4.0
    assert explanation.fired == ()
    assert (instance.inputs, instance.active) == ({"x": 3.0}, {"y": True})


def test_an_instance_shows_its_values():
    instance = held()
    instance(x=3.0)
    assert repr(instance) == "<instance of block: x=3, y=4>"
    assert "y" in dir(instance)


def test_a_weight_from_outside_is_taken_into_0_to_1():
    base = block(
        BAND,
        (output("y", singleton("small", -1), singleton("big", 4)),),
        RuleBlock(
            name="r",
            rules=(
                rule("1", every(("x", "low")), ("y", "small", "w")),
                rule("2", every(("x", "low")), ("y", "big")),
            ),
        ),
        more_inputs=(Variable("w", initial=1.0),),
    )
    program = assemble(base)
    instance = Instance(base, program)
    outputs = []
    for weight in (-3.0, 0.0, 0.25, 1.0, 7.0):
        instance(x=0.0, w=weight)
        outputs.append(instance.y)
    assert outputs == [4.0, 4.0, (4 - 0.25) / 1.25, 1.5, 1.5]


def test_a_million_calls_leave_nothing_behind():
    base = crane(("far", "zero", "pos_high"), default=None)
    instance = Instance(base, assemble(base))
    instance(distance=1.0, angle=2.0)
    gc.collect()
    before = sys.getallocatedblocks()
    for step in range(500_000 if compiled() else 500):
        instance(distance=step * 1e-4, angle=0.0)
        instance(angle=1.0)
    gc.collect()
    assert abs(sys.getallocatedblocks() - before) < 100
