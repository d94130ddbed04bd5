"""What can be written in a formula, and what a reader is told who wrote something else."""

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from fcl_sim.diagnostics import InputFault
from fcl_sim.formula.text import plain
from fcl_sim.judge.temporal.formula import bind, read
from fcl_sim.judge.temporal.tree import signals
from tests.judge.formulae import formula

UNITS = {"crane.distance": "m", "crane.sway": "deg", "crane.speed": "m/s", "valve": "", "Temp 1": "degC"}

FORMS = [
    ("always[35 s, 60 s] (abs(crane.sway) < 0.5 deg)", "always[35 s, 60 s] (abs(crane.sway) < 0.5 deg)"),
    ("always[500ms,2 min]valve>1", "always[0.5 s, 120 s] (valve > 1)"),
    ("eventually[5 s, end] valve > 1", "eventually[5 s, end] (valve > 1)"),
    ("not valve > 1 and valve < 3", "(not (valve > 1)) and (valve < 3)"),
    ("valve > 1 or valve > 2 and valve > 3", "(valve > 1) or ((valve > 2) and (valve > 3))"),
    (
        "valve > 1 implies valve > 2 implies valve > 3",
        "(valve > 1) implies ((valve > 2) implies (valve > 3))",
    ),
    (
        "valve > 1 until[0 s, 5 s] valve > 2 or valve > 3",
        "((valve > 1) until[0 s, 5 s] (valve > 2)) or (valve > 3)",
    ),
    ("always valve > 1 until valve > 2", "(always (valve > 1)) until (valve > 2)"),
    ("0 m <= crane.distance < 3 m", "(0 m <= crane.distance) and (crane.distance < 3 m)"),
    ("valve - 1 - 2 * 3 > -valve", "(valve - 1) - (2 * 3) > -valve"),
    ("min(valve, 2, -valve) > max(1, 2)", "min(valve, 2, -valve) > max(1, 2)"),
    ("crane.speed < 3 m/s and valve < 50 %", "(crane.speed < 3 m/s) and (valve < 50 %)"),
    ("`Temp 1` < 20 °C", "`Temp 1` < 20 degC"),
    ("rise(valve > 0.5) or true", "rise(valve > 0.5) or true"),
    ("whenever valve > 1, then valve > 2", "always ((valve > 1) implies (valve > 2))"),
    (
        "whenever valve > 1 then within 2 s valve > 2 for at least 5 s",
        "always ((valve > 1) implies (eventually[0 s, 2 s] (always[0 s, 5 s] (valve > 2))))",
    ),
    ("never valve > 1", "always (not (valve > 1))"),
    ("from 35 s on, valve > 1", "always[35 s, end] (valve > 1)"),
    ("from 35 s to 60 s, valve > 1", "always[35 s, 60 s] (valve > 1)"),
    ("within 30 s valve > 1", "eventually[0 s, 30 s] (valve > 1)"),
    ("within 30 s, valve > 1 for good", "eventually[0 s, 30 s] (always (valve > 1))"),
    ("within 30 s valve > 1 for at least 5 s", "eventually[0 s, 30 s] (always[0 s, 5 s] (valve > 1))"),
    ("valve > 1 lasts at least 2 s", "always (rise(valve > 1) implies (always[0 s, 2 s] (valve > 1)))"),
    (
        "valve > 1 lasts at most 2 s",
        "always ((valve > 1) implies (eventually[0 s, 2 s] (not (valve > 1))))",
    ),
    ("no valve > 1 before valve > 2", "((not (valve > 1)) until (valve > 2)) or (always (not (valve > 1)))"),
]

