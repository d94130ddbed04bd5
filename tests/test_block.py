import pytest

import fcl_sim
from fcl_sim import InputFault

CRANE = """\
FUNCTION_BLOCK container_crane
VAR_INPUT
    distance: REAL;
    angle: REAL := 4.0;
END_VAR
VAR_OUTPUT
    power: REAL;
END_VAR
FUZZIFY distance
    TERM medium := (5, 0) (10, 1) (22, 0);
    TERM far := (10, 0) (22, 1);
END_FUZZIFY
FUZZIFY angle
    TERM zero := (-5, 0) (0, 1) (5, 0);
    TERM pos_small := (0, 0) (5, 1) (50, 0);
END_FUZZIFY
DEFUZZIFY power
    TERM zero := 0;
    TERM pos_medium := 9;
    METHOD: CoGS;
    DEFAULT := 0;
END_DEFUZZIFY
RULEBLOCK No1
    AND: MIN;
    ACCU: MAX;
    RULE 1: IF distance IS medium AND angle IS pos_small THEN power IS pos_medium;
    RULE 2: IF distance IS medium AND angle IS zero THEN power IS zero;
    RULE 3: IF distance IS far AND angle IS zero THEN power IS pos_medium;
END_RULEBLOCK
END_FUNCTION_BLOCK
"""
TWO = CRANE + "\n" + CRANE.replace("container_crane", "second_crane")


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "crane.fcl").write_text(CRANE)
    (tmp_path / "two.fcl").write_text(TWO)
    return tmp_path


def test_a_file_becomes_a_block_that_is_called_as_the_standard_calls_one(folder):
    block = fcl_sim.load("crane.fcl")
    crane = block.instance()
    crane(distance=12.0, angle=4.0)
    assert crane.power == 7.2


def test_a_text_becomes_a_block_that_is_evaluated_on_arrays():
    block = fcl_sim.loads(CRANE)
    assert block.evaluate({"distance": [12.0, 10.0], "angle": 4.0})["power"].tolist() == [7.2, 7.2]
    assert block.evaluation({"distance": 30.0, "angle": 9.0}).active["power"].tolist() is False


def test_an_input_with_an_initial_value_may_be_missing():
    block = fcl_sim.loads(CRANE)
    assert float(block.evaluate({"distance": 12.0})["power"]) == 7.2
    assert block.explain(distance=12.0).defuzzified[0].value == 7.2
    with pytest.raises(TypeError, match=r"^container_crane needs a value for distance$"):
        block.explain(angle=1.0)


def test_a_block_says_what_it_is(folder):
    block = fcl_sim.load("crane.fcl")
    assert (block.name, block.inputs, block.outputs) == ("container_crane", ("distance", "angle"), ("power",))
    assert repr(block) == "<Block container_crane: distance, angle -> power>"


def test_an_input_may_be_called_as_python_calls_an_object_itself():
    block = fcl_sim.loads(CRANE.replace("distance", "self"))
    assert block.explain(self=12.0, angle=4.0).defuzzified[0].value == 7.2
    for arithmetic in ("LREAL", "REAL"):
        crane = block.instance(arithmetic)
        crane(self=12.0, angle=4.0)
        assert crane.power == pytest.approx(7.2)
        assert crane.explain(self=12.0).defuzzified[0].value == pytest.approx(7.2)
    counts = block.instance("INT")
    counts(self=12, angle=4)
    assert counts.power == 7


def test_an_output_may_be_called_as_python_calls_an_object_itself():
    crane = fcl_sim.loads(CRANE.replace("power", "self")).instance()
    crane.resume(self=5.0)
    assert crane.outputs == {"self": 5.0}


@pytest.mark.parametrize("arithmetic", ["SREAL", "DINT", "lreal"])
def test_an_arithmetic_that_is_not_there_is_an_error_that_lists_what_is(arithmetic):
    block = fcl_sim.loads(CRANE)
    for ask in (block.instance, lambda arithmetic: block.evaluate({}, arithmetic=arithmetic)):
        with pytest.raises(ValueError, match=f"^no arithmetic {arithmetic}; there is LREAL, REAL or INT$"):
            ask(arithmetic=arithmetic)


def test_several_blocks_in_one_file_are_chosen_by_name(folder):
    assert list(fcl_sim.load_all("two.fcl")) == ["container_crane", "second_crane"]
    assert fcl_sim.load("two.fcl", block="Second_Crane").name == "second_crane"
    with pytest.raises(InputFault) as fault:
        fcl_sim.load("two.fcl")
    assert str(fault.value) == (
        "two.fcl:1:16: error[FCL422]: there are 2 function blocks; say which one is meant\n"
        "  1 | FUNCTION_BLOCK container_crane\n"
        "    |                ^^^^^^^^^^^^^^^\n"
        "  also at two.fcl:32:16\n"
        "  hint: there is container_crane or second_crane"
    )


def test_a_block_that_is_not_there_is_an_error_with_the_nearest_name(folder):
    with pytest.raises(InputFault) as fault:
        fcl_sim.load("two.fcl", block="second_crain")
    (diagnostic,) = fault.value.diagnostics
    assert (diagnostic.code, diagnostic.message) == ("FCL423", "there is no function block `second_crain`")
    assert diagnostic.hint == "did you mean `second_crane`?"


def test_a_text_without_a_block_is_an_error():
    with pytest.raises(InputFault):
        fcl_sim.loads("(* nothing *)", name="empty.fcl")


def test_every_fault_of_a_file_comes_at_once():
    bad = CRANE.replace("THEN power IS zero", "THEN power IS zeros").replace(
        "angle IS pos_small THEN", "angle IS small THEN"
    )
    with pytest.raises(InputFault) as fault:
        fcl_sim.loads(bad)
    assert {each.code for each in fault.value.diagnostics} == {"FCL310"}
    assert len(fault.value.diagnostics) == 2


def test_what_the_reader_noticed_stays_with_the_block():
    block = fcl_sim.loads(CRANE.replace("    ACCU: MAX;\n", ""))
    assert [each.code for each in block.diagnostics] == ["FCL341"]


def test_what_cannot_be_evaluated_points_into_the_text():
    huge = CRANE.replace("TERM pos_medium := 9;", "TERM pos_medium := 1e301;")
    with pytest.raises(InputFault) as fault:
        fcl_sim.loads(huge, name="huge.fcl")
    assert str(fault.value).splitlines()[0] == (
        "huge.fcl:19:10: error[FCL407]: singletons of `power` exceed what LREAL can hold"
    )


def test_terms_with_areas_are_evaluated():
    areas = CRANE.replace("TERM zero := 0;", "TERM zero := (-9, 0) (0, 1) (9, 0);").replace(
        "TERM pos_medium := 9;", "TERM pos_medium := (0, 0) (9, 1) (18, 0);"
    )
    areas = areas.replace("METHOD: CoGS;", "METHOD: LM; RANGE := (-9 .. 18);")
    assert float(fcl_sim.loads(areas).evaluate({"distance": 12.0, "angle": 4.0})["power"]) == 7.2


def test_the_package_names_what_it_has():
    assert {"load", "loads", "load_all", "Block", "Instance", "InputFault"} <= set(dir(fcl_sim))
    assert fcl_sim.Instance is type(fcl_sim.loads(CRANE).instance())
    with pytest.raises(AttributeError, match=r"^module 'fcl_sim' has no attribute 'lod'$"):
        _ = fcl_sim.lod
