"""From a trace to verdicts: metrics, bounds, and one sentence for the reader.

In: a Trace, simulated or recorded, and Requirements. Out: a Verdict for each,
with its number, its definition in words and what a plot draws for it.
May import loop.trace (nothing else of the loop), units and diagnostics.
Tests: tests/judge.
"""
