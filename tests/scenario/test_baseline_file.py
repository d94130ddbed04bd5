"""Baselines as files: what is written reads back, what is read is written back, and a fault has its place."""

from dataclasses import fields, replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fcl_sim.diagnostics import InputFault
from fcl_sim.judge.baseline import Baseline, Figure, MetricReference, RuleBaseReference, SignalReference
from fcl_sim.scenario import baseline_file
from fcl_sim.scenario.baseline_file import path_of, read, text_of, write
from fcl_sim.testbench import prepare, run, update_baseline

TEXTS = st.text(st.characters(codec="utf-8", exclude_categories=("Cs",)), min_size=1).filter(str.strip)
NUMBERS = st.floats(-1e9, 1e9).map(lambda each: float(f"{each:.6g}"))
POSITIVE = st.floats(0.0, 1e6)
PARTS = st.floats(0.0, 0.99)
UNITS = st.sampled_from(["", "m", "kN", "deg/s", "%"])
TICKS = st.lists(st.integers(0, 10**12), min_size=1, max_size=9, unique=True).map(sorted)
FIGURES = NUMBERS.map(Figure) | st.sampled_from(["never", "untested"]).map(lambda each: Figure(None, each))


@st.composite
def signals(draw):
    ticks = np.array(draw(TICKS), dtype=np.int64)
    values = np.array(draw(st.lists(NUMBERS, min_size=len(ticks), max_size=len(ticks))))
    lengths = {each: draw(POSITIVE) for each in ("thinned", "absolute")}
    times = {each: draw(st.integers(0, 10**11)) for each in ("leading", "lagging")}
    unit, relative = draw(UNITS), draw(PARTS)
    return SignalReference(
        name=draw(TEXTS), unit=unit, ticks=ticks, values=values, relative=relative, **lengths, **times
    )


METRICS = st.builds(
    MetricReference,
    id=TEXTS,
    about=TEXTS,
    figure=FIGURES,
    unit=UNITS,
    absolute=POSITIVE.filter(bool),
    relative=PARTS,
)
RULE_BASES = st.builds(
    RuleBaseReference, block=TEXTS, arithmetic=st.sampled_from(["REAL", "LREAL", "INT"]), text=TEXTS
)
BASELINES = st.builds(
    Baseline,
    scenario=TEXTS,
    variant=TEXTS,
    date=st.dates().map(str),
    reason=TEXTS,
    setting=st.lists(TEXTS, max_size=3).map(tuple),
    metrics=st.lists(METRICS, max_size=3).map(tuple),
    signals=st.lists(signals(), max_size=2).map(tuple),
    left_out=st.just("") | TEXTS,
    rule_bases=st.lists(RULE_BASES, max_size=2).map(tuple),
)


def plain(noun):
    """Return a noun as what can be compared, arrays as lists."""
    told = {each.name: getattr(noun, each.name) for each in fields(noun) if each.name != "file"}
    return {key: each.tolist() if isinstance(each, np.ndarray) else each for key, each in told.items()}


@settings(deadline=None, max_examples=60)
@given(BASELINES)
def test_a_baseline_reads_back_as_it_was_written_and_is_written_the_same_again(tmp_path_factory, made):
    scenario = tmp_path_factory.mktemp("b") / "loop.toml"
    write(made, path_of(scenario, "base"))
    found = read(scenario, "base")
    assert [each.name for each in (scenario.parent / "baselines").iterdir()] == ["loop.base.toml"]
    assert plain(replace(found, signals=())) == plain(replace(made, signals=()))
    assert [plain(each) for each in found.signals] == [plain(each) for each in made.signals]
    assert text_of(found) == text_of(made)


def baselines_of(bench):
    folder = bench.folder / "scenarios/crane/baselines"
    return {each.name: each.read_bytes() for each in folder.glob("transfer.*")}


def accept(bench):
    outcome = run("scenarios/crane/transfer.toml")
    for variant in outcome.variants:
        update_baseline(outcome, variant, reason="as they are", date="2026-01-31")
    return outcome


def test_an_update_after_an_update_is_the_same_to_the_last_byte(bench):
    accept(bench)
    first = baselines_of(bench)
    accept(bench)
    assert baselines_of(bench) == first
    assert len(first) == 6


