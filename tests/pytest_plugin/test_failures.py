"""What a reader gets of a verdict: on the terminal, and in JUnit XML."""

import junitparser
import pytest

pytest_plugins = ("pytester",)

FILE = "scenarios/bath/heat.toml"


@pytest.fixture
def missing(bench):
    """The bench, where the bath becomes warmer than it may."""
    bench.edit(FILE, 'max    = "45 degC"', 'max    = "25 degC"')
    return bench


def told(result):
    """Return the lines of the first failure."""
    lines = result.outlines
    begin = next(number for number, line in enumerate(lines) if "= FAILURES =" in line)
    end = next(n for n, line in enumerate(lines) if n > begin + 1 and line.startswith(("___", "===")))
    return lines[begin + 1 : end]


def test_a_failure_points_at_the_requirement_and_at_what_it_asks(missing):
    heading, *rest = told(missing.run("-k", "base and B-1"))
    assert heading.strip("_ ") == "bath/heat base B-1"
    assert "\n".join(rest) == (
        "scenarios/bath/heat.toml:24:10: error[JDG402]: B-1 is FAIL in the run `base`: The largest magnitude "
        "of bath.temperature is 28.57 degC; at most 25 degC is allowed, first violated from 3 s to 60 s.\n"
        '  24 | id     = "B-1"\n'
        "     |          ^^^^^\n"
        "  scenarios/bath/heat.toml:27:10: measured 28.57\N{NO-BREAK SPACE}degC\n"
        '  27 | max    = "25 degC"\n'
        "     |          ^^^^^^^^^\n"
        "  required: The bath stays below 45 degC\n"
        "  measured: largest |signal| in the window"
    )


def test_the_summary_and_the_short_form_say_it_in_a_line(missing):
    result = missing.run("-k", "base and B-1", "--tb=line", "-rf")
    result.stdout.fnmatch_lines(
        [
            "*scenarios/bath/heat.toml:24: B-1 is FAIL in the run `base`: *",
            f"FAILED {FILE}::base::B-1 - B-1 is FAIL*",
        ]
    )


@pytest.mark.parametrize("style", ["auto", "long", "short", "native"])
def test_no_style_shows_a_traceback_of_ours(missing, style):
    result = missing.run("-k", "base and B-1", f"--tb={style}")
    result.stdout.no_fnmatch_line("*items.py*")
    result.stdout.fnmatch_lines(["  24 | id *"])


def test_an_unexpected_pass_is_red(bench):
    bench.edit(FILE, 'expect  = { slow = "fail" }', 'expect  = "fail"')
    result = bench.run("-k", "B-2")
    result.assert_outcomes(passed=1, failed=1, deselected=4)
    result.stdout.fnmatch_lines(["*A miss was expected: the expectation no longer holds.*"])


def test_a_requirement_over_an_envelope_is_an_item_of_its_own(bench):
    text = (bench.folder / FILE).read_text("utf-8").replace('max    = "45 degC"', 'max    = "29 degC"')
    bench.write(FILE, f'{text}\n[vary]\n"plant.parameters.gain" = ["0.5 K/%", "2 K/%"]\n')
    assert bench.collected("-k", "base and envelope") == [
        f"{FILE}::base::B-1[envelope]",
        f"{FILE}::base::B-2[envelope]",
    ]
    result = bench.run("-m", "fcl_sim(variant='base', requirement='B-1')")
    result.assert_outcomes(passed=1, failed=1, deselected=8)
    result.stdout.fnmatch_lines(
        ["*B-1 is FAIL over the envelope of the run `base`: 1 of 2 points meet it; worst at *"]
    )


def test_a_run_of_which_nothing_is_asked_still_has_its_baseline(bench):
    text = (bench.folder / FILE).read_text("utf-8")
    bench.write(FILE, text.partition("[[require]]")[0])
    bench.run().assert_outcomes(failed=2)
    assert bench.collected() == [f"{FILE}::base::baseline", f"{FILE}::slow::baseline"]


def cases(bench, result_file="junit.xml"):
    """Return the cases of pytest's JUnit XML by run and name."""
    suite = next(iter(junitparser.JUnitXml.fromfile(str(bench.folder / result_file))))
    return {(case.classname.rpartition(".")[2], case.name): case for case in suite}


def properties(case):
    return {each.name: each.value for each in case.child(junitparser.Properties)}


def test_junit_has_the_figures_as_properties(missing):
    missing.run("--junitxml=junit.xml")
    read = cases(missing)
    failed = read["base", "B-1"]
    assert {name: properties(failed)[name] for name in ("verdict", "metric", "signal", "unit", "max")} == {
        "verdict": "FAIL",
        "metric": "peak",
        "signal": "bath.temperature",
        "unit": "degC",
        "max": "25.0",
    }
    assert float(properties(failed)["value"]) == pytest.approx(200 / 7, abs=1e-2)
    (failure,) = failed.result
    assert failure.message.startswith("B-1 is FAIL in the run `base`: ")
    assert 'max    = "25 degC"' in failure.text
    assert properties(read["slow", "B-2"])["expect"] == "fail"
    assert read["slow", "B-2"].is_passed
    assert properties(read["base", "baseline"])["verdict"] == "NO BASELINE"
