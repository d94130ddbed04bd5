"""What the model can say and the engine cannot evaluate yet is refused, all at once."""

from dataclasses import replace

import pytest

from fcl_sim.diagnostics import InputFault, Source, Span
from fcl_sim.engine.assemble import assemble
from fcl_sim.model import Conclusion, Degree, Method, Point, Points, RuleBlock, Singleton, Term
from tests.engine.bases import block, every, output, points, rule, singleton

SOURCE = Source("base.fcl", "TERM t := 1;\nTERM u := 2;\n")
SPANS = (Span(SOURCE, 5, 6), Span(SOURCE, 18, 19))

INPUT = (points("low", (0, 1), (1, 0)),)
PLAIN = output("y", singleton("s", 1))
RULES = RuleBlock(name="r", rules=(rule("1", every(("x", "low")), ("y", "s")),))


def at(span, term):
    return replace(term, span=span)


def moved(name):
    return Term(name, Points((Point("x", 0.0), Point(1.0, 1.0))))


def rules(condition, conclusion):
    return RuleBlock(name="r", rules=(replace(rule("1", condition), conclusions=(conclusion,)),))


AREAS = output("y", at(SPANS[0], points("t", (0, 0), (1, 1))), at(SPANS[1], points("u", (0, 0), (1, 1))))
MAXIMUM = output("y", singleton("s", 1), method=Method.LM)
MOVED = output("y", at(SPANS[0], Term("s", Singleton("x"))))
HUGE = output("y", at(SPANS[0], singleton("s", 1e301)))
FLAT = (at(SPANS[1], points("low", (-9e299, 0), (9e299, 1e-9))),)

CASES = {
    "FCL401": (block({"x": INPUT}, (AREAS,), RULES), "terms of `y` have areas; not evaluated yet"),
    "FCL402": (
        block({"x": INPUT}, (replace(MAXIMUM, span=SPANS[0]),), RULES),
        "METHOD LM of `y`, whose terms are singletons, is not evaluated yet",
    ),
    "FCL403": (
        block({"x": (at(SPANS[0], moved("low")),)}, (PLAIN,), RULES),
        "base points of `x` are moved by a variable; not evaluated yet",
    ),
    "FCL404": (
        block({"x": INPUT}, (MOVED,), RULES),
        "singletons of `y` are moved by a variable; not evaluated yet",
    ),
    "FCL405": (
        block({"x": INPUT}, (PLAIN,), rules(every(("x", "low")), Conclusion("y", None, 1.0, SPANS[0]))),
        "`y` is given out as a degree; not evaluated yet",
    ),
    "FCL406": (
        block({"x": INPUT}, (PLAIN,), rules(Degree("local", SPANS[1]), Conclusion("y", "s"))),
        "`local` in a condition is not an input; not evaluated yet",
    ),
    "FCL407": (
        block({"x": FLAT}, (HUGE,), RULES),
        "base points of `x` exceed what binary64 can carry",
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
        assemble(CASES["FCL401"][0])
    assert str(fault.value) == (
        "base.fcl:1:6: error[FCL401]: terms of `y` have areas; not evaluated yet\n"
        "  1 | TERM t := 1;\n"
        "    |      ^\n"
        "  also at base.fcl:2:6\n"
        "  hint: this version defuzzifies singletons: TERM name := number; METHOD : CoGS;"
    )


def test_several_faults_come_together():
    with pytest.raises(InputFault) as fault:
        assemble(CASES["FCL407"][0])
    assert [each.message for each in fault.value.diagnostics] == [
        "base points of `x` exceed what binary64 can carry",
        "singletons of `y` exceed what binary64 can carry",
    ]


def test_a_local_variable_that_is_concluded_on_is_refused():
    base = block({"x": INPUT}, (PLAIN,), rules(every(("x", "low")), Conclusion("local", "s", 1.0, SPANS[0])))
    with pytest.raises(InputFault) as fault:
        assemble(base)
    message = "the local variable `local` is concluded on; not evaluated yet"
    assert [(each.code, each.message) for each in fault.value.diagnostics] == [("FCL405", message)]
