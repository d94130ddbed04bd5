"""No figure is higher than what a page has for it, however much there is to show."""

from dataclasses import replace

import numpy as np
import pytest

from fcl_sim.block import loads
from fcl_sim.judge.envelope import EnvelopeVerdict
from fcl_sim.judge.verdict import Status
from fcl_sim.loop.trace import BlockEvent, FuzzyRecord
from fcl_sim.report import envelopes, memberships, style
from fcl_sim.report.characteristics import memberships as terms_of
from fcl_sim.report.time_plots import Lane, Shown, lanes, pages, time_plot
from tests.report.synthetic import LONG, requirement, trace, verdict

INPUTS = ("a", "b", "c", "d", "e")
TERMS = " ".join(f"TERM t{each} := ({each}, 0) ({each + 1}, 1) ({each + 2}, 0);" for each in range(9))
BLOCK = f"""FUNCTION_BLOCK many
VAR_INPUT {" ".join(f"{each}: REAL;" for each in INPUTS)} END_VAR
VAR_OUTPUT u: REAL; END_VAR
{" ".join(f"FUZZIFY {each} {TERMS} END_FUZZIFY" for each in INPUTS)}
DEFUZZIFY u TERM small := 0; TERM large := 1; METHOD: CoGS; DEFAULT := 0; END_DEFUZZIFY
RULEBLOCK rules AND: MIN; ACCU: MAX; RULE 1: IF a IS t1 THEN u IS small; END_RULEBLOCK
END_FUNCTION_BLOCK"""


def record(seed):
    numbers = np.random.default_rng(seed)
    return FuzzyRecord(
        input_names=INPUTS,
        output_names=("u",),
        rule_labels=("1",),
        inputs=numbers.random((5, 5)),
        outputs=numbers.random((5, 1)),
        degrees=np.ones((5, 1)),
        flags=np.ones((5, 1)),
    )


@pytest.mark.parametrize("runs", range(7))
def test_the_terms_of_many_variables_and_runs_fill_as_many_figures_as_are_needed(runs):
    block = loads(BLOCK, "many.fcl")
    found = terms_of(block, {}, "many", {f"run {each}": record(each) for each in range(runs)})
    figures = [each.draw() for each in found]
    assert all(each.height <= style.TALLEST for each in figures)
    shown = [axes.label for each in figures for axes in each.axes]
    assert [each for each in shown if each in {*INPUTS, "u"}] == [*INPUTS, "u"]


def test_a_visit_that_goes_beyond_its_axis_has_an_arrow_there():
    visits = (memberships.Visit("base", -99.0, 1.0),)
    panel = memberships.Panel(variable="x", role="input", unit="", terms=(), visits=visits, low=0.0, high=2.0)
    (axes,) = memberships.membership_plot([panel]).axes
    kinds = [each.kind for each in axes.marks if each.label == "beyond"]
    assert kinds == ["left"]


@pytest.mark.parametrize("count", [1, 9, 10, 11, 25])
def test_the_points_of_many_requirements_fill_as_many_figures_as_are_needed(count):
    one = EnvelopeVerdict(
        requirement=requirement(),
        status=Status.PASS,
        measured=Status.PASS,
        passed=3,
        needed=3,
        worst=0,
        value=1.0,
        values=np.arange(3.0),
        statuses=(Status.PASS,) * 3,
        definition="",
        reason="",
    )
    shown = [replace(one, requirement=requirement(id=f"R-{each}")) for each in range(count)]
    parts = envelopes.parted(shown)
    assert [each for part in parts for each in part] == shown
    assert all(envelopes._draw(part).height <= style.TALLEST for part in parts)


def run(label, events=()):
    return Shown(label=label, trace=replace(trace(), events=events), duration=60.0, verdicts=(verdict(),))


def many_lanes(count):
    return [Lane(signal="crane.distance", names=(f"{LONG}{each}",), unit="m") for each in range(count)]


@pytest.mark.parametrize("count", [1, 2, 5, 16])
def test_runs_with_long_names_leave_less_room_for_axes(count):
    runs = [run(f"{each}{LONG}") for each in range(count)]
    for page in pages(many_lanes(20), runs):
        assert time_plot(runs, page).height <= style.TALLEST


def test_events_with_many_names_leave_less_room_for_axes():
    events = tuple(
        BlockEvent(tick=each * 10**9, block=f"controller.block_{each}", name="SAT", warning=False)
        for each in range(12)
    )
    runs = [run("base", events)]
    for page in pages([*lanes(runs[0]), *many_lanes(20)], runs):
        assert time_plot(runs, page).height <= style.TALLEST
