"""What is not the same in two rule bases: rules by what their share depends on, terms, settings."""

from collections import Counter
from collections.abc import Sequence

from fcl_sim.engine.switches import switched
from fcl_sim.fcl.write_rules import conclusion, condition_text
from fcl_sim.model import Degree, FunctionBlock, Is, Rule
from fcl_sim.proof.cubes import leaves


def changed_terms(blocks: Sequence[FunctionBlock], output: str) -> set[str]:
    """Return the terms of an output that are not the same in both blocks, in lower case."""
    shapes = [
        {(term.name.casefold(), repr(term.shape)) for term in each.terms}
        for block in blocks
        for each in block.defuzzifications
        if each.variable.casefold() == output.casefold()
    ]
    return {name for name, _ in shapes[0] ^ shapes[1]}


def surplus(old: FunctionBlock, new: FunctionBlock, output: str) -> tuple[list[int], list[int]]:
    """Return the rules on an output, by place, that the other block lacks."""
    keys = [rule_keys(each, output) for each in (old, new)]
    counts = [Counter(key for _, key in each) for each in keys]
    found: list[list[int]] = []
    for own, (mine, others) in zip(keys, (counts, counts[::-1]), strict=True):
        more = mine - others
        found.append([])
        for place, key in own:
            if more[key] > 0:
                more[key] -= 1
                found[-1].append(place)
    return found[0], found[1]


def frame_of(block: FunctionBlock, output: str, *, places: bool = True) -> object:
    """Return what all rules on an output depend on: its method and, with `places`, its terms."""
    own = next(each for each in block.defuzzifications if each.variable.casefold() == output.casefold())
    accumulations = {each.accumulation for each in block.rule_blocks}
    terms = {each.name.casefold(): each.shape for each in own.terms}
    choices = (own.method, repr(own.default), own.range, own.accumulation, own.held, own.clamped)
    return (*choices, accumulations, repr(sorted(terms.items())) if places else "")


def rule_keys(block: FunctionBlock, output: str) -> list[tuple[int, object]]:
    """Return for each rule on an output its place, and everything that its share depends on."""
    terms = {
        (each.variable.casefold(), term.name.casefold()): repr(term.shape)
        for each in switched(block).fuzzifications
        for term in each.terms
    }
    found: list[tuple[int, object]] = []
    place = 0
    for rule_block in switched(block).rule_blocks:
        for rule in rule_block.rules:
            if concludes(rule, output):
                asked = sorted(repr(terms.get(_key(each))) for each in leaves(rule.condition))
                operators = (rule_block.and_operator, rule_block.or_operator, rule_block.activation)
                found.append((place, (rule_text(rule, output).casefold(), tuple(asked), operators)))
            place += 1
    return found


def _key(ask: Is | Degree) -> tuple[str, str]:
    return ask.variable.casefold(), ask.term.casefold() if isinstance(ask, Is) else ""


def concludes(rule: Rule, output: str) -> bool:
    """Return whether a rule concludes on an output."""
    return any(each.variable.casefold() == output.casefold() for each in rule.conclusions)


def rule_text(rule: Rule, output: str = "") -> str:
    """Return a rule, or of its conclusions those on an output alone."""
    own = [each for each in rule.conclusions if output.casefold() in {"", each.variable.casefold()}]
    return f"IF {condition_text(rule.condition)} THEN {', '.join(map(conclusion, own))}"
