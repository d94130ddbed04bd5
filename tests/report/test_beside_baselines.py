"""What left its baseline can be read: run by run, its cause once, each line as wide as the column."""

from dataclasses import replace

import pikepdf
import pytest

from fcl_sim.judge.baseline import Baseline, Comparison, Figure, MetricChange, SignalChange
from fcl_sim.judge.verdict import Status
from fcl_sim.report import baselines, summary, write
from fcl_sim.report.content import report_data, requirement_rows
from fcl_sim.report.gather import gathered
from fcl_sim.verify.cause import Cause, Divergence
from fcl_sim.verify.edits import Edit
from tests.report.reading import bare, page_words
from tests.report.synthetic import outcome, run, verdict

FORMULA = (
    "robustness of within 3 s (abs(controller.error) < 20 rpm) for good; that is: eventually[0 s, 3 s] ..."
)
EDIT = Edit(kind="rule", owner="r", name="7", old="RULE 7: IF a THEN b", new="RULE 7: IF a THEN c")


def metric(name, about="settling_time of crane.distance", new=None):
    new = new or Figure(None, "never")
    return MetricChange(id=name, about=about, unit="s", status=Status.FAIL, old=Figure(25.0), new=new)


def signal(name):
    return SignalChange(
        name=name, unit="kW", status=Status.FAIL, time=5.25, value=23.4, low=23.7, high=24.0, farthest=27.3
    )


def left(made, cause=None, metrics=(), signals=()):
    """Return a run that left its baseline."""
    kept = Baseline(scenario="crane/transfer", variant=made.variant, date="2026-01-31", reason="first")
    compared = Comparison(status=Status.FAIL, baseline=kept, metrics=tuple(metrics), signals=tuple(signals))
    return replace(made, compared=compared, cause=cause, verdict=Status.FAIL)


def because(time, edits=(("controller.rules", EDIT),)):
    found = Divergence(time=time, signal="controller.rules.power", unit="kW", old=1.0, new=2.0, rules=())
    return Cause(edits=edits, divergence=found, is_whole=True)


def test_no_line_of_it_is_crushed_by_a_long_one(tmp_path):
    metrics = [metric(f"CR-{each}", FORMULA) for each in range(12)]
    signals = [signal(f"crane.a_signal_with_a_rather_long_name_{each}") for each in range(12)]
    runs = [left(run(tmp_path, name), because(1.0), metrics, signals) for name in ("base", "frictionless")]
    write([outcome(tmp_path, *runs)], tmp_path / "reports")
    with pikepdf.open(tmp_path / "reports" / "report.pdf") as opened:
        pages = page_words(opened)
    told = [page for page in pages if any(bare(f"CR-{each}, robustness") in page for each in range(12))]
    assert len(told) <= 3  # with a word or two to a line they take five and more


def test_it_stands_run_by_run(tmp_path):
    runs = [left(run(tmp_path, name), because(1.0), [metric("CR-1")]) for name in ("base", "light")]
    data = report_data(gathered([outcome(tmp_path, *runs)]), lambda _, picture: picture.name)
    (section,) = [
        each for each in data["scenarios"][0]["sections"] if each["title"] == "Beside the baselines"
    ]
    assert [(each["run"], len(each["rows"])) for each in section["changes"]] == [("base", 1), ("light", 1)]


def test_runs_of_one_cause_are_told_of_together_and_what_changed_once(tmp_path):
    runs = [
        left(run(tmp_path, "base"), because(1.0), [metric("CR-1")]),
        left(run(tmp_path, "light"), because(2.0), [metric("CR-1")]),
        left(run(tmp_path, "heavy"), because(2.0), [metric("CR-1")]),
    ]
    first, second = (each.replace("\N{NO-BREAK SPACE}", " ") for each in baselines.cause_texts(runs))
    assert first.startswith("Run base: edited in controller.rules: RULE 7")
    assert second.startswith("Runs light and heavy: changed as in run base; first diverging scan: 2 s,")
    assert "RULE 7" not in second


WHYS = [
    ((verdict(Status.FAIL, None),), "misses CR-1"),
    ((verdict(Status.FAIL, None), verdict(Status.FAIL, None, id="CR-7")), "misses CR-1 and CR-7"),
    ((verdict(Status.INCONCLUSIVE, None),), "leaves CR-1 open"),
    ((verdict(Status.UNTESTED, None),), "puts CR-1 to no test"),
    ((verdict(Status.FAULT, None),), "breaks down before CR-1"),
    ((verdict(Status.FAIL, None, expect_fail=True),), ""),
    ((verdict(),), ""),
]


@pytest.mark.parametrize(("verdicts", "why"), WHYS, ids=[str(each) for each in range(len(WHYS))])
def test_page_one_says_why_a_run_is_not_green(verdicts, why, tmp_path):
    made = run(tmp_path, verdicts=verdicts)
    assert summary.shortcomings(made) == why
    told = summary.shortcomings(left(made))
    assert told == "; ".join([why] * bool(why) + ["leaves its baseline"])


def test_requirements_stand_in_the_order_of_the_scenario_whatever_run_is_asked_first(tmp_path):
    one, two, three = (verdict(id=f"CR-{each}") for each in (1, 2, 3))
    made = outcome(tmp_path, run(tmp_path, verdicts=(three,)), run(tmp_path, "far", verdicts=(one, two)))
    asked = tuple(each.requirement for each in (one, two, three))
    ordered = replace(made, scenario=replace(made.scenario, requirements=asked))
    assert [each["id"] for each in requirement_rows(ordered)] == ["CR-1", "CR-2", "CR-3"]
