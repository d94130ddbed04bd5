"""Overruns, restarts and faults as a scenario has them."""

import numpy as np
import pytest

from fcl_sim.judge.verdict import Status
from fcl_sim.loop.diagram import Overruns, Restart
from fcl_sim.scenario.binder import bind
from fcl_sim.scenario.show import show_scenario
from fcl_sim.testbench import run_scenario

OVERRUNS = """
[timing]
seed = 3
overruns = { policy = "late", scans = [[7, "130 ms"], [30, "0.2 s"]], chance = "1 %", longest = "120 ms" }

[[restart]]
at = "1 s"
kind = "cold"

[[restart]]
at = "1500 ms"
kind = "warm"
lasts = "200 ms"

[plant]
"""
FAULT = """
[blocks.seen]
type = "fault"
input = "crane.distance"
kind = "dropout"
during = "nan"
from = "1.5 s"

[plant]
"""
LONG = "[[restart]]\nat = '1 s'\nkind = 'warm'\nlasts = '1.1 s'\n"
READ = ('distance = "crane.distance"', 'distance = "seen"')


def edited(bench, text, *further):
    bench.edit("transfer.toml", ("\n[plant]\n", text), *further)
    return bench.read(duration="3 s")


def test_the_tables_are_the_timing_of_the_loop(bench):
    scenario = edited(bench, OVERRUNS)
    timing = scenario.base.timing
    listed = ((7, 130_000_000), (30, 200_000_000))
    assert timing.overruns == Overruns(policy="late", listed=listed, chance=0.01, longest=120_000_000)
    assert timing.restarts == (
        Restart(at=10**9, kind="cold"),
        Restart(at=1_500_000_000, kind="warm", lasts=200_000_000),
    )
    assert bind(scenario).plc == "controller."


def test_a_scenario_in_print_tells_what_keeps_the_plc_from_its_scans(bench):
    text = show_scenario(edited(bench, OVERRUNS))
    for line in (
        "seed = 3",
        "scan 7 takes 0.13 s",
        "1.000% of the scans take up to 0.12 s",
        "overruns: late",
        "cold restart at 1 s",
        "warm restart at 1.5 s of 0.2 s",
    ):
        assert f"  {line}\n" in text


def test_traces_of_a_scenario_tell_of_overruns_and_restarts(bench):
    trace = run_scenario(edited(bench, OVERRUNS)).trace
    told = [(each.tick, each.text) for each in trace.incidents]
    assert (350_000_000, "a scan of 0.13 s") in told
    assert (10**9, "cold restart") in told
    assert (1_500_000_000, "warm restart of 0.2 s") in told
    assert not np.any((trace.ticks >= 1_500_000_000) & (trace.ticks < 1_700_000_000))
    assert trace["controller.speed"][trace.ticks == 10**9].tolist() == [0.0]


def test_a_sensor_that_gives_nan_ends_the_run_with_fault_the_time_the_signal_and_the_trace_up_to_there(bench):
    outcome = run_scenario(edited(bench, FAULT, READ))
    assert outcome.verdict is Status.FAULT
    fault = outcome.trace.fault
    assert (fault.tick, fault.signal, fault.reason) == (1_500_000_000, "seen", "`seen` is NaN or infinite")
    assert outcome.trace.ticks[-1] == 1_450_000_000
    assert np.isfinite(outcome.trace.values).all()
    assert all(each.status is Status.FAULT for each in outcome.base.verdicts)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ('[timing]\noverruns = { policy = "later" }', "`policy` cannot be `later`\n"),
        ("[timing]\noverruns = { chance = 2 }", "`chance` is a probability, not 2\n"),
        ('[timing]\noverruns = { chance = "1 s" }', "`chance` is a probability, not 1 s\n"),
        ("[timing]\noverruns = { chance = 0.1 }", "the longest of the scans that overrun does not overrun\n"),
        (
            "[timing]\noverruns = { scans = [3] }",
            "an entry of `scans` has pairs: a scan and how long",
        ),
        ('[timing]\noverruns = { scans = [[-1, "1 s"]] }', "must lie between 0 and"),
        ('[timing]\noverruns = { scans = [[3, "20 ms"]] }', "scan 3 does not overrun in 0.02 s\n"),
        ("[timing]\noverruns = { late = true }", "`overruns` has no key `late`"),
        ('[[restart]]\nat = "0 s"\nkind = "cold"', "`at` must be greater than 0"),
        ('[[restart]]\nat = "1 s"\nkind = "cool"', "did you mean `cold`?"),
        ('[[restart]]\nat = "1 s"', "`restart` 1 has no `kind`"),
        ('[restart]\nat = "1 s"', "write [[restart]]"),
        (f"{LONG}[[restart]]\nat = '2 s'\nkind = 'cold'", "at 2 s comes before that at 1 s is over\n"),
    ],
)
def test_what_cannot_be_is_told_at_its_place(bench, text, message):
    bench.edit("transfer.toml", ("\n[plant]\n", f"\n{text}\n\n[plant]\n"))
    told = bench.fault()
    assert message in told
    assert "scenarios/crane/transfer.toml:" in told