def test_tolerances_that_somebody_wrote_survive_an_update(bench):
    accept(bench)
    name = "baselines/transfer.base.toml"
    bench.edit(name, ('absolute = "0.05 s", relative = 0.001', 'absolute = "7 s", relative = 0.25'))
    bench.edit(name, ('lagging  = "0.05 s"', 'lagging  = "900 ms"'))
    accept(bench)
    kept = read(bench.folder / "scenarios/crane/transfer.toml", "base")
    assert (kept.metrics[0].absolute, kept.metrics[0].relative) == (7.0, 0.25)
    assert [each.lagging for each in kept.signals[:2]] == [900_000_000, 50_000_000]


def test_runs_with_overrides_are_not_compared_and_become_no_baseline(bench):
    outcome = run("scenarios/crane/transfer.toml", {"plant.parameters.load_mass": "10 t"})
    assert {each.compared for each in outcome.variants.values()} == {None}
    with pytest.raises(InputFault, match="has overrides"):
        update_baseline(outcome, "base", reason="r", date="2026-01-31")


def test_a_run_that_broke_down_becomes_no_baseline(bench):
    bench.edit("transfer.toml", ("[plant]", "[integration]\nrtol = 1e-300\n\n[plant]"))
    outcome = run("scenarios/crane/transfer.toml")
    assert outcome.trace.fault is not None
    with pytest.raises(InputFault, match="RUN108"):
        update_baseline(outcome, "base", reason="r", date="2026-01-31")


def test_a_variant_says_which_signals_its_baseline_keeps(bench):
    bench.edit(
        "transfer.toml",
        ("[variants.light_load]", '[variants.light_load]\n"baseline.signals" = ["crane.sway"]'),
    )
    outcome = accept(bench)
    kept = read(outcome.scenario.path, "light_load")
    assert [each.name for each in kept.signals] == ["crane.sway"]
    bench.edit("transfer.toml", ('["crane.sway"]', '["crane.sway", "crane.angle"]'))
    again = run("scenarios/crane/transfer.toml").variants["light_load"]
    assert str(again.verdict) == "NO BASELINE"


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("leading", "leadin", "error[SCN201]: `signal` 1 has no key `leadin`"),
        ('absolute = "0.05 s"', 'absolute = "0.05 m"', "error[SCN404]: `absolute` is in s"),
        ('value = "25.3724 s"', 'value = "soon"', "error[SCN204]: `value`"),
        ("date     = 2026-01-31", 'date     = "today"', "error[SCN203]: `date` is a date, not a text"),
        ("  [0, 25],\n", "  [9, 25],\n", "error[SCN203]: `samples` cannot have the row"),
        ("schema   = 1", "schema   = 2", "error[SCN203]"),
        ("schema   = 1", "<<<<<<< HEAD", "error[SCN102]: not TOML"),
        ("relative = 0.001", "relative = 1", "error[SCN203]: `relative` is a part of the value"),
    ],
)
def test_what_is_wrong_in_a_baseline_has_its_place_and_nothing_is_simulated(bench, old, new, message):
    accept(bench)
    bench.edit("baselines/transfer.base.toml", (old, new))
    with pytest.raises(InputFault) as caught:
        prepare(bench.read())
    first, *_ = str(caught.value).splitlines()
    assert first.startswith("scenarios/crane/baselines/transfer.base.toml:")
    assert message in first


def test_a_write_that_the_system_refuses_leaves_the_former_file(bench, monkeypatch):
    accept(bench)
    before = baselines_of(bench)

    def refuse(*_):
        raise OSError(28, "no room")

    monkeypatch.setattr(baseline_file.Path, "replace", refuse)
    with pytest.raises(OSError, match="no room"):
        accept(bench)
    assert baselines_of(bench) == before
    assert not list((bench.folder / "scenarios/crane/baselines").glob(".*"))


def test_a_run_with_an_envelope_is_held_to_its_baseline_too(bench):
    """The envelope is judged besides, not instead."""
    (bench.folder / "scenarios/crane/baselines/precise.base.toml").unlink()
    found = run("scenarios/crane/precise.toml").base
    assert found.envelope is not None
    assert {str(each.status) for each in (*found.verdicts, *found.envelope.verdicts)} == {"PASS"}
    assert str(found.verdict) == "NO BASELINE"