FAULTS = {
    "always (valve > 1": """\
<formula>:1:18: error[JDG201]: `)` is missing, before the end of the formula
  1 | always (valve > 1
    |                  ^
  hint: `(` is opened before it and not closed""",
    "valve > 1 valve": """\
<formula>:1:11: error[JDG201]: there is no unit `valve`
  1 | valve > 1 valve
    |           ^^^^^
  hint: units are written as m, kg, s, min, N, kW, deg, K, degC, bar, %""",
    "valve > 1 and (valve < 3) valve > 2": """\
<formula>:1:27: error[JDG201]: `valve` does not belong here: the formula has ended before it
  1 | valve > 1 and (valve < 3) valve > 2
    |                           ^^^^^
  hint: join truths by `and`, `or`, `implies` or `until`""",
    "rise(valve > 1 N m)": """\
<formula>:1:18: error[JDG201]: `)` is missing, before `m`
  1 | rise(valve > 1 N m)
    |                  ^
  hint: a unit has no blanks in a formula: write `1 N*m`""",
    "valve > 1 N m": """\
<formula>:1:13: error[JDG201]: `m` does not belong here: the formula has ended before it
  1 | valve > 1 N m
    |             ^
  hint: a unit has no blanks in a formula: write `1 N*m`""",
    "valve = 1": """\
<formula>:1:7: error[JDG201]: `=` has no meaning in a formula
  1 | valve = 1
    |       ^
  hint: write `==`, or better <= and >=""",
    "always[35, 60 s] valve > 1": """\
<formula>:1:8: error[JDG205]: 35 is not a time
  1 | always[35, 60 s] valve > 1
    |        ^^
  hint: write `35 s`""",
    "always[60 s, 35 s] valve > 1": """\
<formula>:1:7: error[JDG205]: the interval ends before it begins
  1 | always[60 s, 35 s] valve > 1
    |       ^^^^^^^^^^^^
  hint: are they exchanged?""",
    "eventually[0 s, 3 m] valve > 1": """\
<formula>:1:17: error[JDG205]: 3 m is not a time
  1 | eventually[0 s, 3 m] valve > 1
    |                 ^^^
  hint: write a time with its unit, as in "50 ms" or "2 min\"""",
    "eventually[0 s, 400 h] always[0 s, 1e9 h] valve > 1": """\
<formula>:1:36: error[JDG205]: no trace is so long
  1 | eventually[0 s, 400 h] always[0 s, 1e9 h] valve > 1
    |                                    ^^^^^
  hint: the end of the trace is `end`""",
    "always crane.sway": """\
<formula>:1:8: error[JDG204]: what follows `always` is true or false, and this is a number
  1 | always crane.sway
    |        ^^^^^^^^^^
  hint: compare it, as in `crane.sway > 0.5`""",
    "abs(valve > 1) > 2": """\
<formula>:1:5: error[JDG204]: `abs` takes numbers, and this is true or false
  1 | abs(valve > 1) > 2
    |     ^^^^^^^^^
  hint: compare numbers, and join what comes of it by and, or, not""",
    "whenever valve > 1 within 2 s valve > 2": """\
<formula>:1:20: error[JDG201]: `then` is missing behind the trigger, before `within`
  1 | whenever valve > 1 within 2 s valve > 2
    |                    ^^^^^^""",
    "sqrt(valve) > 2": """\
<formula>:1:1: error[JDG206]: there is no function called `sqrt`
  1 | sqrt(valve) > 2
    | ^^^^
  hint: there are abs, min, max, rise, fall, always or eventually""",
    "crane.swey < 3 deg and crane.sway < 3 m": """\
<formula>:1:1: error[JDG202]: there is no signal called `crane.swey`
  1 | crane.swey < 3 deg and crane.sway < 3 m
    | ^^^^^^^^^^
  hint: did you mean `crane.sway`?
<formula>:1:37: error[JDG203]: `crane.sway` is in deg, and `3 m` is in m
  1 | crane.swey < 3 deg and crane.sway < 3 m
    |                                     ^^^
  hint: write it in deg, or in a unit that converts to it""",
    "crane.sway < 3": """\
<formula>:1:14: error[JDG203]: `crane.sway` is in deg, and `3` has no unit
  1 | crane.sway < 3
    |              ^
  hint: write `3 deg`""",
    "valve < 3 m": """\
<formula>:1:9: error[JDG203]: `valve` has no unit, and `3 m` is in m
  1 | valve < 3 m
    |         ^^^
  hint: write the number alone""",
    "max(crane.sway, crane.distance) < 3 m": """\
<formula>:1:17: error[JDG203]: `crane.sway` is in deg, and `crane.distance` is in m
  1 | max(crane.sway, crane.distance) < 3 m
    |                 ^^^^^^^^^^^^^^
  hint: write it in deg, or in a unit that converts to it""",
}


@pytest.mark.parametrize(("text", "formula_"), FORMS, ids=[text for text, _ in FORMS])
def test_a_text_is_read_as_its_operators_bind(text, formula_):
    statement = read(plain(text))
    assert statement.formula == formula_
    assert read(plain(formula_)).tree == statement.tree
    bind(statement, UNITS)


@pytest.mark.parametrize("text", FAULTS)
def test_a_slip_is_shown_with_its_mend(text):
    with pytest.raises(InputFault) as caught:
        bind(read(plain(text)), UNITS)
    assert str(caught.value) == FAULTS[text]


def test_a_sentence_is_kept_beside_its_formula():
    assert str(formula("never x > 1")) == "never x > 1; that is: always (not (x > 1))"
    assert str(formula("always x > 1")) == "always (x > 1)"


def test_a_name_in_backquotes_is_no_word_of_the_language():
    units = {"min": "", "never": "", "deg": "deg"}
    statement = read(plain("`never` > `min` and `deg` < 3 deg"))
    assert list(signals(bind(statement, units).tree)) == ["never", "min", "deg"]
    assert read(plain(statement.formula)).tree == statement.tree


@pytest.mark.parametrize("count", [31, 500, 5000])
def test_what_is_too_deep_is_refused_and_not_a_failure_of_ours(count):
    for text in (
        "(" * count + "x > 1" + ")" * count,
        "not " * count + "x > 1",
        "x > 1" + " and x > 1" * count,
    ):
        with pytest.raises(InputFault, match="JDG207"):
            read(plain(text))


@example("x > 1\u2028and y < 2")
@example("\x00")
@given(
    st.text(max_size=40)
    | st.lists(st.sampled_from([*"xy()[],<>+-*/`", "1 s", "always", "until", "end"])).map(" ".join)
)
def test_any_text_is_a_formula_or_a_finding(text):
    try:
        codes = {"JDG201"} if read(plain(text)).formula else set()
    except InputFault as fault:
        codes = {each.code for each in fault.diagnostics if str(fault)}
    assert {code[:4] for code in codes} == {"JDG2"}
