from math import inf, nan

import numpy as np
import pytest

from fcl_sim.engine.assemble import assemble
from fcl_sim.engine.evaluate import evaluate
from tests.engine.bases import CRANE, CRANE_THREE, crane

THREE = assemble(CRANE_THREE)
HOLD = assemble(crane(("far", "zero", "pos_high"), default=None))


def test_arrays_are_broadcast():
    power = evaluate(THREE, {"distance": [[10.0], [12.0], [22.0]], "angle": [0.0, 4.0]}).outputs["power"]
    assert power.shape == (3, 2)
    assert power[1, 1] == 7.2


def test_plain_numbers_give_a_plain_number():
    power = evaluate(THREE, {"distance": 12, "angle": 4}).outputs["power"]
    assert power.shape == ()
    assert float(power) == 7.2


def test_no_points_give_no_points():
    assert evaluate(THREE, {"distance": [], "angle": 4}).outputs["power"].shape == (0,)


def test_nc_gives_the_previous_values_else_the_initial_one():
    values = {"distance": [0.0, 30.0, 0.0], "angle": 0.0}
    assert evaluate(HOLD, values).outputs["power"].tolist() == [0.0, 27.0, 0.0]
    previous = evaluate(HOLD, values, previous={"power": [5.0, 6.0, 7.0]})
    assert previous.outputs["power"].tolist() == [5.0, 27.0, 7.0]
    assert previous.active["power"].tolist() == [False, True, False]


def test_the_given_arrays_stay_as_they_are():
    previous = np.array([5.0, 6.0])
    distance = np.array([30.0, 30.0])
    evaluate(HOLD, {"distance": distance, "angle": 0.0}, previous={"power": previous})
    assert previous.tolist() == [5.0, 6.0]
    assert distance.tolist() == [30.0, 30.0]


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"distance": [1.0, nan, nan], "angle": 0.0}, "distance is nan at index 1"),
        ({"distance": 1.0, "angle": [[0.0, 1.0], [2.0, -inf]]}, "angle is -inf at index (1, 1)"),
        ({"distance": inf, "angle": 0.0}, "distance is inf"),
    ],
)
def test_a_value_that_is_not_finite_is_named_with_its_first_index(values, message):
    with pytest.raises(ValueError) as error:  # noqa: PT011  the whole message is compared
        evaluate(THREE, values)
    assert str(error.value) == message


@pytest.mark.parametrize("place", [0, 1, 39_998, 39_999])
def test_one_bad_value_among_many_is_found(place):
    distance = np.linspace(-8.0, 30.0, 40_000)
    distance[place] = nan
    with pytest.raises(ValueError, match=rf"^distance is nan at index {place}$"):
        evaluate(THREE, {"distance": distance, "angle": 0.0})
    with pytest.raises(ValueError, match=rf"^power is nan at index {place}$"):
        evaluate(THREE, {"distance": 0.0, "angle": 0.0}, previous={"power": distance})


def test_a_missing_input_is_an_error_unless_it_may_be_missing():
    with pytest.raises(TypeError, match=r"^container_crane needs a value for angle$"):
        evaluate(THREE, {"distance": 1.0})
    assert evaluate(THREE, {"distance": 12.0}, optional=frozenset(["angle"])).active["power"]


def test_an_unknown_name_is_an_error_that_names_the_nearest():
    with pytest.raises(TypeError, match=r"^no input angel; did you mean angle\?$"):
        evaluate(THREE, {"distance": 1.0, "angel": 0.0})
    with pytest.raises(TypeError, match=r"^no output poer; did you mean power\?$"):
        evaluate(THREE, {"distance": 1.0, "angle": 0.0}, previous={"poer": 0.0})


def test_shapes_that_do_not_match_are_an_error():
    with pytest.raises(ValueError, match="broadcast"):
        evaluate(assemble(CRANE), {"distance": [1.0, 2.0], "angle": [1.0, 2.0, 3.0]})
