"""What a figure of an inference shows: a function block and its explanation, brought together."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import isfinite, nan

from fcl_sim.engine.explain import Accumulated, Activated, Brought, Defuzzified, Explanation, Origin
from fcl_sim.engine.switches import limits_of
from fcl_sim.engine.words import condition_text, subconditions
from fcl_sim.model import (
    Conclusion,
    Condition,
    Defuzzification,
    Formula,
    FunctionBlock,
    Is,
    Not,
    Singleton,
    Term,
)
from fcl_sim.report import lettering
from fcl_sim.report.terms import REACH, Initials, calculated, drawn, extent, standing
from fcl_sim.report.words import number, one_line

MARGIN = 0.05
"""Room beyond the outermost points, as a share of their span."""

UNIT = 22.0
"""A unit takes at most so much, in mm."""

Units = Mapping[str, str]


@dataclass(frozen=True, slots=True, kw_only=True)
class Variable:
    """A variable and its terms as they stand at the instant, on an axis from `low` to `high`.

    A singleton whose place was not calculated stands at NaN.
    """

    name: str
    unit: str
    terms: tuple[Term, ...]
    low: float
    high: float

    def index(self, term: str) -> int:
        """Return the number of the term of that name."""
        return [each.name.casefold() for each in self.terms].index(term.casefold())


@dataclass(frozen=True, slots=True, kw_only=True)
class Input(Variable):
    """A fuzzified input: its value, the degree of each term, and the place where they hold.

    That is another than the value where the input is kept in a range.
    """

    value: float
    at: float
    degrees: tuple[float, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Output(Variable):
    """A defuzzified output: what was accumulated, the limits of its areas, and the result.

    `ranged` says that the limits are its RANGE. `calculated` are its formulae,
    with what they gave.
    """

    limits: tuple[float, float]
    ranged: bool
    accumulated: Accumulated
    defuzzified: Defuzzified
    calculated: tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Leaf:
    """A subcondition and its degree; `input` is None where the degree comes from elsewhere."""

    variable: str
    predicate: str
    degree: float
    input: Input | None
    term: int
    negated: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class Fired:
    """A rule that fired."""

    label: str
    sentence: str
    leaves: tuple[Leaf, ...]
    formula: str
    degree: float
    activated: tuple[Activated, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class View:
    """One evaluation; `quiet` are the labels of the rules that did not fire.

    `others` are what rules concluded on that is not defuzzified: degrees given
    out and local variables.
    """

    name: str
    inputs: tuple[Input, ...]
    brought: tuple[Brought, ...]
    rules: tuple[Fired, ...]
    quiet: tuple[str, ...]
    outputs: tuple[Output, ...]
    others: tuple[Accumulated, ...]

    def output(self, variable: str) -> Output | None:
        """Return the defuzzified output of that name, if there is one."""
        return next((each for each in self.outputs if each.name.casefold() == variable.casefold()), None)


def view(block: FunctionBlock, explanation: Explanation, units: Units | None = None) -> View:
    """Return what is to be shown of an explanation of `block`; `units` by variable, letter case ignored."""
    unit_of = {name.casefold(): lettering.cut(one_line(unit), UNIT) for name, unit in (units or {}).items()}
    values = {each.variable.casefold(): each.value for each in explanation.inputs}
    inputs = tuple(_inputs(block, explanation, values, unit_of))
    outputs = tuple(_outputs(block, explanation, values, unit_of))
    named = {each.name.casefold() for each in outputs}
    return View(
        name=block.name,
        inputs=inputs,
        brought=explanation.brought,
        rules=tuple(_fired(block, explanation, inputs)),
        quiet=tuple(each.rule for each in explanation.aggregated if not each.degree > 0.0),
        outputs=outputs,
        others=tuple(each for each in explanation.accumulated if each.variable.casefold() not in named),
    )


def _inputs(
    block: FunctionBlock, explanation: Explanation, values: Initials, unit_of: Units
) -> Iterator[Input]:
    found = {each.variable.casefold(): each for each in explanation.fuzzified}
    for fuzzification in block.fuzzifications:
        fuzzified = found.get(fuzzification.variable.casefold())
        if fuzzified is None:
            continue
        limits = limits_of(block, fuzzification)
        value = fuzzified.value
        low, high = _stretched(extent(fuzzification.terms, values), value)
        yield Input(
            name=fuzzified.variable,
            unit=unit_of.get(fuzzified.variable.casefold(), ""),
            terms=tuple(drawn(standing(term, values), (low, high)) for term in fuzzification.terms),
            low=low,
            high=high,
            value=value,
            at=value if limits is None else min(max(value, limits[0]), limits[1]),
            degrees=tuple(each.degree for each in fuzzified.degrees),
        )


def _stretched(ends: tuple[float, float], value: float) -> tuple[float, float]:
    """Return an axis that shows `ends` with some room, and a value that is not too far from them."""
    low, high = ends
    span = high - low
    if isfinite(value) and low - REACH * span <= value <= high + REACH * span:
        low, high = min(low, value), max(high, value)
    room = MARGIN * (high - low)
    return low - room, high + room


def _outputs(
    block: FunctionBlock, explanation: Explanation, values: Initials, unit_of: Units
) -> Iterator[Output]:
    accumulated = {each.variable.casefold(): each for each in explanation.accumulated}
    results = {each.variable.casefold(): each for each in explanation.defuzzified}
    for output in block.defuzzifications:
        name = output.variable.casefold()
        if name not in results:
            continue
        terms = tuple(_placed(output, results[name], values))
        placed = [each for each in terms if not isinstance(each.shape, Singleton) or _known(each.shape)]
        area = any(not isinstance(each.shape, Singleton) for each in placed)
        limits = output.range if area and output.range is not None else extent(placed, values)
        low, high = _stretched(limits, results[name].value)
        yield Output(
            name=results[name].variable,
            unit=unit_of.get(name, ""),
            terms=tuple(drawn(term, (low, high)) for term in terms),
            low=low,
            high=high,
            limits=limits,
            ranged=area and output.range is not None,
            accumulated=accumulated[name],
            defuzzified=results[name],
            calculated=tuple(_calculated(output, terms)),
        )


def _known(shape: Singleton) -> bool:
    return isfinite(float(shape.value))


def _placed(output: Defuzzification, result: Defuzzified, values: Initials) -> Iterator[Term]:
    """Yield the terms of an output where they stand; formulae are calculated only where a rule is active."""
    for index, term in enumerate(output.terms):
        if isinstance(term.shape, Formula):
            place = result.places[index] if result.origin is Origin.RULES else nan
            yield Term(term.name, Singleton(place))
        else:
            yield standing(term, values)


def _calculated(output: Defuzzification, terms: Sequence[Term]) -> Iterator[str]:
    """Yield the formulae of an output with what they gave."""
    for term, placed in zip(output.terms, terms, strict=True):
        if isinstance(term.shape, Formula) and isinstance(placed.shape, Singleton):
            result = f" = {number(float(placed.shape.value))}" if _known(placed.shape) else ""
            yield calculated(term) + result


def _fired(block: FunctionBlock, explanation: Explanation, inputs: Sequence[Input]) -> Iterator[Fired]:
    by_name = {each.name.casefold(): each for each in inputs}
    rules = [rule for rule_block in block.rule_blocks for rule in rule_block.rules]
    for rule, told in zip(rules, explanation.aggregated, strict=True):
        if told.degree > 0.0:
            conclusions = ", ".join(_conclusion(each) for each in rule.conclusions)
            yield Fired(
                label=told.rule,
                sentence=one_line(f"IF {told.condition} THEN {conclusions}"),
                leaves=tuple(
                    _leaf(leaf, each.degree, by_name)
                    for leaf, each in zip(subconditions(rule.condition), told.subconditions, strict=True)
                ),
                formula=told.formula,
                degree=told.degree,
                activated=tuple(each for each in explanation.activated if each.rule == told.rule),
            )


def _conclusion(each: Conclusion) -> str:
    subject = each.variable if each.term is None else f"{each.variable} IS {each.term}"
    if each.weight == 1.0:
        return subject
    return f"{subject} WITH {each.weight if isinstance(each.weight, str) else number(each.weight)}"


def _leaf(leaf: Condition, degree: float, inputs: Mapping[str, Input]) -> Leaf:
    negated = isinstance(leaf, Not)
    inner = leaf.argument if isinstance(leaf, Not) else leaf
    if isinstance(inner, Is):
        shown = inputs.get(inner.variable.casefold())
        predicate = f"IS{' NOT' if negated else ''} {inner.term}"
        term = shown.index(inner.term) if shown else 0
        variable = inner.variable
    else:
        shown, predicate, term, variable = None, "", 0, condition_text(leaf)
    return Leaf(
        variable=variable, predicate=predicate, degree=degree, input=shown, term=term, negated=negated
    )
