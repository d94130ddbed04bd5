"""What needs the rule base as well as the run: what a baseline keeps, and why two runs differ.

In: a Diagram with its function blocks, a Trace, Verdicts; texts in FCL. Out: findings and records as data.
May import judge, loop, block, fcl and engine; it knows no scenarios and writes no files.
Tests: tests/verify.
"""
