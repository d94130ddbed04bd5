"""The grammar and the parser say the same: each production is one parse function's, and is read."""

import ast
import re
from collections import Counter
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings

from fcl_sim import fcl
from fcl_sim.diagnostics.render import render_all
from tests.fcl.ebnf import LEAVES, parsed, productions, sentences, words_of

READER = Path(fcl.__file__).parent
TEXT = (READER / "grammar.ebnf").read_text("utf-8")
WRITTEN = productions(TEXT)
GRAMMAR = {name: parsed(right) for name, right in WRITTEN.items()}
SLOW = settings(deadline=None, suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large])
WITHIN = {  # what stands before and behind a statement
    "declaration": ("FUNCTION_BLOCK a\nVAR_INPUT\n", "\nEND_VAR\nEND_FUNCTION_BLOCK"),
    "linguistic_term": ("FUNCTION_BLOCK a\nFUZZIFY b\n", "\nEND_FUZZIFY\nEND_FUNCTION_BLOCK"),
    "rule": ("FUNCTION_BLOCK a\nRULEBLOCK b\n", "\nEND_RULEBLOCK\nEND_FUNCTION_BLOCK"),
    "expression": (
        "FUNCTION_BLOCK a\nDEFUZZIFY b\nTERM c := FUNCTION\n",
        "\n;\nEND_DEFUZZIFY\nEND_FUNCTION_BLOCK",
    ),
    "types": ("", "\nFUNCTION_BLOCK a\nEND_FUNCTION_BLOCK"),
}
QUOTED = re.compile(r"`(\w+) ::= ([^`]*)`")


def quoted():
    """Return every production that a docstring of the parser quotes, with its function."""
    found = []
    for file in sorted([*READER.glob("parse_*.py"), READER / "parser.py"]):
        for node in ast.walk(ast.parse(file.read_text("utf-8"))):
            if isinstance(node, ast.FunctionDef):
                text = ast.get_docstring(node) or ""
                found += [(name, " ".join(right.split()), node.name) for name, right in QUOTED.findall(text)]
    return found


def test_every_production_stands_in_the_docstring_of_exactly_one_parse_function():
    counts = Counter(name for name, _, _ in quoted())
    assert counts == dict.fromkeys(GRAMMAR, 1)


@pytest.mark.parametrize(("name", "right", "function"), quoted())
def test_a_parse_function_quotes_its_production_as_the_grammar_has_it(name, right, function):
    assert right == WRITTEN[name]


def test_every_name_in_the_grammar_is_produced_or_a_word():
    used = {word for tree in GRAMMAR.values() for word in words_of(tree) if not word.startswith("'")}
    words = {each for each in used - set(GRAMMAR) if not each.endswith("_name")}
    assert words == set(LEAVES) - {"shape_name", "function_name"}
    assert set(GRAMMAR) - used == {"text"}


@settings(SLOW, max_examples=150)
@given(sentences(GRAMMAR, "text"))
def test_what_the_grammar_makes_is_read_without_a_fault_of_syntax(text):
    faults = [each for each in fcl.read(text).errors if each.code < "FCL300"]
    assert faults == [], render_all(faults)


@pytest.mark.parametrize("production", WITHIN)
def test_each_kind_of_statement_is_read_in_all_its_forms(production):
    before, after = WITHIN[production]

    @settings(SLOW, max_examples=60)
    @given(sentences(GRAMMAR, production))
    def check(middle):
        faults = [each for each in fcl.read(before + middle + after).errors if each.code < "FCL300"]
        assert faults == [], render_all(faults)

    check()
