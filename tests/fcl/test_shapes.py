"""Membership functions by name: both families' spellings make one convention of the model (S15)."""

import pytest

from fcl_sim import fcl
from fcl_sim.model import Curve, CurveKind, Point, Points, Singleton, Singletons
from tests.fcl.texts import block, changed, codes


def shape(written):
    text = changed(("(3, 1) (27, 0)", written))
    return block(text).fuzzifications[0].terms[0].shape


def points(*pairs):
    return Points(tuple(Point(x, degree) for x, degree in pairs))


@pytest.mark.parametrize(
    ("jfuzzylogic", "fuzzylite", "expected"),
    [
        ("TRIAN 0 2 5", "Triangle 0 2 5", points((0, 0), (2, 1), (5, 0))),
        ("TRAPE 0 0 3 5", "Trapezoid (0, 0, 3, 5)", points((0, 0), (0, 1), (3, 1), (5, 0))),
        ("GAUSS 2 0.5", "Gaussian 2 0.5", Curve(CurveKind.GAUSSIAN, (2, 0.5))),
        ("GAUSS2 1 2 3 4", "GaussianProduct 1 2 3 4", Curve(CurveKind.GAUSSIAN_PRODUCT, (1, 2, 3, 4))),
        ("GBELL 2 4 5", "Bell 5 2 4", Curve(CurveKind.BELL, (2, 4, 5))),
        ("SIGM -4 3", "Sigmoid 3 -4", Curve(CurveKind.SIGMOID, (-4, 3))),
        ("COSINE 3 5", "Cosine 5 6", Curve(CurveKind.COSINE, (3, 5))),
        ("(0, 0.5) (1, 1)", "Discrete 0 0.5 1 1", points((0, 0.5), (1, 1))),
    ],
)
def test_both_families_write_one_shape(jfuzzylogic, fuzzylite, expected):
    assert shape(jfuzzylogic) == expected
    assert shape(fuzzylite) == expected


@pytest.mark.parametrize(
    ("written", "expected"),
    [
        ("DSIGM 8 2 5 7", Curve(CurveKind.SIGMOID_DIFFERENCE, (8, 2, 5, 7))),
        ("SigmoidDifference 2 8 5 7", Curve(CurveKind.SIGMOID_DISTANCE, (8, 2, 5, 7))),
        ("SigmoidProduct 2 8 -5 7", Curve(CurveKind.SIGMOID_PRODUCT, (8, 2, -5, 7))),
        ("ZShape 1 2", Curve(CurveKind.Z_SHAPE, (1, 2))),
        ("SShape 1 2", Curve(CurveKind.S_SHAPE, (1, 2))),
        ("PiShape 4.6 8.1 7.4 9.2", Curve(CurveKind.PI_SHAPE, (4.6, 8.1, 7.4, 9.2))),
        ("Spike 3 2", Curve(CurveKind.SPIKE, (3, 2))),
        ("Concave 3 2", Curve(CurveKind.CONCAVE, (3, 2))),
        ("Gaussian 3 -2 0.5", Curve(CurveKind.GAUSSIAN, (3, 2), 0.5)),
        ("GAUSS level 2", Curve(CurveKind.GAUSSIAN, ("level", 2))),
        ("Rectangle 1 2", points((1, 0), (1, 1), (2, 1), (2, 0))),
        ("Ramp 1 2", points((1, 0), (2, 1))),
        ("Ramp 2 1", points((1, 1), (2, 0))),
        ("Binary 2 inf", points((2, 0), (2, 1))),
        ("Binary 2 -inf", points((2, 1), (2, 0))),
        ("Triangle -inf 0 1", points((0, 1), (1, 0))),
        ("Trapezoid 0 1 inf inf", points((0, 0), (1, 1))),
        ("Triangle 0 1 2 0.5", points((0, 0), (1, 0.5), (2, 0))),
        ("Discrete 0 1 2 0.5 0.5", points((0, 0.5), (2, 0.25))),
        ("TRIAN 0 level 5", points((0, 0), ("level", 1), (5, 0))),
        ("SINGLETONS (1, 0.3) (2, 1)", Singletons((Point(1, 0.3), Point(2, 1)))),
    ],
)
def test_a_shape_has_its_parameters_in_the_order_of_the_model(written, expected):
    assert shape(written) == expected


def test_a_single_value_of_an_input_is_a_degree_of_1_there_alone():
    text = changed(("(3, 1) (27, 0)", "5"))
    assert codes(text) == ["FCL316"]
    assert block(text).fuzzifications[0].terms[0].shape == Singletons((Point(5, 1),))


def test_a_constant_of_an_output_is_a_singleton():
    found = block(changed(("TERM inlet := 100", "TERM inlet := Constant 100")))
    assert found.defuzzifications[0].terms[1].shape == Singleton(100)


def test_an_unknown_shape_is_met_with_the_nearest():
    (error,) = fcl.read(changed(("(3, 1) (27, 0)", "TRAPP 0 1 2 3"))).errors
    assert (error.message, error.hint) == ("`TRAPP` is not a membership function", "did you mean TRAPE?")


def test_a_wrong_number_of_parameters_is_met_with_their_names():
    (error,) = fcl.read(changed(("(3, 1) (27, 0)", "Bell 1 2"))).errors
    assert error.message == "Bell takes 3 parameters, not 2"
    assert error.hint == "write Bell centre half-width slope"


def test_degrees_of_any_kind_of_shape_stay_between_0_and_1():
    for written in ("Triangle 0 1 2 1.5", "Discrete 0 2", "Ramp 0 1 -1"):
        assert codes(changed(("(3, 1) (27, 0)", written))) == ["FCL317"]


def test_a_rectangle_may_have_an_end_in_infinity():
    assert shape("Rectangle -inf 0.5") == Points((Point(0.5, 1.0), Point(0.5, 0.0)))
    assert shape("Rectangle 0.5 inf") == Points((Point(0.5, 0.0), Point(0.5, 1.0)))
