"""`fcl-sim replay`: a log beside what a rule base makes of it."""

import csv
import json

RULES = "scenarios/crane/crane_completed.fcl"


def log(bench, *columns, rows=((24.0, 0.0, 9.0), (12.0, 4.0, 20.0))):
    lines = [f"time [s],{','.join(columns)}"]
    lines += [",".join(map(str, (0.05 * place, *row[: len(columns)]))) for place, row in enumerate(rows)]
    (bench / "log.csv").write_text("\n".join(lines) + "\n")
    return "log.csv"


def test_the_trace_of_a_run_is_reproduced(invoke, bench):
    invoke("run", "scenarios/crane/short.toml", "--no-report", "--trace", "t.npz")
    result = invoke("replay", RULES, "t.npz", "--absolute", 0)
    assert (result.exit_code, result.stderr) == (0, "")
    assert result.stdout.splitlines() == [
        "container_crane_25 in REAL: 21 samples",
        "power: agrees in 21 samples (tolerance 0); no difference",
    ]


def test_the_first_sample_that_deviates_is_told_with_its_rules(invoke, bench):
    result = invoke("replay", RULES, log(bench, "distance [m]", "angle [deg]", "power [kW]"))
    assert result.exit_code == 1
    _, line, _, first, inputs, *told = result.stdout.splitlines()
    assert line.startswith("power: 1 of 2 samples deviate (tolerance 0.00054); most ")
    assert first.startswith("First in sample 2, at 0.05 s: power is ")
    assert first.endswith(", and `power` has 20")
    assert inputs == "  distance = 12, angle = 4"
    assert told[0] == "  distance: medium 0.8333, far 0.1667"
    assert told[1] == "  angle: zero 0.2, pos_small 0.8"
    assert (
        told[2] == "      0.8  rule 22: IF distance IS medium AND angle IS pos_small THEN power IS pos_high"
    )


def test_without_outputs_the_log_is_evaluated_and_printed_or_written(invoke, bench):
    name = log(bench, "plc.s [m]", "plc.angle [deg]")
    result = invoke("replay", RULES, name, "--map", "plc.s=distance", "--arithmetic", "LREAL")
    assert result.exit_code == 0
    header, first, _ = csv.reader(result.stdout.splitlines())
    assert header == ["time [s]", "distance [m]", "angle [deg]", "power [1]"]
    assert [float(each) for each in first] == [0.0, 24.0, 0.0, 9.0]
    result = invoke("replay", RULES, name, "--map", "plc.s=distance", "--write", "out.csv")
    assert (result.stdout, result.stderr) == ("", "written: out.csv\n")
    assert "container_crane_25.degree(1) [1]" in (bench / "out.csv").read_text()


def test_json_is_one_document(invoke, bench):
    name = log(bench, "distance [m]", "angle [deg]", "power [kW]")
    made = json.loads(invoke("replay", RULES, name, "--json").stdout)
    assert (made["schema"], made["samples"], made["arithmetic"]) == (1, 2, "REAL")
    (power,) = made["outputs"]
    assert (power["deviating"], power["first"]["sample"], power["first"]["recorded"]) == (1, 2, 20.0)
    assert made["terms"]["distance"].keys() == {"medium", "far"}
    assert made["rules"][0]["label"] == "22"


def test_a_log_that_lacks_an_input_says_how_to_name_it(invoke, bench):
    result = invoke("replay", RULES, log(bench, "distanse [m]", "angle [deg]"))
    assert result.exit_code == 3
    assert "log.csv: error[VER201]: no column is the input `distance`" in result.stderr
    assert "hint: if it is `distanse`, say so: --map distanse=distance" in result.stderr
    assert invoke("replay", RULES, "log.csv", "--map", "distance").exit_code == 2
