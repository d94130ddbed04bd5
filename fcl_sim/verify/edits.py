"""Two versions of a rule base → what was edited: terms, rules, settings, each as it was and as it is."""

from collections.abc import Iterator
from dataclasses import dataclass

from fcl_sim.fcl.comments import NO_COMMENTS
from fcl_sim.fcl.write_lines import Line
from fcl_sim.fcl.write_rules import rule_lines
from fcl_sim.fcl.write_sections import defuzzify, fuzzify, rule_block
from fcl_sim.fcl.write_terms import term_lines
from fcl_sim.model import FunctionBlock, Term, Variable
from fcl_sim.model.labels import unique_labels

ENDLESS = 10**6
"""Width of a text that stays on one line."""

TERM, RULE, SETTING, VARIABLE = "term", "rule", "setting", "variable"
"""What an edit can be of."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Edit:
    """What was edited in a rule base; `old` is empty where it was added, `new` where it was taken out.

    `owner` is the variable of a term or setting, the rule block of a rule or
    setting; `name` the term, the rule's label, no two of them alike, the
    keyword of a setting.
    """

    kind: str
    owner: str
    name: str
    old: str
    new: str


Key = tuple[str, str, str]


def edits(old: FunctionBlock, new: FunctionBlock) -> tuple[Edit, ...]:
    """Return what was edited, in the order of the new text, what was taken out last."""
    before, after = dict(_parts(old)), dict(_parts(new))
    keys = (*after, *(each for each in before if each not in after))
    return tuple(
        Edit(kind=key[0], owner=key[1], name=key[2], old=before.get(key, ""), new=after.get(key, ""))
        for key in keys
        if before.get(key) != after.get(key)
    )


def _parts(block: FunctionBlock) -> Iterator[tuple[Key, str]]:
    """Yield what can be edited on its own, and its canonical text on one line."""
    groups = {"VAR_INPUT": block.inputs, "VAR_OUTPUT": block.outputs, "VAR": block.variables}
    for group, variables in groups.items():
        for variable in variables:
            yield (VARIABLE, group, variable.name), _declared(variable)
    for section in block.fuzzifications:
        yield from _terms(section.variable, section.terms)
        yield from _settings(section.variable, fuzzify(section, None, NO_COMMENTS, terse=True))
    for output in block.defuzzifications:
        yield from _terms(output.variable, output.terms)
        yield from _settings(output.variable, defuzzify(output, NO_COMMENTS, terse=True))
    labels = iter(unique_labels(block))
    for rules in block.rule_blocks:
        yield from _settings(rules.name, rule_block(rules, NO_COMMENTS, terse=True))
        for rule, label in zip(rules.rules, labels, strict=False):
            yield (RULE, rules.name, label), rule_lines(rule, ENDLESS)[0].removesuffix(";")


def _declared(variable: Variable) -> str:
    initial = "" if variable.initial is None else f" := {variable.initial:g}"
    within = "" if variable.range is None else f" ({variable.range[0]:g} .. {variable.range[1]:g})"
    return f"{variable.name}: {variable.type}{initial}{within}"


def _terms(variable: str, terms: tuple[Term, ...]) -> Iterator[tuple[Key, str]]:
    for term in terms:
        yield (TERM, variable, term.name), term_lines(term, 0, ENDLESS)[0].removesuffix(";")


def _settings(owner: str, lines: Iterator[Line]) -> Iterator[tuple[Key, str]]:
    """Yield the lines of a section that are neither its head or end nor terms and rules."""
    for line in lines:
        text = line.code[0]
        word = text.partition(" ")[0].rstrip(":")
        if line.indent and word not in {"TERM", "RULE"} and not word.startswith("RULE_"):
            yield (SETTING, owner, word), text.removesuffix(";")
