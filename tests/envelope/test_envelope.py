"""An envelope is its points, each run as it would be alone: their order, their verdicts, the worst."""

import math
import weakref

import numpy as np
import pytest

from fcl_sim import testbench
from fcl_sim.envelope import execute
from fcl_sim.judge.verdict import Status
from fcl_sim.scenario.reader import read

MASS, START, SEED = "plant.parameters.load_mass", "plant.start.position", "timing.seed"
GRID = f"""
[vary]
{SEED} = [1, 2]
{MASS} = ["10 t", "40 t"]
{START} = {{ from = "-30 m", to = "-10 m", count = 3 }}
"""


def envelope(file, overrides=None, workers=None, variant="base"):
    return testbench.run(file, overrides, workers).variants[variant].envelope


def test_the_points_are_every_combination_and_the_first_axis_varies_slowest(written):
    found = envelope(written(GRID))
    assert len(found) == 12
    assert found.points == tuple(
        {SEED: seed, MASS: mass, START: start}
        for seed in (1, 2)
        for mass in ("10 t", "40 t")
        for start in ("-30 m", "-20 m", "-10 m")
    )


def test_a_point_comes_out_as_a_run_of_it_alone_does_to_the_last_bit(written):
    file = written(GRID)
    found = envelope(file)
    for index, point in enumerate(found.points):
        alone = testbench.run(file, {**point, "vary": False})
        for verdict, over in zip(alone.base.verdicts, found.verdicts, strict=True):
            assert over.values[index] == (math.nan if verdict.value is None else verdict.value)
            assert over.statuses[index] is verdict.status


@pytest.mark.parametrize(
    "vary",
    [
        f'{MASS} = ["10 t", "40 t"]\n{START} = ["-30 m", "-10 m"]',
        'duration = ["4 s", "8 s"]\n"controller.scan" = ["50 ms", "100 ms"]',
        '"controller.blocks.speed.filter" = ["50 ms", "500 ms"]\n"blocks.seen.noise" = ["0 m", "5 cm"]',
        """integration = [{ scheme = "rk4", step = "5 ms" }, { scheme = "dormand_prince" }]
        "controller.blocks.rules.arithmetic" = ["REAL", "LREAL"]""",
    ],
)
def test_the_trace_of_the_worst_point_is_that_of_a_run_of_it_alone(written, vary):
    file = written(f"[vary]\n{vary}")
    found = envelope(file)
    assert found.worst_runs
    for index, run in found.worst_runs.items():
        alone = testbench.run(file, {**found.points[index], "vary": False}).base
        assert np.array_equal(run.trace.values, alone.trace.values)
        assert np.array_equal(run.trace.ticks, alone.trace.ticks)
        assert [each.value for each in run.verdicts] == [each.value for each in alone.verdicts]
        assert run.trace.constants == alone.trace.constants
        assert run.diagram.timing == alone.diagram.timing


def test_the_number_of_threads_changes_nothing(written):
    file = written(GRID)
    one, *others = [envelope(file, workers=workers) for workers in (1, 2, 5)]
    for other in others:
        for mine, theirs in zip(one.verdicts, other.verdicts, strict=True):
            assert mine.values.tobytes() == theirs.values.tobytes()
            assert (mine.statuses, mine.worst, mine.reason) == (theirs.statuses, theirs.worst, theirs.reason)
        assert one.worst_runs.keys() == other.worst_runs.keys()


def test_few_points_are_under_way_at_a_time_and_only_the_worst_keep_their_traces(written, monkeypatch):
    alive, most = set(), 0
    true_run = execute.run_tape

    def counted(tape, halt):
        nonlocal most
        trace = true_run(tape, halt)
        alive.add(id(tape))
        most = max(most, len(alive))
        weakref.finalize(trace, alive.discard, id(tape))
        return trace

    monkeypatch.setattr(execute, "run_tape", counted)
    file = written(f'[vary]\n{START} = {{ from = "-30 m", to = "-10 m", count = 60 }}\nduration = ["1 s"]')
    found = envelope(file, workers=2)
    assert len(found.worst_runs) <= 2
    assert most <= 2 + len(found.worst_runs)


def test_the_worst_point_is_that_with_the_least_margin(written):
    speed, sway = envelope(written(GRID)).verdicts
    assert speed.worst == int(np.argmax(speed.values))
    assert speed.value == speed.values.max()
    assert sway.worst == int(np.argmin(sway.values))


def test_a_nominal_run_is_what_it_is_without_an_envelope(written):
    with_it, without = testbench.run(written(GRID)), testbench.run(written(""))
    assert without.base.envelope is None
    assert np.array_equal(with_it.trace.values, without.trace.values)
    assert with_it.metrics == without.metrics


def test_a_requirement_over_the_points_fails_the_run_though_the_nominal_one_passes(written):
    outcome = testbench.run(written(GRID.replace("-30 m", "-60 m"), LIMIT.format(more="")))
    assert outcome.base.verdicts[0].status is Status.PASS
    (verdict,) = outcome.base.envelope.verdicts
    assert 0 < verdict.passed < verdict.points
    assert verdict.status is outcome.base.verdict is outcome.verdict is Status.FAIL
    assert verdict.statuses[verdict.worst] is Status.FAIL


LIMIT = """
[[require]]
id     = "E-1"
text   = "It has not gone far yet"
metric = {{ peak = {{ signal = "crane.distance" }} }}
max    = "40 m"
{more}
"""


