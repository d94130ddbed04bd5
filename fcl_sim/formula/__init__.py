"""Formulae of signals: numbers with units, arithmetic and functions; read, and held to their units.

In: a text and the units of its signals. Out: a tree in which every number fits,
or every fault of the text at its place. Requirements build their temporal
formulae on it, the block `expression` takes it as it is.
May import units and diagnostics; its own files import downwards:
resolve, write, parse → tokens, functions → tree, text. Tests: tests/formula, tests/judge.
"""
