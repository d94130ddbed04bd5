"""Results as data: complete, the same from the same inputs, readable by any JSON reader."""

import json
import math
from dataclasses import replace

from fcl_sim.judge.verdict import Status
from fcl_sim.loop.trace import BlockEvent
from fcl_sim.report import document
from fcl_sim.report.content import run_text
from fcl_sim.report.results import text
from fcl_sim.report.summary import overall, rows, sentence
from tests.report.synthetic import of_formula, outcome, run, verdict


def test_the_document_says_its_schema_and_what_made_it(tmp_path):
    made = document([outcome(tmp_path, run(tmp_path))])
    assert made["schema"] == 1
    assert set(made["versions"]) == {"fcl_sim", "python", "numpy", "numba"}


def test_every_verdict_is_there_with_its_value_and_bound(tmp_path):
    made = document([outcome(tmp_path, run(tmp_path), run(tmp_path, "raw_distance", "swings"))])
    base, raw = made["scenarios"][0]["variants"]
    assert [each["id"] for each in base["requirements"]] == ["CR-1", "CR-2"]
    first = base["requirements"][0]
    assert (first["value"], first["maximum"], first["minimum"], first["unit"]) == (25.4, 35.0, None, "s")
    missed = raw["requirements"][0]
    assert (missed["verdict"], missed["measured"], missed["expect_fail"]) == ("PASS", "FAIL", True)
    assert missed["violation_s"] == [35.0, 60.0]


def test_a_formula_is_there_with_its_signals_and_its_robustness(tmp_path):
    judged = of_formula("never crane.sway > 3 deg")
    made = json.loads(text([outcome(tmp_path, run(tmp_path, verdicts=(judged,)))]))
    (asked,) = made["scenarios"][0]["variants"][0]["requirements"]
    assert asked["formula"] == "never crane.sway > 3 deg; that is: always (not (crane.sway > 3 deg))"
    assert (asked["metric"], asked["signal"], asked["signals"]) == (None, "crane.sway", ["crane.sway"])
    assert (asked["value"], asked["unit"]) == (0.5, "deg")


def test_files_stand_with_their_hashes(tmp_path):
    made = document([outcome(tmp_path, run(tmp_path))])
    inputs = made["scenarios"][0]["inputs"]
    assert [each["role"] for each in inputs] == ["scenario", "rule base", "plant"]
    assert all(len(each["sha256"]) == 64 for each in inputs)


def test_a_fault_is_told(tmp_path):
    made = document([outcome(tmp_path, run(tmp_path, kind="fault"))])
    assert made["verdict"] == "FAULT"
    assert made["scenarios"][0]["variants"][0]["fault"] == {
        "time_ns": 19_500_000_000,
        "signal": "crane.distance",
        "reason": "the integrator cannot reach its tolerance",
    }


def test_what_blocks_reported_is_told_once_for_each_block_and_event(tmp_path):
    given = run(tmp_path)
    late, early = BlockEvent(9 * 10**9, "press", "OVERFLOW", False), BlockEvent(10**9, "temp", "W", True)
    events = (early, late, replace(late, tick=12 * 10**9))
    made = outcome(tmp_path, replace(given, trace=replace(given.trace, events=events)))
    assert document([made])["scenarios"][0]["variants"][0]["events"] == [
        {"block": "temp", "event": "W", "warning": True, "times": 1, "first_ns": 10**9},
        {"block": "press", "event": "OVERFLOW", "warning": False, "times": 2, "first_ns": 9 * 10**9},
    ]
    told = run_text(made, made.base).replace("\N{NO-BREAK SPACE}", " ")
    assert told == "temp reported W once, at 1 s. press reported OVERFLOW 2 times, first at 9 s."
    assert document([outcome(tmp_path, given)])["scenarios"][0]["variants"][0]["events"] == []


def test_what_json_has_no_number_for_is_null(tmp_path):
    odd = run(tmp_path, verdicts=(verdict(Status.FAIL, math.inf, maximum=math.nan),))
    made = json.loads(text([outcome(tmp_path, odd)]))
    asked = made["scenarios"][0]["variants"][0]["requirements"][0]
    assert (asked["value"], asked["maximum"]) == (None, None)


def test_the_rows_of_the_summary_follow_scenarios_variants_and_requirements(tmp_path):
    found = list(rows([outcome(tmp_path, run(tmp_path), run(tmp_path, "raw_distance", "swings"))]))
    assert [(each.variant, each.id, each.status, each.shown) for each in found] == [
        ("base", "CR-1", Status.PASS, "PASS"),
        ("base", "CR-2", Status.PASS, "PASS"),
        ("raw_distance", "CR-1", Status.PASS, "EXPECTED MISS"),
    ]
    assert not any(each.note for each in found)
    assert {each.scenario for each in found} == {"crane/transfer"}


def test_the_sentence_counts_and_names_expected_misses(tmp_path):
    made = outcome(tmp_path, run(tmp_path), run(tmp_path, "raw_distance", "swings"))
    assert sentence([made]) == (
        "1 scenario, 2 runs, 3 verdicts: 3 PASS. "
        "One of those that pass is expected to miss its bound, and does."
    )
    assert sentence([]) == "Nothing was run."
    assert overall([]) is Status.UNTESTED
