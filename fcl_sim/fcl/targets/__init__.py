"""Statements of targets that we ship, in the form of Tables 8 to 11, each line with its source.

In: a name such as `concept`. Out: its text; `fcl.conformance_statement` reads it.
Data only. Imports diagnostics.
Tests: tests/fcl/test_conformance_targets.py.
"""

from importlib.resources import files

from fcl_sim.diagnostics import Source

NAMES = ("concept", "jfuzzylogic", "fuzzylite")


def shipped(name: str) -> Source:
    """Return the text of a shipped statement, one of NAMES."""
    text = files(__name__).joinpath(f"{name}.toml").read_text("utf-8")
    return Source(f"targets/{name}.toml", text)
