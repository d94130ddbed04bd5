"""Syntax tree → model: strict, because it knows what exists and can say what was meant."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from itertools import count

from fcl_sim.diagnostics import Diagnostic
from fcl_sim.fcl.findings import Findings
from fcl_sim.fcl.resolve_accumulation import settle
from fcl_sim.fcl.resolve_declarations import resolve_declarations
from fcl_sim.fcl.resolve_rules import resolve_rule_block
from fcl_sim.fcl.resolve_types import resolve_structures
from fcl_sim.fcl.resolve_variables import resolve_defuzzify, resolve_fuzzify
from fcl_sim.fcl.scope import Declared, Role, Scope
from fcl_sim.fcl.tree import (
    Block,
    Declarations,
    Defuzzify,
    Fuzzify,
    Options,
    RuleBlock,
    Structures,
    Tree,
)
from fcl_sim.model import FunctionBlock, Note, Structure, Variable


@dataclass(frozen=True, slots=True)
class Resolution:
    """The product of the resolver. The blocks are whole only where no finding is an error."""

    blocks: tuple[FunctionBlock, ...]
    diagnostics: tuple[Diagnostic, ...]
    notes: tuple[Note, ...]


def resolve(tree: Tree, name: str) -> Resolution:
    """Return the function blocks of a text; one without a name is called `name` (S11)."""
    findings = Findings(tree.source)
    types = Scope(findings)
    resolve_structures(types, tree.types)
    blocks = tuple(_function_block(findings, each, name, types.structures) for each in tree.blocks)
    seen: dict[str, Block] = {}
    for block, model in zip(tree.blocks, blocks, strict=True):
        first = seen.setdefault(model.name.upper(), block)
        if first is not block:
            findings.error(
                "FCL301",
                f"two function blocks have the name `{model.name}`",
                block.heading or block.opening,
                related=(findings.place(first.heading or first.opening, "first here"),),
            )
    return Resolution(blocks, findings.diagnostics(), tuple(findings.notes))


def _function_block(
    findings: Findings, block: Block, name: str, types: Mapping[str, Structure]
) -> FunctionBlock:
    scope = Scope(findings)
    scope.structures |= types
    scope.incomplete = scope.headless = block.damaged
    sections = block.sections
    resolve_structures(scope, [each for each in sections if isinstance(each, Structures)])
    for each in sections:
        if isinstance(each, Declarations):
            resolve_declarations(scope, each)
        elif isinstance(each, Options):
            findings.feature("options", "OPTIONS", each)
    fuzzifications = [resolve_fuzzify(scope, each) for each in sections if isinstance(each, Fuzzify)]
    defuzzifications = [resolve_defuzzify(scope, each) for each in sections if isinstance(each, Defuzzify)]
    written = [each for each in sections if isinstance(each, RuleBlock)]
    names = _rule_block_names(written)
    named = [resolve_rule_block(scope, each, name) for name, each in zip(names, written, strict=True)]
    _check_names(scope, written)
    outputs = [each for each in defuzzifications if each is not None]
    rule_blocks, settled = settle(scope, written, named, outputs)
    if not (block.damaged or scope.unknown or any(each.damaged for each in written)):
        _check_outputs(scope)
    scope.note_spellings()
    return FunctionBlock(
        name=block.heading.text if block.heading else name,
        inputs=_variables(scope, Role.INPUT),
        outputs=_variables(scope, Role.OUTPUT),
        variables=_variables(scope, Role.LOCAL),
        fuzzifications=tuple(each for each in fuzzifications if each is not None),
        defuzzifications=settled,
        rule_blocks=rule_blocks,
        options=tuple(each.text for each in sections if isinstance(each, Options)),
        structures=tuple(scope.structures.values()),
        span=findings.span(block.heading or block.opening),
    )


def _variables(scope: Scope, role: Role) -> tuple[Variable, ...]:
    """Return the variables of a section; an output's range stands in its Defuzzification."""
    found = []
    for key, declared in scope.variables.items():
        if declared.role is role:
            limits = None if role is Role.OUTPUT else scope.ranges.get(key, declared.variable.range)
            found.append(replace(declared.variable, range=limits))
    return tuple(found)


def _rule_block_names(rule_blocks: list[RuleBlock]) -> list[str]:
    """Return the names of rule blocks; one without is called No1, No2 and so on, by the next free number."""
    names = [each.name.text if each.name else "" for each in rule_blocks]
    taken = {each.upper() for each in names}
    for place, name in enumerate(names):
        if not name:
            names[place] = next(each for n in count(place + 1) if (each := f"No{n}").upper() not in taken)
            taken.add(names[place].upper())
    return names


def _check_names(scope: Scope, rule_blocks: list[RuleBlock]) -> None:
    """Each rule block has a name of its own (5.2.4)."""
    seen: dict[str, RuleBlock] = {}
    for each in rule_blocks:
        if each.name is None:
            continue
        first = seen.setdefault(each.name.key, each)
        if first is not each and first.name is not None:
            scope.report_twice(
                "FCL352", f"two rule blocks have the name {each.name.shown}", each.name, first.name
            )


def _check_outputs(scope: Scope) -> None:
    for output in _outputs(scope):
        if output.token.key not in scope.concluded:
            message = f"no rule concludes on the output `{output.name}`"
            scope.findings.warning("FCL355", message, output.token, hint="it always has its default value")


def _outputs(scope: Scope) -> list[Declared]:
    return [each for each in scope.variables.values() if each.role is Role.OUTPUT]
