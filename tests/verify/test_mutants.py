"""The catalogue of mutants: each is a legal rule base of its own, one change away from the original."""

from collections import Counter
from dataclasses import fields, is_dataclass

import pytest
from hypothesis import HealthCheck, given, settings

from fcl_sim import fcl
from fcl_sim.diagnostics import InputFault
from fcl_sim.engine.assemble import assemble
from fcl_sim.model import FunctionBlock
from fcl_sim.verify.mutants import Kind, mutants
from tests.house.places import ROOT
from tests.laws.models import function_blocks

CRANE = ROOT / "scenarios" / "crane"
FILES = sorted(file for folder in ("tests/fcl", "scenarios") for file in (ROOT / folder).rglob("*.fcl"))
BLOCKS = [block for file in FILES for block in fcl.read_file(file).blocks]


def read(body: str) -> FunctionBlock:
    reading = fcl.read(f"FUNCTION_BLOCK b {body} END_FUNCTION_BLOCK")
    assert reading.errors == ()
    return reading.blocks[0]


HEATER = """
VAR_INPUT t: REAL; w: REAL; END_VAR
VAR_OUTPUT v: REAL; END_VAR
FUZZIFY t TERM cold := (0, 1) (10, 0); TERM warm := (0, 0) (10, 1) (10, 0); END_FUZZIFY
DEFUZZIFY v TERM shut := 0; TERM half := 4; TERM open := 10; METHOD: CoGS; DEFAULT := NC; END_DEFUZZIFY
RULEBLOCK r AND: MIN; ACCU: MAX;
  RULE 1: IF t IS cold AND w THEN v IS open;
  RULE 2: IF NOT (t IS cold) THEN v IS half WITH w;
  RULE 3: IF t IS warm THEN v IS shut WITH 0.5;
END_RULEBLOCK
"""


def told(body: str, *kinds: Kind) -> list[str]:
    return [str(each) for each in mutants(read(body)) if each.kind in kinds]


def test_a_conclusion_takes_the_next_term_along_the_axis_each_way():
    assert told(HEATER, Kind.CONSEQUENT_MOVED) == [
        "rule 1: v IS open → half",
        "rule 2: v IS half → shut",
        "rule 2: v IS half → open",
        "rule 3: v IS shut → half",
    ]


def test_terms_lie_along_the_axis_whatever_their_order_in_the_text():
    shuffled = HEATER.replace("TERM shut := 0; TERM half := 4;", "TERM half := 4; TERM shut := 0;")
    assert told(shuffled, Kind.CONSEQUENT_MOVED) == told(HEATER, Kind.CONSEQUENT_MOVED)


def test_conditions_are_moved_negated_and_exchanged():
    assert told(HEATER, Kind.CONDITION_MOVED) == [
        "rule 1: t IS cold → warm",
        "rule 2: t IS cold → warm",
        "rule 3: t IS warm → cold",
    ]
    assert told(HEATER, Kind.CONDITION_NEGATED) == [
        "rule 1: t IS cold → t IS NOT cold",
        "rule 1: w → NOT w",
        "rule 2: t IS NOT cold → t IS cold",
        "rule 3: t IS warm → t IS NOT warm",
    ]
    assert told(HEATER, Kind.AND_OR_EXCHANGED) == ["rule 1: AND → OR in t IS cold AND w"]


def test_weights_are_halved_and_set_aside():
    assert told(HEATER, Kind.WEIGHT_CHANGED) == [
        "rule 1: v IS open WITH 1 → 0.5",
        "rule 2: v IS half WITH w → 0.5",
        "rule 2: v IS half WITH w → 1",
        "rule 3: v IS shut WITH 0.5 → 0.25",
        "rule 3: v IS shut WITH 0.5 → 1",
    ]


