"""The one sequence: read, bind, wire, run, judge, compare with the baseline.

In: files of scenarios, or Scenarios. Out: an Outcome of each, with a Run of
every variant; their coverage, their new baselines. It joins what knows nothing
of each other. May import envelope, scenario, verify, judge, loop, block.
Tests: tests/testbench.
"""

from fcl_sim.loop.open import OpenLoop
from fcl_sim.scenario.bench import bench_of
from fcl_sim.scenario.model import BASE
from fcl_sim.testbench.baselines import lost_runs, new_baseline, update_baseline
from fcl_sim.testbench.covering import coverage
from fcl_sim.testbench.outcome import Against, Outcome, Prepared, Run, Update
from fcl_sim.testbench.preparing import open_loop, prepare
from fcl_sim.testbench.running import (
    against_rule_bases,
    against_scenario,
    judge_trace,
    run,
    run_prepared,
    run_scenario,
    run_together,
)
from fcl_sim.testbench.side_by_side import run_files

__all__ = [
    "BASE",
    "Against",
    "OpenLoop",
    "Outcome",
    "Prepared",
    "Run",
    "Update",
    "against_rule_bases",
    "against_scenario",
    "bench_of",
    "coverage",
    "judge_trace",
    "lost_runs",
    "new_baseline",
    "open_loop",
    "prepare",
    "run",
    "run_files",
    "run_prepared",
    "run_scenario",
    "run_together",
    "update_baseline",
]