@pytest.mark.parametrize(
    ("asked", "status"),
    [
        ("at_least = 8", Status.PASS),
        ("at_least = 9", Status.FAIL),
        ('at_least = "60 %"', Status.PASS),
        ('at_least = "70 %"', Status.FAIL),
        ("at_least = { base = 8 }", Status.PASS),
        ('at_least = 4\nexpect = "fail"\nover = "points"', Status.PASS),
        ('at_least = 5\nexpect = "fail"\nover = "points"', Status.FAIL),
    ],
)
def test_at_least_so_many_points_must_come_out_as_required(written, asked, status):
    file = written(GRID.replace("-30 m", "-60 m"), LIMIT.format(more=asked))
    (verdict,) = envelope(file).verdicts
    assert verdict.status is status
    assert verdict.passed == (4 if "expect" in asked else 8)


def test_a_requirement_over_the_nominal_run_or_the_points_alone_is_asked_there_alone(written):
    nominal = testbench.run(written(GRID, LIMIT.format(more='over = "nominal"'))).base
    assert (len(nominal.verdicts), len(nominal.envelope.verdicts)) == (1, 0)
    points = testbench.run(written(GRID, LIMIT.format(more='over = "points"'))).base
    assert (len(points.verdicts), len(points.envelope.verdicts)) == (0, 1)
    assert points.envelope.verdict is Status.PASS
    assert points.verdict is Status.NO_BASELINE  # of a run that nobody has accepted yet


def test_a_mean_is_judged_over_all_points_and_its_bound_at_none_of_them(written):
    file = written(GRID.replace("-30 m", "-60 m"), LIMIT.format(more='over = "mean"'))
    outcome = testbench.run(file)
    (verdict,) = outcome.base.envelope.verdicts
    assert outcome.base.verdicts == ()
    assert verdict.values.max() > 40.0
    assert verdict.value == verdict.values.mean() < 40.0
    assert verdict.status is Status.PASS
    assert verdict.worst == int(np.argmax(verdict.values))


def test_there_is_no_mean_of_what_does_not_happen_at_every_point(written):
    metric = '{ settling_time = { signal = "crane.distance", final = "0 m", band = "15 m" } }'
    asked = f'[[require]]\nid = "M"\ntext = "M"\nmetric = {metric}\nmax = "5 s"\nover = "mean"'
    (verdict,) = envelope(written(GRID, asked)).verdicts
    assert (verdict.status, verdict.value) == (Status.FAIL, None)
    assert "does not settle at" in verdict.reason


def test_a_variant_lays_its_grid_over_that_of_the_scenario(written):
    file = written(f"""
{GRID}
[variants.coarse.vary]
"{START}" = {{ count = 2 }}
[variants.heavy]
"{MASS}" = "28 t"
[variants.alone]
vary = false
[variants.pinned]
"{MASS}" = "28 t"
"{START}" = "-12 m"
"{SEED}" = 3
""")
    runs = testbench.run(file).variants
    assert {name: run.envelope and run.envelope.grid.shape for name, run in runs.items()} == {
        "base": (2, 2, 3),
        "coarse": (2, 2, 2),
        "heavy": (2, 3),
        "alone": None,
        "pinned": None,
    }
    assert runs["coarse"].envelope.points[1][START] == "-10 m"
    assert runs["heavy"].envelope.worst_runs
    for run in runs["heavy"].envelope.worst_runs.values():
        assert run.diagram.plant.parameters["load_mass"] == 28_000.0


def test_an_override_takes_its_key_out_of_the_grid(written):
    found = envelope(written(GRID), {MASS: "15 t"})
    assert found.grid.shape == (2, 3)


def test_what_is_switched_off_stays_off_whatever_a_variant_lays_over_it(written):
    file = written(f'{GRID}\n[variants.coarse.vary]\n"{START}" = {{ count = 2 }}')
    assert [run.envelope for run in testbench.run(file, {"vary": False}).variants.values()] == [None, None]


def test_points_are_compared_with_the_same_points_of_a_variant(written):
    asked = """
[[require]]
id          = "R"
text        = "The light one swings more"
metric      = { peak = { signal = "crane.sway" } }
relative_to = { variant = "light", as = "ratio" }
max         = 1
"""
    light = '[variants.light]\n"plant.parameters.load_mass" = "10 t"\nvary = false'
    file = written(f'[vary]\n"{START}" = ["-30 m", "-15 m"]\n{light}', asked)
    (verdict,) = envelope(file).verdicts
    for index, point in enumerate(envelope(file).points):
        alone = testbench.run(file, {**point, "vary": False})
        assert verdict.values[index] == alone.base.verdicts[0].value


def test_a_parameter_of_the_plant_in_a_formula_has_its_value_at_each_point(written):
    asked = '[[require]]\nid = "P"\ntext = "P"\nformula = "crane.load_mass <= 25 t"'
    (verdict,) = envelope(written(GRID, asked)).verdicts
    given = [15_000.0 if point[MASS] == "10 t" else -15_000.0 for point in envelope(written(GRID)).points]
    assert verdict.values.tolist() == given


def test_a_point_that_breaks_off_counts_as_no_pass_and_is_the_worst(written):
    file = written('[vary]\n"plant.start.speed" = ["0 m/s", "1e200 m/s"]', LIMIT.format(more=""))
    found = envelope(file)
    for verdict in found.verdicts:
        assert verdict.status is verdict.statuses[1] is Status.FAULT
        assert (verdict.passed, verdict.worst) == (1, 1)


def test_the_values_of_a_range_are_the_decimals_that_were_meant(written):
    vary = '[vary]\n"plant.parameters.rolling_resistance" = { from = 0.001, to = 0.005, count = 5 }'
    axis = read(written(vary)).base.vary[0]
    assert [each.value for each in axis.values] == [0.001, 0.002, 0.003, 0.004, 0.005]
