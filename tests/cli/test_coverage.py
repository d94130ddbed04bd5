"""`fcl-sim run --coverage`: what every rule did, and whether that is enough."""

import json

SCENARIO = "scenarios/crane/short.toml"
WAIVER = '[[waive]]\nwhat = "fired"\nrule = "{rule}"\nreason = "not within a second"\ndate = 2026-03-01\n'


def waivers(bench, *rules):
    file = bench / "scenarios" / "crane" / "crane_completed.waivers.toml"
    file.write_text("\n".join(WAIVER.format(rule=each) for each in rules), "utf-8")


def test_a_run_counts_the_rules_in_one_line_and_tells_each_on_request(invoke, bench):
    short = invoke("run", SCENARIO, "--no-report")
    assert short.exit_code == 0
    line = "Of 25 rules 2 fired, 1 dominated, 2 decided."
    assert f"{line} (--coverage tells which)" in short.stdout.splitlines()
    whole = invoke("run", SCENARIO, "--no-report", "--coverage").stdout.splitlines()
    assert line in whole
    rows = {each.split()[0]: " ".join(each.split()) for each in whole if " THEN power IS " in each}
    assert len(rows) == 25
    assert rows["1"].endswith("100 % 100 % 100 % 0 s in crane/short/base")
    assert rows["25"].endswith("– – –")
    assert "power: a rule was active in every scan." in whole


def test_what_is_required_and_missing_leaves_with_one_and_names_the_rules(invoke, bench):
    result = invoke("run", SCENARIO, "--no-report", "--require-coverage", "fired")
    assert result.exit_code == 1
    assert "crane_completed.fcl: never fired: rules 3, 4, 5," in result.stderr


def test_what_is_waived_is_not_asked(invoke, bench):
    waivers(bench, *range(3, 26))
    result = invoke("run", SCENARIO, "--no-report", "--require-coverage", "fired", "--coverage")
    assert result.exit_code == 0
    assert "23 need not, as waived." in result.stdout
    assert "need not be fired: not within a second (2026-03-01)" in result.stdout


def test_an_unused_waiver_is_a_warning_and_one_of_no_rule_an_error(invoke, bench):
    waivers(bench, 1)
    result = invoke("run", SCENARIO, "--no-report")
    assert result.exit_code == 0
    assert (
        "warning[VER107]: the waiver is not used: rule 1 is fired at 0 s in crane/short/base" in result.stderr
    )
    waivers(bench, 26)
    result = invoke("run", SCENARIO, "--no-report")
    assert result.exit_code == 3
    assert "error[VER105]: crane_completed.fcl has no rule `26`" in result.stderr


def test_json_holds_the_coverage(invoke, bench):
    waivers(bench, 25)
    made = json.loads(invoke("run", SCENARIO, "--no-report", "--json", "--decisive-by", "0.5").stdout)
    (found,) = made["coverage"]
    assert (found["function_block"], found["scans"], found["decisive_by"]) == ("container_crane_25", 21, 0.5)
    first, last = found["rules"][0], found["rules"][-1]
    assert first["fired"] == {"scans": 21, "first": {"run": "crane/short/base", "time_ns": 0}}
    assert first["decisive"]["scans"] == 0
    assert last["waived"]["decisive"] == {"reason": "not within a second", "date": "2026-03-01"}
    assert [len(each["cells"]) for each in found["inputs"]] == [6, 6]
    assert found["inputs"][0]["cells"][0] == {"low": None, "high": -5.0, "scans": 0}
    assert found["combinations"]["size"] == 25
    assert found["outputs"] == [{"variable": "power", "undefined": {"scans": 0, "first": None}}]


def test_waivers_are_no_scenario(invoke, bench):
    waivers(bench, 25)
    result = invoke("run", "scenarios/crane", "--no-report", "--set", "duration=0.1 s")
    assert "waivers" not in result.stderr
