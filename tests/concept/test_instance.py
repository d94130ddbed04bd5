import copy

import pytest

from fcl_sim import concept


def test_an_input_that_is_not_given_keeps_its_value():
    block = concept.FUZ_MIN_INT(IN1=5)
    assert block.inputs == {"IN1": 5, "IN2": 0}
    block(IN2=7)
    assert block.OUT == 5
    block(in1=9)
    assert block.inputs == {"IN1": 9, "IN2": 7}
    assert block.OUT == 7


def test_with_en_false_nothing_runs_and_eno_is_false():
    block = concept.FUZ_MAX_INT(IN1=1, OUT=3)
    block(IN1=2, EN=False)
    assert (block.OUT, block.ENO, block.event) == (3, False, None)
    block(EN=True)
    assert (block.OUT, block.ENO) == (2, True)
    block(IN1=4)
    assert (block.OUT, block.ENO) == (4, True)


def test_an_error_is_forgotten_when_the_block_does_not_run():
    block = concept.FUZ_ATERM_INT(S1=1, S2=0)
    block()
    assert block.event is concept.Event.INPUT_VALUE_OUT_OF_RANGE
    block(EN=False)
    assert (block.event, block.ENO) == (None, False)


def test_values_have_the_data_type_of_the_block():
    integer = concept.DEFUZ_INT(MDiSi1=1, MDiSi2=4)
    integer()
    assert type(integer.Y) is int
    assert type(integer.inputs["ZERO_Y"]) is bool
    real = concept.FUZ_ATERM_STR(S2=3, X=1)
    real()
    assert type(real.MD.n) is int
    assert type(real.MD.term2) is float
    assert real.MD.term2 == pytest.approx(1 / 3, rel=6e-8)
    assert real.MD.term2 != 1 / 3  # binary32


@pytest.mark.parametrize(
    ("kind", "values", "error", "message"),
    [
        ("FUZ_ATERM_INT", {"S3": 1}, TypeError, "no input S3; there is X, S1 or S2"),
        ("FUZ_ATERM_INT", {"MD1": 1}, TypeError, "no input MD1; there is X, S1 or S2"),
        ("FUZ_ATERM_INT", {"X": 1.5}, TypeError, "X must be a whole number, not float"),
        ("FUZ_ATERM_INT", {"X": 32_768}, ValueError, "X is 32768; an INT lies in -32768 .. 32767"),
        ("FUZ_ATERM_REAL", {"X": float("nan")}, ValueError, "X is nan"),
        ("FUZ_ATERM_REAL", {"X": "1"}, TypeError, "X must be a number, not str"),
        ("FUZ_ATERM_REAL", {"X": 1e39}, ValueError, "X is 1e+39; a REAL reaches to 3.40282e+38"),
        ("FUZ_ATERM_REAL", {"X": 10**400}, ValueError, f"X is {10**400}"),
        ("DEFUZ_INT", {"ZERO_Y": 2}, ValueError, "ZERO_Y is 2; a BOOL is 0 or 1"),
        ("DEFUZ_REAL", {"ZERO_Y": 0.0}, TypeError, "ZERO_Y must be True or False, not float"),
        ("DEFUZ_STI", {"MD": 3}, TypeError, "MD must be a FUZ_MD_INT, not int"),
        ("DEFUZ_STR", {"MD": concept.FUZ_MD_INT()}, TypeError, "MD must be a FUZ_MD_REAL, not FUZ_MD_INT"),
        (
            "DEFUZ_STI",
            {"MD": concept.FUZ_MD_INT(1, 40_000)},
            ValueError,
            "MD.term1 is 40000; an INT lies in -32768 .. 32767",
        ),
        ("DEFUZ_STR", {"MD": concept.FUZ_MD_REAL(1.5)}, TypeError, "MD.n must be a whole number, not float"),
    ],
)
def test_a_value_that_does_not_fit_is_refused_and_none_is_taken(kind, values, error, message):
    block = getattr(concept, kind)()
    before = block.inputs
    first = next(name for name in ("S2", "MDiSi2") if name in before)
    with pytest.raises(error) as raised:
        block(**({first: 1} | values))
    assert str(raised.value) == message
    assert block.inputs == before


def test_an_output_that_is_not_there_names_the_nearest():
    block = concept.DEFUZ_STI()
    with pytest.raises(AttributeError, match=r"^no output YY; did you mean Y\?$"):
        _ = block.YY
    assert "Y" in dir(block)
    assert repr(concept.FUZ_MIN_INT(IN1=3)) == "<instance of FUZ_MIN_INT: IN1=3, IN2=0, OUT=0>"


def test_a_symbol_is_stretched_to_the_inputs_it_is_given():
    assert list(concept.FUZ_MIN_INT().inputs) == ["IN1", "IN2"]
    assert list(concept.FUZ_MIN_INT(in4=1).inputs) == ["IN1", "IN2", "IN3", "IN4"]
    assert len(concept.FUZ_SUM_REAL(inputs=32).inputs) == 32
    for inputs in (1, 33):
        with pytest.raises(ValueError, match=rf"has 2 to 32 inputs MD1, MD2, \.\., not {inputs}$"):
            concept.FUZ_SUM_REAL(inputs=inputs)
    with pytest.raises(TypeError, match=r"^no input or output IN3; "):
        concept.FUZ_MIN_INT(inputs=2, IN3=4)


def test_rounding_is_truncate_or_round_and_for_int_only():
    assert concept.FUZ_PROD_INT(MD1=1, MD2=5000, rounding=concept.Rounding.ROUND) is not None
    with pytest.raises(ValueError, match=r"^no rounding nearest; there is truncate or round$"):
        concept.FUZ_PROD_INT(rounding="nearest")
    with pytest.raises(ValueError, match=r"^FUZ_PROD_REAL works in REAL: there is nothing to round$"):
        concept.FUZ_PROD_REAL(rounding="round")


def test_a_copy_has_a_memory_of_its_own():
    block = concept.FUZ_MAX_INT(IN1=1)
    other = copy.deepcopy(block)
    other(IN1=5)
    assert (block.OUT, other.OUT) == (0, 5)
    assert block.inputs["IN1"] == 1
