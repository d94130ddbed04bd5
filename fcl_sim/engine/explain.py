"""`explain`: one evaluation, step by step, read back from the instance's memory."""

from collections.abc import Iterator
from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

from fcl_sim.engine.entries import evaluate_one
from fcl_sim.engine.program import Program
from fcl_sim.engine.words import condition_formula, condition_text
from fcl_sim.model import Condition, Degree, FunctionBlock, Is, Not, Rule, RuleBlock, Singleton


class Origin(StrEnum):
    """Where the value of an output comes from (S30)."""

    RULES = "rules"
    DEFAULT = "DEFAULT"
    PREVIOUS = "NC"


@dataclass(frozen=True, slots=True)
class TermDegree:
    """A term and its degree."""

    term: str
    degree: float


@dataclass(frozen=True, slots=True)
class Fuzzified:
    """Fuzzification of an input: the degree of each of its terms."""

    variable: str
    value: float
    degrees: tuple[TermDegree, ...]


@dataclass(frozen=True, slots=True)
class Brought:
    """A variable brought in as a degree or a weight, and what it counts for within [0, 1]."""

    variable: str
    value: float
    degree: float


@dataclass(frozen=True, slots=True)
class Aggregated:
    """Aggregation of a rule's condition; `formula` shows its degrees under their operators."""

    rule: str
    condition: str
    formula: str
    degree: float


@dataclass(frozen=True, slots=True)
class Activated:
    """A conclusion after activation, which does nothing to a singleton, and after its weight (A.15)."""

    rule: str
    variable: str
    term: str
    activated: float
    weight: float
    degree: float


@dataclass(frozen=True, slots=True)
class Accumulated:
    """Accumulation over the rules, per term of an output; several algorithms where rule blocks disagree."""

    variable: str
    algorithms: tuple[str, ...]
    degrees: tuple[TermDegree, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Defuzzified:
    """The number an output gets, and where from; `places` are its singletons, in the order of the terms."""

    variable: str
    method: str
    places: tuple[float, ...]
    origin: Origin
    value: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Explanation:
    """One evaluation in the steps of A.2.1 to A.2.4."""

    name: str
    fuzzified: tuple[Fuzzified, ...]
    brought: tuple[Brought, ...]
    aggregated: tuple[Aggregated, ...]
    activated: tuple[Activated, ...]
    accumulated: tuple[Accumulated, ...]
    defuzzified: tuple[Defuzzified, ...]

    @property
    def fired(self) -> tuple[str, ...]:
        """Labels of the rules whose degree of firing is above 0."""
        return tuple(each.rule for each in self.aggregated if each.degree > 0.0)


@dataclass(frozen=True, slots=True)
class _Reading:
    """A block, its program, and the memory that an evaluation left behind."""

    block: FunctionBlock
    program: Program
    memory: NDArray[np.float64]

    def input(self, variable: str) -> float:
        names = [name.casefold() for name in self.program.input_names]
        return float(self.memory[names.index(variable.casefold())])

    def degree(self, leaf: Condition) -> float:
        """Return the degree of a subcondition, or of NOT one."""
        negated = isinstance(leaf, Not)
        inner = leaf.argument if isinstance(leaf, Not) else leaf
        layout = self.program.layout
        if isinstance(inner, Is):
            slots = layout.complements if negated else layout.terms
            return float(self.memory[slots[inner.variable.casefold(), inner.term.casefold()]])
        if isinstance(inner, Degree):
            return float(self.memory[layout.brought[inner.variable.casefold()] + int(negated)])
        raise TypeError(leaf)

    def rules(self) -> Iterator[tuple[str, float, RuleBlock, Rule]]:
        """Yield label, degree of firing, rule block and rule of every rule."""
        pairs = [(each, rule) for each in self.block.rule_blocks for rule in each.rules]
        degrees = self.memory[self.program.degrees_at :]
        for label, degree, (rule_block, rule) in zip(self.program.rule_labels, degrees, pairs, strict=False):
            yield label, float(degree), rule_block, rule


def explain(block: FunctionBlock, program: Program, memory: NDArray[np.float64]) -> Explanation:
    """Evaluate once on `memory`, an instance's with its inputs written, and tell each step.

    `program` is that of `block`. Every degree is read back from the memory
    that the evaluation leaves behind.
    """
    evaluate_one(program.ints, program.floats, memory)
    reading = _Reading(block, program, memory)
    return Explanation(
        name=block.name,
        fuzzified=tuple(_fuzzified(reading)),
        brought=tuple(
            Brought(name, reading.input(name), reading.degree(Degree(name)))
            for name in program.input_names
            if name.casefold() in program.layout.brought
        ),
        aggregated=tuple(
            Aggregated(
                label,
                condition_text(rule.condition),
                condition_formula(rule.condition, rule_block, reading.degree),
                degree,
            )
            for label, degree, rule_block, rule in reading.rules()
        ),
        activated=tuple(_activated(reading)),
        accumulated=tuple(_accumulated(reading)),
        defuzzified=tuple(_defuzzified(reading)),
    )


def _fuzzified(reading: _Reading) -> Iterator[Fuzzified]:
    inputs = {name.casefold() for name in reading.program.input_names}
    for each in reading.block.fuzzifications:
        if each.variable.casefold() in inputs:
            degrees = tuple(
                TermDegree(term.name, reading.degree(Is(each.variable, term.name))) for term in each.terms
            )
            yield Fuzzified(each.variable, reading.input(each.variable), degrees)


def _activated(reading: _Reading) -> Iterator[Activated]:
    for label, degree, _, rule in reading.rules():
        for each in rule.conclusions:
            weight = reading.degree(Degree(each.weight)) if isinstance(each.weight, str) else each.weight
            yield Activated(label, each.variable, each.term or "", degree, weight, weight * degree)


def _accumulated(reading: _Reading) -> Iterator[Accumulated]:
    for output in reading.block.defuzzifications:
        variable = output.variable.casefold()
        algorithms = dict.fromkeys(
            rule_block.accumulation
            for _, _, rule_block, rule in reading.rules()
            if any(each.variable.casefold() == variable for each in rule.conclusions)
        )
        words = [reading.program.layout.accumulated[variable, term.name.casefold()] for term in output.terms]
        degrees = tuple(
            TermDegree(term.name, float(reading.memory[word]))
            for term, word in zip(output.terms, words, strict=True)
        )
        yield Accumulated(output.variable, tuple(str(each) for each in algorithms), degrees)


def _defuzzified(reading: _Reading) -> Iterator[Defuzzified]:
    program = reading.program
    names = [name.casefold() for name in program.output_names]
    for output in reading.block.defuzzifications:
        index = names.index(output.variable.casefold())
        fallback = Origin.PREVIOUS if output.default is None else Origin.DEFAULT
        active = reading.memory[program.active_at + index] != 0.0
        yield Defuzzified(
            variable=output.variable,
            method=str(output.method),
            places=tuple(
                float(term.shape.value) for term in output.terms if isinstance(term.shape, Singleton)
            ),
            origin=Origin.RULES if active else fallback,
            value=float(reading.memory[program.outputs_at + index]),
        )
