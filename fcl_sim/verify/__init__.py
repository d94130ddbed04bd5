"""What needs the rule base as well as the run: coverage, replay, mutants, baselines, why two runs differ.

In: a Diagram with its function blocks, Blocks, what traces and logs recorded of them, Verdicts; texts
in FCL. Out: findings and records as data. May import judge, loop, block, fcl, engine and below; it
knows no scenarios: `testbench` joins them. Tests: tests/verify.
"""
