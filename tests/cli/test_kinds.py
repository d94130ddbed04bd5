"""A file of another kind than the command takes: what it is, and the command that takes it."""

import shutil

import pytest

from fcl_sim.scenario.kinds import File, kind_of

CRANE = "scenarios/crane"
FCL, TOML = f"{CRANE}/crane_completed.fcl", f"{CRANE}/short.toml"
CONTROLLER, BASELINE = f"{CRANE}/crane.controller.toml", f"{CRANE}/baselines/short.base.toml"
NO_TRACE = "`fcl-sim run SCENARIO.toml --trace TRACE.csv` writes a trace"

TOLD = [
    (("run", FCL), "RUN105]: this is a rule base, not a scenario", f"`fcl-sim check {FCL}` checks it"),
    (("run", FCL), "RUN105", f"`fcl-sim eval {FCL} NAME=NUMBER ...` evaluates it"),
    (
        ("run", CONTROLLER),
        "RUN105]: this is a controller",
        '[controller] has the key file = "crane.controller',
    ),
    (
        ("run", "reports/results.json"),
        "these are the results of a run",
        "`fcl-sim report reports/results.json",
    ),
    (
        ("run", "reports/report.pdf"),
        "this is a report, not a scenario",
        "`fcl-sim report reports/results.json",
    ),
    (("run", "crane.py"), "this is a plant, not a scenario", '[plant] has the key model = "crane"'),
    (("baseline", "show", FCL), "this is a rule base", "fcl-sim check"),
    (("check", FCL, "--scenario", FCL), "this is a rule base, not a scenario", "fcl-sim check"),
    (("check", FCL, "--with", TOML), "VER205]: this is a scenario, not the results", f"`fcl-sim run {TOML}`"),
    (("report", TOML), "RUN204]: this is a scenario, not the results of a run", f"`fcl-sim run {TOML}` runs"),
    (
        ("report", BASELINE),
        "this is a baseline, not",
        "`fcl-sim run SCENARIO.toml` writes results and report",
    ),
    (("report", "reports/report.pdf"), "this is a report", "`fcl-sim report reports/results.json` writes it"),
    (
        ("report", "reports/results.npz"),
        "what a run has stored",
        "`fcl-sim report reports/results.json` makes",
    ),
    (("report", "scenarios"), "there is no results.json in this folder", "`fcl-sim run` writes it"),
    (
        ("judge", TOML, "--with", TOML),
        "JDG301]: this is a scenario",
        f"`fcl-sim run {TOML} --trace TRACE.csv`",
    ),
    (("judge", "reports/results.json", "--with", TOML), "these are the results of a run, not a tr", NO_TRACE),
    (("judge", "x.csv", "--with", FCL), "this is a rule base, not a scenario", "fcl-sim check"),
    (
        ("judge", "x.csv", "--with", CRANE),
        "this is a folder, not a scenario",
        "name a file in it: short.toml",
    ),
    (("replay", FCL, FCL), "JDG301]: this is a rule base, not a trace", NO_TRACE),
    (("replay", TOML, "x.csv"), "FCL103]: this is a TOML file, not a rule base", "`fcl-sim run` takes scen"),
    (("eval", TOML), "FCL103]: this is a TOML file", "a rule base is a .fcl file"),
    (("fmt", TOML), "FCL103]: this is a TOML file", "a rule base is a .fcl file"),
]


@pytest.fixture
def reported(invoke, bench):
    """Stand in the bench with a report, and with a plant."""
    assert invoke("run").exit_code == 0
    (bench / "crane.py").write_text("")
    return bench


@pytest.mark.parametrize(("arguments", "message", "hint"), TOLD)
def test_it_is_told_with_the_command_that_takes_it(invoke, reported, arguments, message, hint):
    result = invoke(*arguments)
    told = result.stdout + result.stderr
    assert (result.exit_code, message in told, hint in told) == (3, True, True), told
    assert "codec" not in told


def test_the_folder_of_a_report_stands_for_its_results(invoke, reported):
    before = (reported / "reports/report.pdf").read_bytes()
    (reported / "reports/report.pdf").unlink()
    assert invoke("report", "reports").exit_code == 0
    assert (reported / "reports/report.pdf").read_bytes() == before


def test_a_check_goes_on_to_the_next_file(invoke, bench):
    shutil.copy(TOML, "other.toml")
    result = invoke("check", "other.toml", FCL)
    assert "2 files: 1 error" in result.stdout


@pytest.mark.parametrize(
    ("name", "kind"),
    [
        ("a.toml", File.SCENARIO),
        ("a.controller.toml", File.CONTROLLER),
        ("a.waivers.toml", File.WAIVERS),
        ("baselines/a.base.toml", File.BASELINE),
        ("A.FCL", File.RULE_BASE),
        ("a.npz", File.TRACE),
        ("notes.txt", None),
    ],
)
def test_a_kind_is_told_by_the_name(tmp_path, name, kind):
    assert kind_of(tmp_path / name) is kind