def test_breakpoints_go_a_quarter_of_the_way_and_an_edge_goes_as_one():
    assert told(HEATER, Kind.BREAKPOINT_SHIFTED) == [
        "term cold of t: 0 → -2.5",
        "term cold of t: 0 → 2.5",
        "term cold of t: 10 → 7.5",
        "term cold of t: 10 → 12.5",
        "term warm of t: 0 → -2.5",
        "term warm of t: 0 → 2.5",
        "term warm of t: 10 → 7.5",
        "term warm of t: 10 → 12.5",
    ]
    (edge,) = [each for each in mutants(read(HEATER)) if str(each) == "term warm of t: 10 → 7.5"]
    moved = edge.function_block.fuzzifications[0].terms[1].shape
    assert [(each.x, each.degree) for each in moved.points] == [(0, 0), (7.5, 1), (7.5, 0)]


def test_singletons_go_towards_each_other_and_the_outermost_as_far_out():
    assert told(HEATER, Kind.SINGLETON_SHIFTED) == [
        "term shut of v: 0 → -1",
        "term shut of v: 0 → 1",
        "term half of v: 4 → 3",
        "term half of v: 4 → 5.5",
        "term open of v: 10 → 8.5",
        "term open of v: 10 → 11.5",
    ]


def test_a_breakpoint_alone_goes_by_its_own_magnitude():
    alone = HEATER.replace("(0, 1) (10, 0)", "(8, 1) (8, 0)").replace(
        "(0, 0) (10, 1) (10, 0)", "(8, 0) (8, 1)"
    )
    assert set(told(alone, Kind.BREAKPOINT_SHIFTED)) == {
        f"term {term} of t: 8 → {place}" for term in ("cold", "warm") for place in (6, 10)
    }


def test_a_variable_of_whole_numbers_keeps_to_them():
    counts = HEATER.replace("t: REAL", "t: INT").replace("v: REAL", "v: INT")
    moved = told(counts, Kind.BREAKPOINT_SHIFTED, Kind.SINGLETON_SHIFTED)
    assert "term half of v: 4 → 6" in moved
    assert not any("." in each for each in moved)


def test_settings_take_the_other_choices_of_the_standard():
    kinds = [
        each for each in Kind if each.value.split()[0] in {"operators", "ACT", "ACCU", "METHOD", "DEFAULT"}
    ]
    assert told(HEATER, *kinds) == [
        "rule block r: MIN, MAX → PROD, ASUM",
        "rule block r: MIN, MAX → BDIF, BSUM",
        "rule block r: ACCU MAX → BSUM",
        "rule block r: ACCU MAX → NSUM",
        "output v: METHOD CoGS → LM",
        "output v: METHOD CoGS → RM",
        "output v: DEFAULT NC → 0",
        "output v: DEFAULT NC → 10",
    ]


def test_an_accu_that_an_output_has_of_its_own_is_changed_there():
    own = HEATER.replace("METHOD", "ACCU: NSUM; METHOD")
    assert told(own, Kind.ACCUMULATION_CHANGED) == ["output v: ACCU NSUM → MAX", "output v: ACCU NSUM → BSUM"]


def test_no_rule_is_deleted_without_which_another_has_nothing_to_use():
    local = HEATER.replace("END_VAR", "END_VAR VAR z: REAL; END_VAR", 1)
    chained = local.replace("THEN v IS open", "THEN z").replace("IF t IS warm", "IF z")
    assert told(chained, Kind.RULE_DELETED) == ["rule 2: left out", "rule 3: left out"]


def test_curves_are_moved_and_widened():
    bell = HEATER.replace("(0, 1) (10, 0)", "GBELL 4 2 20")
    assert told(bell, Kind.CURVE_CHANGED) == [
        "term cold of t: place 20 → 17.5",
        "term cold of t: place 20 → 22.5",
        "term cold of t: parameter 1: 4 → 3",
        "term cold of t: parameter 1: 4 → 5",
        "term cold of t: parameter 2: 2 → 1.5",
        "term cold of t: parameter 2: 2 → 2.5",
    ]


