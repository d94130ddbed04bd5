"""The witness of every finding, evaluated in fractions, shows what the finding says."""

from fractions import Fraction

import pytest

from fcl_sim.diagnostics.page import framed, pages
from fcl_sim.engine.explain import Origin
from fcl_sim.model import AndOperator
from fcl_sim.proof.exact import exactly
from fcl_sim.proof.prove import prove
from fcl_sim.proof.universe import universe_of
from tests.house.places import ROOT
from tests.proof.bases import ANY, block_of, random_text

SHIPPED = sorted((ROOT / "scenarios").rglob("*.fcl"))
NOWHERE = {"FCL603", "FCL609", "FCL610", "FCL611"}
"""Findings of what is nowhere, so that no point shows it."""
OPEN = {"FCL615"}
"""Findings of what is not known: some have an example."""


class Shown:
    """What an evaluation at the witness of a finding shows."""

    def __init__(self, block, finding):
        self.block, self.finding = block, finding
        self.name = finding.variable.casefold()
        found = exactly(block, finding.witness)
        self.rules = dict(found.rules)
        self.terms = {(name.casefold(), term.casefold()): degree for name, term, degree in found.terms}
        self.active = {each.variable: each.origin is Origin.RULES for each in found.outputs}
        self.values = {each.variable: each.value for each in found.outputs}

    @property
    def own(self):
        return self.rules[self.finding.rule]

    @property
    def beside(self):
        return self.rules[self.finding.beside]

    @property
    def degrees(self):
        return [degree for (name, _), degree in self.terms.items() if name == self.name]

    @property
    def concluding(self):
        """The degrees of the rules that conclude on the output."""
        return [
            self.rules[rule.label]
            for rule_block in self.block.rule_blocks
            for rule in rule_block.rules
            if any(each.variable.casefold() == self.name for each in rule.conclusions)
        ]

    @property
    def first_named(self):
        """The degree of the first term that the message names."""
        return self.terms[self.name, self.finding.diagnostic.message.split("`")[1].casefold()]


SHOWS = {
    "FCL601": lambda seen: not seen.active[seen.finding.variable],
    "FCL615": lambda seen: not seen.active[seen.finding.variable],
    "FCL602": lambda seen: 0 < max(seen.concluding) < Fraction(1, 20),
    "FCL604": lambda seen: seen.own == seen.beside > 0,
    "FCL605": lambda seen: seen.own == seen.beside > 0,
    "FCL606": lambda seen: 0 < seen.own <= seen.beside,
    "FCL607": lambda seen: 0 < seen.beside <= seen.own,
    "FCL608": lambda seen: seen.first_named > 0,
    "FCL612": lambda seen: max(seen.degrees) == 0,
    "FCL613": lambda seen: seen.own > 0,
    "FCL614": lambda seen: sum(seen.degrees) != 1,
    "FCL631": lambda seen: (
        f"`{seen.finding.variable}` is {float(seen.values[seen.finding.variable]):.5g} here"
        in seen.finding.diagnostic.message
    ),
}


def rules_leave_doubt(block):
    """Return whether it may be that no point is known at which a rule fires."""
    return any(each.and_operator is AndOperator.BDIF for each in block.rule_blocks)


def assert_all_shown(block, findings):
    for each in findings:
        code = each.diagnostic.code
        if code == "FCL613" and each.witness is None and rules_leave_doubt(block):
            continue
        assert code in OPEN or (each.witness is None) == (code in NOWHERE), each.diagnostic.message
        if each.witness is not None:
            assert set(each.witness) == {own.name for own in block.inputs}
            assert SHOWS[code](Shown(block, each)), each.diagnostic.message


@pytest.mark.parametrize("file", SHIPPED, ids=lambda each: each.stem)
def test_of_every_shipped_rule_base(file):
    block = block_of(file.read_text("utf-8"))
    assert_all_shown(block, prove(block))


EXAMPLES = [each for each in pages().values() if each.code.startswith("FCL6") and each.language == "fcl"]


@pytest.mark.parametrize("told", EXAMPLES, ids=lambda each: each.code)
def test_of_the_example_of_every_kind_of_finding(told):
    block = block_of(framed(told.bad, told.within, complete=True))
    findings = prove(block)
    assert told.code in [each.diagnostic.code for each in findings]
    assert_all_shown(block, findings)


@pytest.mark.parametrize("seed", range(12))
def test_of_random_rule_bases(seed):
    block = block_of(random_text(seed, ANY))
    own = universe_of(block, [f"{each.variable}=0..12" for each in block.fuzzifications])
    assert_all_shown(block, prove(block, own, epsilon=0.0))
