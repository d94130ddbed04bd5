"""`explain`: one evaluation, step by step, read back from the instance's memory."""

import json
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from enum import StrEnum
from functools import partial

from fcl_sim.engine.concluded import degree_so_far
from fcl_sim.engine.entries import evaluate_once
from fcl_sim.engine.hedged import hedged_degree
from fcl_sim.engine.plan_areas import algorithms, conclusions
from fcl_sim.engine.program import Floats, Program
from fcl_sim.engine.switches import counted
from fcl_sim.engine.words import condition_formula, condition_text, subconditions
from fcl_sim.model import (
    Condition,
    Defuzzification,
    Degree,
    Formula,
    FunctionBlock,
    Is,
    Not,
    Rule,
    RuleBlock,
    Singleton,
)


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
class Taken:
    """An input and its value."""

    variable: str
    value: float


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
class Subcondition:
    """A subcondition without its hedges, or NOT one, and its degree."""

    condition: str
    degree: float


@dataclass(frozen=True, slots=True)
class Aggregated:
    """Aggregation of a rule's condition; `formula` shows its degrees under their operators.

    `subconditions` are in the order of the text; one under the hedge `any` is
    not among them.
    """

    rule: str
    condition: str
    subconditions: tuple[Subcondition, ...]
    formula: str
    degree: float


@dataclass(frozen=True, slots=True)
class Activated:
    """A conclusion after activation, which does nothing to a singleton, and after its weight (A.15).

    `term` is empty where a variable without terms is concluded. `activated` is
    the rule's degree after the hedges of the conclusion. `algorithm` is that of
    activation where the term has an area: MIN cuts it off at `activated`, PROD
    multiplies it, others take both; else it is empty.
    """

    rule: str
    variable: str
    term: str
    activated: float
    weight: float
    degree: float
    algorithm: str