@pytest.mark.parametrize("share", [0.0, 0.5, -1.0, float("nan")])
def test_a_breakpoint_moves_less_than_half_the_way(share):
    with pytest.raises(ValueError, match="share"):
        next(mutants(read(HEATER), share))


# -- laws


def spread(found, most=40):
    """Return at most so many mutants, from all parts of the catalogue: to read one back takes some time."""
    return found[:: 1 + len(found) // most]


def assert_laws(block: FunctionBlock) -> None:
    found = list(mutants(block))
    models = [each.function_block for each in found]
    assert block not in models
    assert len(set(models)) == len(models)
    for each in spread(found):
        reading = fcl.read(fcl.write(each.function_block))
        assert reading.errors == (), str(each)
        assert reading.blocks == (each.function_block,), str(each)
        assert is_one_change(block, each.function_block), str(each)


def differences(one, other):
    """Return how many parts of two models differ, where a part is what is no model itself."""
    if one == other or repr(one) == repr(other) == "nan":
        return 0
    if is_dataclass(one) and type(one) is type(other):
        pairs = [(getattr(one, each.name), getattr(other, each.name)) for each in fields(one) if each.compare]
        return sum(differences(*pair) for pair in pairs)
    if isinstance(one, tuple) and isinstance(other, tuple) and len(one) == len(other):
        return sum(differences(*pair) for pair in zip(one, other, strict=True))
    return 1


def is_one_change(block, mutant):
    """A change is one part, or a pair of operators, DEFAULT with its lock, an edge with its points; one ACCU
    may then be told by its rule blocks alone.
    """
    blocks = (
        [each.and_operator for each in block.rule_blocks],
        [each.and_operator for each in mutant.rule_blocks],
    )
    allowed = 1 + (blocks[0] != blocks[1])
    outputs = list(zip(block.defuzzifications, mutant.defuzzifications, strict=True))
    allowed += sum(one.accumulation is not None and other.accumulation is None for one, other in outputs)
    allowed += sum(one.held != other.held for one, other in outputs)
    shapes = [term.shape for each in (*block.fuzzifications, *block.defuzzifications) for term in each.terms]
    shifted = [
        term.shape for each in (*mutant.fuzzifications, *mutant.defuzzifications) for term in each.terms
    ]
    if shapes != shifted:
        return sum(one != other for one, other in zip(shapes, shifted, strict=True)) == 1
    return 1 <= differences(block, mutant) <= allowed


@settings(max_examples=30, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(function_blocks())
def test_every_mutant_of_any_model_is_legal_and_no_two_are_equal(block):
    assert_laws(block)


@pytest.mark.parametrize("file", FILES, ids=lambda file: f"{file.parent.name}-{file.stem}")
def test_every_mutant_of_the_files_here_is_legal_and_can_be_computed(file):
    for block in fcl.read_file(file).blocks:
        assert_laws(block)
        for each in spread(list(mutants(block)), 5) if can_be_computed(block) else ():
            assemble(each.function_block)


def can_be_computed(block: FunctionBlock) -> bool:
    try:
        assemble(block)
    except InputFault:
        return False
    return True


def test_the_crane_has_so_many_of_each_kind():
    (block,) = fcl.read_file(CRANE / "crane_completed.fcl").blocks
    found = list(mutants(block))
    assert {str(kind): count for kind, count in Counter(each.kind for each in found).items()} == {
        "consequent moved": 37,
        "condition moved": 80,
        "condition negated": 50,
        "AND and OR exchanged": 25,
        "weight changed": 25,
        "rule deleted": 25,
        "breakpoint shifted": 52,
        "singleton shifted": 10,
        "operators changed": 2,
        "ACCU changed": 2,
        "METHOD changed": 2,
        "DEFAULT changed": 3,
    }
    of_rules = [each for each in found if each.rule]
    assert all(
        each.span.text.startswith("power IS") for each in of_rules if each.kind is Kind.CONSEQUENT_MOVED
    )
    assert {each.rule for each in of_rules} == {str(label) for label in range(1, 26)}
