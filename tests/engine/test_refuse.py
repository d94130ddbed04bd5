"""What the model can say and the engine cannot evaluate yet is refused, all at once."""

from dataclasses import replace

import pytest

from fcl_sim.diagnostics import InputFault, Source, Span
from fcl_sim.engine.assemble import assemble
from fcl_sim.engine.evaluate import evaluate
from fcl_sim.model import (
    Accumulation,
    Activation,
    Conclusion,
    Curve,
    CurveKind,
    Method,
    Point,
    RuleBlock,
    Singletons,
    Term,
)
from tests.engine.bases import block, every, output, points, rule, singleton

SOURCE = Source("base.fcl", "TERM t := 1;\nTERM u := 2;\n")
SPANS = (Span(SOURCE, 5, 6), Span(SOURCE, 18, 19))

INPUT = (points("low", (0, 1), (1, 0)),)
AREA = output("y", points("s", (0, 1), (1, 0)), method=Method.COG)
RULES = RuleBlock(name="r", rules=(rule("1", every(("x", "low")), ("y", "s")),))


def at(span, term):
    return replace(term, span=span)


HUGE = output("y", at(SPANS[0], singleton("s", 1e301)), at(SPANS[1], singleton("t", -1e301)))
FLAT = (at(SPANS[1], points("low", (-9e299, 0), (9e299, 1e-9))),)
CURVE = Term("s", Curve(CurveKind.GAUSSIAN, (0.0, 1.0)), span=SPANS[0])
SEVERAL = Term("s", Singletons((Point(1.0, 1.0), Point(2.0, 1.0))), span=SPANS[0])

CASES = {
    "FCL407": (
        block({"x": FLAT}, (HUGE,), RULES),
        "base points of `x` exceed what LREAL can hold",
    ),
    "FCL408": (
        block({"x": INPUT}, (output("y", SEVERAL),), RULES),
        "`s` of `y` has a shape that is not evaluated yet",
    ),
    "FCL412": (
        block({"x": INPUT}, (output("y", CURVE, method=Method.COG),), RULES),
        "`s` of `y` is a smooth shape, and `y` has no RANGE",
    ),
    "FCL410": (
        block(
            {"x": INPUT},
            (AREA,),
            replace(RULES, activation=Activation.EPROD, accumulation=Accumulation.NMAX, span=SPANS[0]),
        ),
        "ACCU NMAX of areas under ACT EPROD is not evaluated",
    ),
    "FCL331": (
        block({"x": INPUT}, (replace(AREA, method=Method.SUM, span=SPANS[0]),), RULES),
        "COGSS is a method for singletons, and these terms have an area",
    ),
}


@pytest.mark.parametrize("code", CASES)
def test_each_has_its_code_its_words_and_its_place(code):
    base, message = CASES[code]
    with pytest.raises(InputFault) as fault:
        assemble(base)
    first = fault.value.diagnostics[0]
    assert (first.code, first.message) == (code, message)
    assert first.hint
    assert first.places


def test_one_mistake_is_one_finding_with_all_its_places():
    with pytest.raises(InputFault) as fault:
        assemble(block({"x": INPUT}, (HUGE,), RULES))
    assert str(fault.value) == (
        "base.fcl:1:6: error[FCL407]: singletons of `y` exceed what LREAL can hold\n"
        "  1 | TERM t := 1;\n"
        "    |      ^\n"
        "  also at base.fcl:2:6\n"
        "  hint: keep magnitudes below 1e300, and terms from rising less than 1 in 1e308"
    )


def test_a_pair_of_operators_is_told_once_for_all_outputs():
    first, second = AREA, replace(AREA, variable="z")
    conclusions = tuple(Conclusion(each.variable, each.terms[0].name) for each in (first, second))
    norms = replace(
        RULES,
        activation=Activation.EPROD,
        accumulation=Accumulation.NMAX,
        span=SPANS[0],
        rules=(replace(RULES.rules[0], conclusions=conclusions),),
    )
    with pytest.raises(InputFault) as fault:
        assemble(block({"x": INPUT}, (first, second), norms))
    (only,) = fault.value.diagnostics
    assert [each.span for each in only.places] == [SPANS[0]]


def test_several_faults_come_together():
    with pytest.raises(InputFault) as fault:
        assemble(CASES["FCL407"][0])
    assert [each.message for each in fault.value.diagnostics] == [
        "base points of `x` exceed what LREAL can hold",
        "singletons of `y` exceed what LREAL can hold",
    ]


def test_places_as_large_as_can_be_carried_are_evaluated():
    wide = output("y", points("s", (-9e299, 0), (0, 1), (9e299, 0)), method=Method.COG)
    base = block({"x": INPUT}, (replace(wide, range=(-9e299, 9e299)),), RULES)
    assert abs(evaluate(assemble(base), {"x": 0.5}).outputs["y"]) < 1e285


def test_a_range_beyond_what_can_be_carried_is_refused():
    wide = output("y", points("s", (0, 1), (1, 1)), method=Method.COG)
    with pytest.raises(InputFault, match="RANGE of `y` exceeds what LREAL can hold"):
        assemble(block({"x": INPUT}, (replace(wide, range=(-1e300, 1e300)),), RULES))
