"""One evaluation of a rule base in fractions: what it gives at a point of no width, without rounding.

Inputs, points, weights and places are the decimal numbers that were written. What
is no fraction by its nature (a bell, a root) is computed and told as rounded.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import isnan

import numpy as np

from fcl_sim.engine.conditions import NORM_CODE
from fcl_sim.engine.evaluate import declared_name
from fcl_sim.engine.explain import Origin
from fcl_sim.engine.grid import Base
from fcl_sim.engine.plan_areas import algorithms, grouped
from fcl_sim.engine.refuse import has_area
from fcl_sim.engine.smooth import degrees_at
from fcl_sim.engine.straighten import straightened
from fcl_sim.engine.switches import limits_of, switched
from fcl_sim.model import (
    Accumulation,
    And,
    Condition,
    Curve,
    Defuzzification,
    Degree,
    Formula,
    FunctionBlock,
    Fuzzification,
    Hedge,
    Is,
    Method,
    Not,
    Or,
    Points,
    RuleBlock,
    Singleton,
    Term,
)
from fcl_sim.model.labels import unique_labels
from fcl_sim.proof.exact_areas import Piece, accumulated, content, defuzzified, profile
from fcl_sim.proof.points import membership
from fcl_sim.proof.profiles import largest
from fcl_sim.proof.rationals import ZERO, NotExact, calculated, clamped, conjunction, disjunction, hedged
from fcl_sim.units import exact


@dataclass(frozen=True, slots=True)
class ExactOutput:
    """The number an output gets, None for NaN, and where from (S30)."""

    variable: str
    value: Fraction | None
    origin: Origin


@dataclass(frozen=True, slots=True, kw_only=True)
class Exactly:
    """One evaluation in fractions: degrees of terms and of rules, in the order of the text, and outputs.

    `rounded` says what is no fraction, so that it was computed in some digits.
    """

    inputs: Mapping[str, Fraction]
    terms: tuple[tuple[str, str, Fraction], ...]
    rules: tuple[tuple[str, Fraction], ...]
    outputs: tuple[ExactOutput, ...]
    rounded: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class _Result:
    """A conclusion of a rule: its rule block by number, its degree after hedges, its weight."""

    block: int
    variable: str
    term: str | None
    degree: Fraction
    weight: Fraction


def exactly(block: FunctionBlock, point: Mapping[str, Fraction]) -> Exactly:
    """Return what a block that the engine can evaluate gives at a point, from its initial state.

    `point` is by the name of each input, letter case aside; one with an initial
    value may be left out. Raises TypeError where names do not fit, NotExact where
    areas or formulae are beyond fractions.
    """
    return _Evaluation(block, _given(block, point)).result()


def _given(block: FunctionBlock, point: Mapping[str, Fraction]) -> dict[str, Fraction]:
    names = tuple(each.name for each in block.inputs)
    given = {declared_name(name, names, "input"): value for name, value in point.items()}
    for each in block.inputs:
        if each.name not in given and each.initial is None:
            raise TypeError(f"{block.name} needs a value for {each.name}")
    return {
        each.name.casefold(): given.get(each.name, exact(float(each.initial or 0.0))) for each in block.inputs
    }


class _Evaluation:
    def __init__(self, block: FunctionBlock, inputs: Mapping[str, Fraction]) -> None:
        self._block, self._inputs = block, inputs
        self._sound = straightened(switched(block))
        self._rounded: dict[str, None] = {}
        self._results: list[_Result] = []
        self._rules: list[Fraction] = []
        self._terms = {
            (each.variable.casefold(), term.name.casefold()): self._fuzzified(each, term)
            for each in self._sound.fuzzifications
            for term in each.terms
            if each.variable.casefold() in inputs
        }

    def result(self) -> Exactly:
        """Evaluate the rules in the order of the text, then the outputs."""
        for number, rule_block in enumerate(self._sound.rule_blocks):
            for rule in rule_block.rules:
                degree = self._degree(rule.condition, rule_block)
                self._rules.append(degree)
                for each in rule.conclusions:
                    term = each.term and each.term.casefold()
                    own = self._hedged(each.hedges, degree, f"rule {rule.label}")
                    weight = self._weight(each.weight)
                    self._results.append(_Result(number, each.variable.casefold(), term, own, weight))
        names = {each.name.casefold(): each.name for each in self._block.inputs}
        return Exactly(
            inputs={names[key]: value for key, value in self._inputs.items()},
            terms=tuple(
                (each.variable, term.name, self._terms[each.variable.casefold(), term.name.casefold()])
                for each in self._block.fuzzifications
                for term in each.terms
                if each.variable.casefold() in self._inputs
            ),
            rules=tuple(zip(unique_labels(self._block), self._rules, strict=True)),
            outputs=tuple(self._outputs()),
            rounded=tuple(self._rounded),
        )

    def _number(self, value: float | str) -> Fraction:
        return self._inputs[value.casefold()] if isinstance(value, str) else exact(float(value))

    def _weight(self, weight: float | str) -> Fraction:
        return clamped(self._number(weight))

    def _fuzzified(self, fuzzification: Fuzzification, term: Term) -> Fraction:
        x = self._inputs[fuzzification.variable.casefold()]
        limits = limits_of(self._block, fuzzification)
        if limits is not None:
            x = min(max(x, exact(limits[0])), exact(limits[1]))
        match term.shape:
            case Points():
                return membership(self._base(term.shape), x)
            case Curve(kind, parameters, height):
                numbers = tuple(float(self._number(each)) for each in parameters)
                self._rounded[f"`{term.name}` of `{fuzzification.variable}`"] = None
                curve = Curve(kind, numbers, height)
                return Fraction(degrees_at(curve, np.array([float(x)])).item())
        raise NotExact(f"`{term.name}` of `{fuzzification.variable}` has a shape that is not evaluated")

    def _base(self, shape: Points) -> Base:
        """Return base points, each abscissa the largest so far (S22)."""
        found: list[tuple[Fraction, Fraction]] = []
        for each in shape.points:
            x = self._number(each.x)
            found.append((max(x, found[-1][0]) if found else x, exact(each.degree)))
        return tuple(found)

    def _degree(self, condition: Condition, operators: RuleBlock) -> Fraction:
        match condition:
            case Not(argument):
                return 1 - self._degree(argument, operators)
            case And(arguments):
                own = [self._degree(each, operators) for each in arguments]
                return conjunction(operators.and_operator, own)
            case Or(arguments):
                own = [self._degree(each, operators) for each in arguments]
                return disjunction(operators.or_operator, own)
            case Degree(variable):
                key = variable.casefold()
                if key in self._inputs:
                    return clamped(self._inputs[key])
                return clamped(self._accumulated(key).get(None, ZERO))
        return self._is(condition)

    def _is(self, condition: Is) -> Fraction:
        variable, term = condition.variable.casefold(), condition.term.casefold()
        if not term:
            degree = Fraction(1)
        elif (variable, term) in self._terms:
            degree = self._terms[variable, term]
        else:  # what the rules before have concluded (S27a)
            degree = clamped(self._accumulated(variable).get(term, ZERO))
        return self._hedged(condition.hedges, degree, f"`{condition.variable}`")

    def _hedged(self, hedges: Sequence[Hedge], degree: Fraction, what: str) -> Fraction:
        for hedge in reversed(hedges):
            degree, is_exact = hedged(hedge, degree)
            if not is_exact:
                self._rounded[f"`{hedge}` for {what}"] = None
        return degree

    def _accumulated(self, variable: str) -> dict[str | None, Fraction]:
        """Return the degree of each term that was concluded so far, as of singletons (Table 5, S26)."""
        kinds, group_of = grouped(algorithms(self._sound, variable))
        own = [each for each in self._results if each.variable == variable]
        degrees: dict[str | None, Fraction] = {each.term: ZERO for each in own}
        for group, kind in enumerate(kinds):
            members = [each for each in own if group_of[each.block] == group]
            for term, degree in _combined(kind, members).items():
                degrees[term] = max(degrees[term], degree)
        return degrees

    def _outputs(self) -> Iterator[ExactOutput]:
        defined = {each.variable.casefold(): each for each in self._sound.defuzzifications}
        for variable in self._block.outputs:
            key = variable.name.casefold()
            degrees = self._accumulated(key)
            if key in defined:
                value = self._defuzzified(defined[key], degrees) if any(degrees.values()) else None
                yield self._output(defined[key], variable.initial or 0.0, value)
            elif degrees:
                yield ExactOutput(variable.name, degrees[None], Origin.RULES)

    def _output(self, output: Defuzzification, initial: float, value: Fraction | None) -> ExactOutput:
        origin = Origin.RULES
        if value is None:
            held = output.held or output.default is None
            origin = Origin.PREVIOUS if held else Origin.DEFAULT
            number = initial if output.default is None else output.default
            value = None if isnan(number) else exact(float(number))
        if value is not None and output.clamped and output.range is not None:
            low, high = map(exact, output.range)
            value = min(max(value, low), high)
        return ExactOutput(output.variable, value, origin)

    def _defuzzified(
        self, output: Defuzzification, degrees: Mapping[str | None, Fraction]
    ) -> Fraction | None:
        """Return the number that the rules give; None where their area is 0 (S31)."""
        if has_area(output):
            return self._of_area(output)
        pairs = [
            (self._place(each), degrees[each.name.casefold()])
            for each in output.terms
            if degrees.get(each.name.casefold(), ZERO) > 0
        ]
        moment = sum((place * degree for place, degree in pairs), ZERO)
        top = max(degree for _, degree in pairs)
        highest = [place for place, degree in pairs if degree == top]
        match output.method:
            case Method.SUM:
                return moment
            case Method.LM:
                return min(highest)
            case Method.RM:
                return max(highest)
            case Method.MM:
                return (min(highest) + max(highest)) / 2
        return moment / sum((degree for _, degree in pairs), ZERO)

    def _place(self, term: Term) -> Fraction:
        match term.shape:
            case Singleton(value):
                return self._number(value)
            case Formula(expression):
                return calculated(expression, self._number)
        raise NotExact(f"`{term.name}` has a shape that is not evaluated")

    def _of_area(self, output: Defuzzification) -> Fraction | None:
        low, high = self._limits(output)
        kinds, group_of = grouped(algorithms(self._sound, output.variable.casefold()))
        profiles = []
        for group, kind in enumerate(kinds):
            own = [each for each in self._pieces(output) if group_of[each[0]] == group]
            if own:
                profiles.append(accumulated(kind, [profile(piece, low, high) for _, piece in own]))
        area = largest(profiles)
        if content(area) == 0:
            return None
        value, is_exact = defuzzified(output.method, area)
        if not is_exact:
            self._rounded[f"half of the area of `{output.variable}`"] = None
        return value

    def _bases(self, output: Defuzzification) -> dict[str, Base]:
        shapes = {each.name.casefold(): each.shape for each in output.terms}
        return {name: self._base(shape) for name, shape in shapes.items() if isinstance(shape, Points)}

    def _limits(self, output: Defuzzification) -> tuple[Fraction, Fraction]:
        """Return RANGE, else the hull of the points (S32)."""
        if output.range is not None:
            return exact(output.range[0]), exact(output.range[1])
        places = [x for base in self._bases(output).values() for x, _ in base]
        return min(places), max(places)

    def _pieces(self, output: Defuzzification) -> Iterator[tuple[int, Piece]]:
        """Yield what each conclusion that counts gives, with the number of its rule block."""
        bases, curves = self._bases(output), self._curves(output)
        for each in self._results:
            if each.variable == output.variable.casefold() and each.degree * each.weight > 0:
                term = each.term or ""
                if term in curves:
                    self._rounded[f"`{curves[term]}` of `{output.variable}`"] = None
                activation = self._sound.rule_blocks[each.block].activation
                yield (
                    each.block,
                    Piece(activation=activation, degree=each.degree, weight=each.weight, base=bases[term]),
                )

    def _curves(self, output: Defuzzification) -> dict[str, str]:
        """Return the terms that are polylines for the engine, but not in the text (S33)."""
        written = next(each for each in self._block.defuzzifications if each.variable == output.variable)
        return {each.name.casefold(): each.name for each in written.terms if isinstance(each.shape, Curve)}


def _combined(kind: Accumulation, members: Sequence[_Result]) -> dict[str | None, Fraction]:
    """Return the degree of each term by one algorithm."""
    shares: dict[str | None, list[Fraction]] = {}
    for each in members:
        shares.setdefault(each.term, []).append(each.degree * each.weight)
    if kind is Accumulation.MAX or kind in NORM_CODE:
        return {term: disjunction(kind, own) for term, own in shares.items()}
    sums = {term: sum(own, ZERO) for term, own in shares.items()}
    if kind is Accumulation.SUM:
        return sums
    if kind is Accumulation.BSUM:
        return {term: clamped(own) for term, own in sums.items()}
    divisor = max([Fraction(1), *sums.values()])
    return {term: own / divisor for term, own in sums.items()}
