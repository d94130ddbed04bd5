"""The life of a baseline under pytest."""

import pytest

pytest_plugins = ("pytester",)

BASELINE = "scenarios/bath/baselines/heat.base.toml"
REASON = "the first bath"


@pytest.mark.parametrize("workers", [0, 1])
def test_it_is_red_until_it_was_accepted_and_again_when_the_run_changes(bench, workers):
    bench.edit("scenarios/bath/heat.toml", '[variants.slow]\n"plant.parameters.time_constant" = "20 s"\n', "")
    bench.edit("scenarios/bath/heat.toml", 'expect  = { slow = "fail" }', "")
    stages = []

    def run(*arguments):
        result = bench.run(*arguments, workers=workers)
        stages.append({name: n for name, n in result.parseoutcomes().items() if name in {"passed", "failed"}})
        return result

    if not workers:  # whose start takes seconds
        fresh = run()
        fresh.stdout.fnmatch_lines(["*the run `base` has NO BASELINE", "*pytest --update-baseline REASON"])
        assert not (bench.folder / BASELINE).exists()
    written = run("--update-baseline", REASON)
    written.stdout.fnmatch_lines(["*NO BASELINE*", f"*written: {BASELINE}; the next run is held against it"])
    assert REASON in (bench.folder / BASELINE).read_text("utf-8")
    run()
    bench.edit("scenarios/bath/bath.fcl", "TERM full := 100", "TERM full := 97")
    if not workers:
        run()
    changed = run("--update-baseline", "97 % is all that the heater gives")
    changed.stdout.fnmatch_lines(
        [
            "*error[[]JDG407[]]: the run `base` leaves its baseline of *",
            "*B-1, peak of bath.temperature: * → *",
        ]
    )
    run()
    red, green = {"passed": 2, "failed": 1}, {"passed": 3}
    assert stages == ([red, green, red, green] if workers else [red, red, green, red, red, green])


def test_an_update_without_a_reason_is_wrong_usage(bench):
    result = bench.run("--update-baseline", " ")
    assert result.ret == pytest.ExitCode.USAGE_ERROR
    result.stderr.fnmatch_lines(["ERROR: --update-baseline: say why the runs are accepted as they are"])


def test_only_the_chosen_runs_are_accepted(bench):
    bench.run("--update-baseline", REASON, "-k", "slow")
    assert [file.name for file in (bench.folder / BASELINE).parent.iterdir()] == ["heat.slow.toml"]


def test_a_baseline_that_is_kept_is_not_written_anew(bench):
    bench.accept()
    before = (bench.folder / BASELINE).read_bytes()
    bench.run("--update-baseline", "for another reason").assert_outcomes(passed=6)
    assert (bench.folder / BASELINE).read_bytes() == before


def test_a_run_that_broke_down_is_not_accepted(bench):
    bench.edit("scenarios/bath/bath.fcl", "DEFAULT := 0", "DEFAULT := nan")
    bench.edit("scenarios/bath/bath.fcl", "TERM cold := (20, 1) (40, 0)", "TERM cold := (20, 1) (30, 0)")
    bench.edit("scenarios/bath/bath.fcl", "TERM warm := (20, 0) (40, 1)", "TERM warm := (90, 0) (99, 1)")
    result = bench.run("--update-baseline", REASON, "-m", "fcl_sim(variant='base', baseline=True)")
    result.assert_outcomes(failed=1, deselected=5)
    result.stdout.fnmatch_lines(["*error[[]RUN108[]]*"])
    assert not (bench.folder / BASELINE).exists()


def test_the_baseline_of_a_run_that_is_no_more_fails(bench):
    bench.accept()
    bench.edit("scenarios/bath/heat.toml", '[variants.slow]\n"plant.parameters.time_constant" = "20 s"\n', "")
    bench.edit("scenarios/bath/heat.toml", 'expect  = { slow = "fail" }', "")
    result = bench.run()
    result.assert_outcomes(passed=3, failed=1)
    lost = "scenarios/bath/baselines/heat.slow.toml"
    result.stdout.fnmatch_lines([f"{lost}: error[[]JDG408[]]: this is the baseline of a run that bath*"])
    assert f"{lost.replace('baselines/', 'heat.toml::')}" in bench.collected("-m", "fcl_sim(baseline=True)")
