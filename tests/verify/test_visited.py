"""Where an output is undefined, and whether runs were there."""

import json

import pytest

from fcl_sim.diagnostics import InputFault, Severity
from fcl_sim.proof.finding import found
from fcl_sim.verify.visited import joined, visits_of

GAP = found("FCL601", "`valve` is undefined", [], variable="valve")


def results(folder, scans, first, name="bath"):
    undefined = {"scans": scans, "first": first and {"run": first, "time_ns": 1_500_000_000}}
    outputs = [{"variable": "Valve", "undefined": undefined}]
    own = {
        "function_block": name,
        "file": "scenarios/bath.fcl",
        "runs": ["a", "b"],
        "scans": 40,
        "outputs": outputs,
    }
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "results.json").write_text(json.dumps({"coverage": [own]}))


def told(folder, file="other/bath.fcl", block="BATH"):
    return joined(GAP, folder / file, block, visits_of([folder])).diagnostic


def test_a_gap_in_which_a_run_was_is_an_error_with_run_and_time(tmp_path):
    results(tmp_path, 3, "bath/fill")
    assert (
        told(tmp_path).message
        == "`valve` is undefined; it was so in 3 of 40 scans, first at 1.5 s of bath/fill"
    )
    assert (told(tmp_path).code, told(tmp_path).severity) == ("FCL616", Severity.ERROR)


def test_a_gap_in_which_no_run_was_says_so(tmp_path):
    results(tmp_path, 0, None)
    assert told(tmp_path).message == "`valve` is undefined; no scan of 2 runs was there"
    assert told(tmp_path).code == "FCL601"


def test_several_results_are_added_up_and_the_first_of_them_that_was_there_is_told(tmp_path):
    results(tmp_path / "a", 0, None)
    results(tmp_path / "b", 2, "bath/b")
    results(tmp_path / "c", 3, "bath/c")
    assert told(tmp_path).message.endswith("it was so in 5 of 120 scans, first at 1.5 s of bath/b")


@pytest.mark.parametrize(("file", "block"), [("other.fcl", "bath"), ("bath.fcl", "tub")])
def test_another_rule_base_tells_nothing(tmp_path, file, block):
    results(tmp_path, 3, "bath/fill")
    assert told(tmp_path, file, block) == GAP.diagnostic


@pytest.mark.parametrize("text", ["", "[]", '{"coverage": 1}', '{"coverage": [{}]}'])
def test_what_are_no_results_is_refused(tmp_path, text):
    (tmp_path / "results.json").write_text(text)
    with pytest.raises(InputFault, match="VER205"):
        visits_of([tmp_path])


def test_a_folder_without_results_is_refused(tmp_path):
    with pytest.raises(InputFault, match=r"there is no results\.json below this folder"):
        visits_of([tmp_path])
