"""`fcl-sim judge`: a recorded trace against the requirements that a run has to meet."""

import json

LOG = "time [s],crane.sway [deg]\n0,0\n0.5,6\n1,-3\n"
SCENARIO = "scenarios/crane/short.toml"


def log(bench, text=LOG):
    (bench / "log.csv").write_text(text)
    return "log.csv"


def test_a_trace_that_meets_its_requirements_is_green(invoke, bench):
    result = invoke("judge", log(bench), "--with", SCENARIO)
    assert (result.exit_code, result.stderr) == (0, "")
    heading, row, sentence = result.stdout.splitlines()
    assert heading.split() == ["scenario", "variant", "requirement", "asked", "measured", "verdict"]
    assert row.split() == ["crane/short", "base", "S-1", "at", "most", "9", "deg", "6", "deg", "PASS"]
    assert sentence == "1 verdict: 1 PASS."


def test_units_of_the_recording_may_be_others(invoke, bench):
    result = invoke("judge", log(bench, "time [ms],crane.sway [rad]\n0,0\n1000,0.2\n"), "--with", SCENARIO)
    assert result.exit_code == 1
    assert result.stdout.splitlines()[1].split()[-3:] == ["0.2", "rad", "FAIL"]


def test_json_is_one_document(invoke, bench):
    result = invoke("judge", log(bench), "--with", SCENARIO, "--json")
    made = json.loads(result.stdout)
    assert (made["schema"], made["verdict"], made["trace"], made["scenario"]) == (
        1,
        "PASS",
        "log.csv",
        "crane/short",
    )
    assert [(each["id"], each["value"]) for each in made["requirements"]] == [("S-1", 6.0)]


def test_a_formula_is_asked_of_a_recording_as_well(invoke, bench):
    file = bench / SCENARIO
    text = file.read_text()
    begin = text.index("metric = ")
    file.write_text(text[:begin] + 'formula = "always[0 s, 2 s] abs(crane.sway) < 9 deg"\n')
    result = invoke("judge", log(bench), "--with", SCENARIO)
    assert result.exit_code == 1
    assert "the formula holds" in result.stdout
    assert "INCONCLUSIVE" in result.stdout


def test_a_signal_that_was_not_recorded_is_told_with_the_nearest(invoke, bench):
    result = invoke("judge", log(bench, "time [s],crane.swai [deg]\n0,0\n"), "--with", SCENARIO)
    assert result.exit_code == 3
    assert "error[SCN403]: there is no signal called `crane.sway`" in result.stderr
    assert "did you mean `crane.swai`?" in result.stderr


def test_a_variant_that_does_not_exist_is_told(invoke, bench):
    result = invoke("judge", log(bench), "--with", SCENARIO, "--variant", "bse")
    assert result.exit_code == 3
    assert "SCN405" in result.stderr


def test_without_a_scenario_it_is_wrong_usage(invoke, bench):
    assert invoke("judge", log(bench)).exit_code == 2
