"""Temporal formulae: a small language of requirements with real-time bounds.

In: a formula or a sentence as text, a Trace. Out: whether it holds, by how much,
where it is first violated, and every fault of the text as a diagnostic.
May import loop.trace, formula, units and diagnostics; its own files import downwards:
verdict → explain → evaluate → windows; formula → sentences → parse → words, tree.
Tests: tests/judge.
"""