@dataclass(frozen=True, slots=True)
class Accumulated:
    """Accumulation over the rules; several algorithms where rule blocks disagree.

    `degrees` are those of singletons, or the one of a variable without terms;
    `area` has the vertices (x, degree) of the accumulated area, without what
    is 0 to the left and to the right of it.
    """

    variable: str
    algorithms: tuple[str, ...]
    degrees: tuple[TermDegree, ...]
    area: tuple[tuple[float, float], ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Defuzzified:
    """The number an output gets, and where from.

    `method` is empty where a degree is given out (S28). `places` are its
    singletons in the order of the terms, else empty.
    """

    variable: str
    method: str
    places: tuple[float, ...]
    origin: Origin
    value: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Explanation:
    """One evaluation in the steps of A.2.1 to A.2.4; `inputs` are all of them, as declared."""

    name: str
    inputs: tuple[Taken, ...]
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

    def to_json(self) -> str:
        """Return the explanation as a JSON object with the fields of these classes."""
        return json.dumps(asdict(self), indent=2, ensure_ascii=False)


@dataclass(frozen=True, slots=True)
class _Reading:
    """A block, its program, and the memory that an evaluation left behind."""

    block: FunctionBlock
    program: Program
    memory: Floats

    def input(self, variable: str) -> float:
        names = [name.casefold() for name in self.program.input_names]
        return float(self.memory[names.index(variable.casefold())])

    def number(self, value: float | str) -> float:
        """Return a constant, or the value of an input variable."""
        return self.input(value) if isinstance(value, str) else value

    def places(self, output: Defuzzification) -> Iterator[float]:
        """Yield the places of an output's singletons, calculated ones among them."""
        for term in output.terms:
            if isinstance(term.shape, Singleton):
                yield self.number(term.shape.value)
            elif isinstance(term.shape, Formula):
                words = self.program.layout.places
                yield float(self.memory[words[output.variable.casefold(), term.name.casefold()]])

    def weight(self, weight: float | str) -> float:
        return self.degree(Degree(weight), 0) if isinstance(weight, str) else weight

    def degree(self, leaf: Condition, rule: int) -> float:
        """Return the degree of a subcondition, or of NOT one, as the rule of that number takes it."""
        negated = isinstance(leaf, Not)
        inner = leaf.argument if isinstance(leaf, Not) else leaf
        if not isinstance(inner, Is | Degree):
            raise TypeError(leaf)
        layout = self.program.layout
        variable = inner.variable.casefold()
        if isinstance(inner, Is) and (variable, inner.term.casefold()) in layout.terms:
            slots = layout.complements if negated else layout.terms
            return float(self.memory[slots[variable, inner.term.casefold()]])
        if isinstance(inner, Degree) and variable in layout.brought:
            return float(self.memory[layout.brought[variable] + int(negated)])
        before = self.memory[self.program.degrees_at :][:rule].tolist()
        term = inner.term if isinstance(inner, Is) else None
        degree = degree_so_far(self.block, variable, term, before, self.weight)
        return 1.0 - degree if negated else degree

    def accumulated(self, variable: str, term: str | None) -> float:
        """Return the degree that all rules have accumulated for a term."""
        word = self.program.layout.accumulated.get((variable, term))
        if word is not None:
            return float(self.memory[word])
        degrees = self.memory[self.program.degrees_at : self.program.recorded].tolist()
        return degree_so_far(self.block, variable, term, degrees, self.weight)

    def rules(self) -> Iterator[tuple[str, float, RuleBlock, Rule]]:
        """Yield label, degree of firing, rule block and rule of every rule."""
        pairs = [(each, rule) for each in self.block.rule_blocks for rule in each.rules]
        degrees = self.memory[self.program.degrees_at :]
        for label, degree, (rule_block, rule) in zip(self.program.rule_labels, degrees, pairs, strict=False):
            yield label, float(degree), rule_block, rule


def explain(block: FunctionBlock, program: Program, memory: Floats) -> Explanation:
    """Evaluate once on `memory`, an instance's with its inputs written, and tell each step.

    `program` is that of `block`. Every degree is read back from the memory
    that the evaluation leaves behind.
    """
    evaluate_once(program, memory)
    reading = _Reading(counted(block), program, memory)
    return Explanation(
        name=block.name,
        inputs=tuple(Taken(name, reading.input(name)) for name in program.input_names),
        fuzzified=tuple(_fuzzified(reading)),
        brought=tuple(
            Brought(name, reading.input(name), reading.weight(name))
            for name in program.input_names
            if name.casefold() in program.layout.brought
        ),
        aggregated=tuple(_aggregated(reading)),
        activated=tuple(_activated(reading)),
        accumulated=tuple(_accumulated(reading)),
        defuzzified=tuple(_defuzzified(reading)),
    )


def _fuzzified(reading: _Reading) -> Iterator[Fuzzified]:
    inputs = {name.casefold() for name in reading.program.input_names}
    for each in reading.block.fuzzifications:
        if each.variable.casefold() in inputs:
            degrees = tuple(
                TermDegree(term.name, reading.degree(Is(each.variable, term.name), 0)) for term in each.terms
            )
            yield Fuzzified(each.variable, reading.input(each.variable), degrees)


def _aggregated(reading: _Reading) -> Iterator[Aggregated]:
    for number, (label, degree, rule_block, rule) in enumerate(reading.rules()):
        degree_of = partial(reading.degree, rule=number)
        yield Aggregated(
            rule=label,
            condition=condition_text(rule.condition),
            subconditions=tuple(
                Subcondition(condition_text(each), degree_of(each)) for each in subconditions(rule.condition)
            ),
            formula=condition_formula(rule.condition, rule_block, degree_of),
            degree=degree,
        )


def _activated(reading: _Reading) -> Iterator[Activated]:
    for label, degree, rule_block, rule in reading.rules():
        for each in rule.conclusions:
            weight = reading.weight(each.weight)
            area = each.variable.casefold() in reading.program.layout.areas
            algorithm = str(rule_block.activation) if area else ""
            activated = hedged_degree(each.hedges, degree)
            result = weight * activated
            yield Activated(label, each.variable, each.term or "", activated, weight, result, algorithm)


def _accumulated(reading: _Reading) -> Iterator[Accumulated]:
    layout = reading.program.layout
    for variable, terms in _concluded(reading.block):
        name = variable.casefold()
        kinds = tuple(dict.fromkeys(map(str, algorithms(reading.block, name).values())))
        if name in layout.areas:
            first, end = (int(word) for word in reading.memory[layout.areas[name] :][:2])
            area = tuple((x, degree) for x, degree in reading.memory[first:end].reshape(-1, 2).tolist())
            yield Accumulated(variable, kinds, (), area)
        else:
            degrees = tuple(
                TermDegree(term or "", reading.accumulated(name, term and term.casefold())) for term in terms
            )
            yield Accumulated(variable, kinds, degrees, ())


def _concluded(block: FunctionBlock) -> Iterator[tuple[str, tuple[str | None, ...]]]:
    """Yield the variables that are defuzzified, then the others that rules conclude on, with their terms."""
    for output in block.defuzzifications:
        yield output.variable, tuple(term.name for term in output.terms)
    defined = {output.variable.casefold() for output in block.defuzzifications}
    others: dict[str, dict[str | None, None]] = {}
    for _, _, each in conclusions(block):
        if each.variable.casefold() not in defined:
            others.setdefault(each.variable, {})[each.term] = None
    yield from ((variable, tuple(terms)) for variable, terms in others.items())


def _defuzzified(reading: _Reading) -> Iterator[Defuzzified]:
    program = reading.program
    defined = {each.variable.casefold(): each for each in reading.block.defuzzifications}
    for index, name in enumerate(program.output_names):
        output = defined.get(name.casefold())
        value = float(reading.memory[program.outputs_at + index])
        if output is not None:
            fallback = Origin.PREVIOUS if output.held or output.default is None else Origin.DEFAULT
            active = reading.memory[program.active_at + index] != 0.0
            yield Defuzzified(
                variable=output.variable,
                method=str(output.method),
                places=tuple(reading.places(output)),
                origin=Origin.RULES if active else fallback,
                value=value,
            )
        elif (name.casefold(), None) in program.layout.accumulated:
            yield Defuzzified(variable=name, method="", places=(), origin=Origin.RULES, value=value)
