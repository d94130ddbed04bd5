"""A function block in FCL → blocks of the library, in INT; what the library cannot do is refused (FCL414)."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial, reduce
from itertools import groupby

from fcl_sim.arithmetic.integer import FULL, fits_int
from fcl_sim.concept.aterm import ATERM_INT, MOST
from fcl_sim.concept.declaration import CEILING
from fcl_sim.concept.defuz import DEFUZ_INT
from fcl_sim.concept.execute import TABLE
from fcl_sim.concept.network import Network, Wiring
from fcl_sim.concept.operators import MAX_INT, MIN_INT, PROD_INT, SUM_INT
from fcl_sim.concept.scale import Scale
from fcl_sim.concept.sterm import STERM_INT
from fcl_sim.diagnostics import Diagnostic, InputFault, Place, Span
from fcl_sim.model import (
    Accumulation,
    And,
    AndOperator,
    Condition,
    Defuzzification,
    FunctionBlock,
    Fuzzification,
    Is,
    Method,
    Or,
    OrOperator,
    Point,
    Points,
    Rule,
    RuleBlock,
    Singleton,
    Term,
)
from fcl_sim.model.labels import unique_labels

AND = {AndOperator.MIN: MIN_INT, AndOperator.PROD: PROD_INT}
OR = {OrOperator.MAX: MAX_INT, OrOperator.BSUM: SUM_INT}
ACCU = {Accumulation.MAX: MAX_INT, Accumulation.BSUM: SUM_INT}
HINT = (
    "INT has terms of straight lines between 0 and 1, MIN, MAX, PROD, BSUM, and CoGS; else evaluate in REAL"
)


@dataclass(slots=True)
class _Translation:
    """A translation under way, and what it has found that the library cannot do."""

    block: FunctionBlock
    scales: Mapping[str, Scale]
    wiring: Wiring = field(default_factory=Wiring)
    found: dict[str, list[Place]] = field(default_factory=dict)
    inputs: dict[str, int] = field(default_factory=dict)
    terms: dict[tuple[str, str], int] = field(default_factory=dict)
    shares: dict[str, list[int]] = field(default_factory=dict)

    def refuse(self, feature: str, span: Span | None) -> None:
        places = self.found.setdefault(feature, [])
        if span is not None:
            places.append(Place(span))

    def counts(self, variable: str, value: float, span: Span | None) -> int:
        """Return a number of the text in counts of its variable."""
        counts = self.scales[variable.casefold()].counts(value)
        if not fits_int(counts):
            self.refuse(f"`{variable}` has a number beyond INT, {counts} counts", span)
            return 0
        return counts


def translated(block: FunctionBlock, scales: Mapping[str, Scale]) -> Network:
    """Return `block` as a network; `scales` are by case-folded names of variables.

    Raises InputFault, with every place, for what the library cannot do.
    """
    own = _Translation(block, scales)
    for variable in block.inputs:
        own.inputs[variable.name] = own.wiring.constant(0)
    for fuzzification in block.fuzzifications:
        _fuzzify(own, fuzzification)
    degrees, conclusions = _rules(own)
    outputs = {each.variable: _defuzzify(own, each, conclusions) for each in block.defuzzifications}
    for variable in block.outputs:
        if variable.name.casefold() not in {each.casefold() for each in outputs}:
            own.refuse(f"`{variable.name}` has no singletons", variable.span)
    if own.found:
        raise InputFault(
            Diagnostic(code="FCL414", message=f"not in INT: {feature}", places=tuple(places), hint=HINT)
            for feature, places in own.found.items()
        )
    declared = {each.name.casefold(): each.name for each in block.outputs}
    return own.wiring.network(
        own.inputs,
        {declared[name.casefold()]: word for name, word in outputs.items()},
        degrees,
        {declared[name.casefold()]: words for name, words in own.shares.items()},
    )


def _fuzzify(own: _Translation, fuzzification: Fuzzification) -> None:
    """Add FUZ_ATERM where the terms share out 1 between neighbours, else a FUZ_STERM for each."""
    variable = fuzzification.variable
    words = {name.casefold(): word for name, word in own.inputs.items()}
    if variable.casefold() not in words:
        own.refuse(f"`{variable}` is no input", fuzzification.span)
        return
    x = words[variable.casefold()]
    if fuzzification.clamped or not fuzzification.enabled:
        own.refuse(f"`{variable}` is locked to its range, or switched off", fuzzification.span)
    shapes = {term.name.casefold(): _corners(own, variable, term) for term in fuzzification.terms}
    peaks = sorted({x for corners in shapes.values() for x, degree in corners if degree == 1})
    order = _shared_out(shapes, peaks)
    if order is not None:
        sources = [x, *map(own.wiring.constant, peaks)]
        name = f"fuzzification of {variable}"
        at = own.wiring.step(name, TABLE.index(ATERM_INT), sources, len(peaks), [0] * MOST)
        own.terms |= {(variable.casefold(), term): at + place for place, term in enumerate(order)}
        return
    for term, corners in shapes.items():
        xs = [at for at, _ in corners]
        if [degree for _, degree in corners] == [1, 0]:
            xs.reverse()  # two points the other way round have no side up (p. 72)
        sources = [x, *map(own.wiring.constant, xs)]
        name = f"fuzzification of {variable} IS {term}"
        at = own.wiring.step(name, TABLE.index(STERM_INT), sources, len(xs), [0])
        own.terms[variable.casefold(), term] = at


Corners = list[tuple[int, int]]


def _corners(own: _Translation, variable: str, term: Term) -> Corners:
    """Return the points of a term in counts and degrees 0 and 1, without those on a level end."""
    shape = term.shape
    points: Sequence[Point] = shape.points if isinstance(shape, Points) else ()
    if not points or any(isinstance(point.x, str) or point.degree not in {0, 1} for point in points):
        own.refuse(f"`{term.name}` of `{variable}` is not of straight lines between 0 and 1", term.span)
        return [(0, 0), (0, 1)]
    corners = [
        (own.counts(variable, point.x, term.span), int(point.degree))
        for point in points
        if not isinstance(point.x, str)
    ]
    runs = [list(run) for _, run in groupby(corners, key=lambda corner: corner[1])]
    kept = [corner for run in runs for corner in dict.fromkeys((run[0], run[-1]))]
    kept = kept[len(dict.fromkeys((runs[0][0], runs[0][-1]))) - 1 :]
    kept = kept[: len(kept) + 1 - len(dict.fromkeys((runs[-1][0], runs[-1][-1])))]
    if [degree for _, degree in kept] not in ([0, 1], [1, 0], [0, 1, 0], [0, 1, 1, 0]):
        own.refuse(f"`{term.name}` of `{variable}` has not one side up, one down, or both", term.span)
        return [(0, 0), (0, 1)]
    return kept


def _shared_out(shapes: Mapping[str, Corners], peaks: Sequence[int]) -> list[str] | None:
    """Return the terms in the order of their peaks where each falls as the next rises, else None."""
    if not 2 <= len(peaks) == len(shapes) <= MOST:
        return None
    order = []
    for place, peak in enumerate(peaks):
        neighbours = peaks[max(0, place - 1) : place + 2]
        wanted = [(x, int(x == peak)) for x in neighbours]
        names = [name for name, corners in shapes.items() if corners == wanted]
        if len(names) != 1:
            return None
        order += names
    return order


Conclusions = dict[tuple[str, str], dict[int, list[int]]]
"""By output and term: by rule block, the words with its rules' degrees."""


def _rules(own: _Translation) -> tuple[dict[str, int], Conclusions]:
    """Add conditions and weights of all rules; return the words of their degrees, and conclusions."""
    degrees: dict[str, int] = {}
    conclusions: Conclusions = {}
    labels = iter(unique_labels(own.block))
    for number, rule_block in enumerate(own.block.rule_blocks):
        for rule in rule_block.rules:
            label = next(labels)
            degree = _condition(own, rule_block, rule, rule.condition)
            degrees[label] = degree
            for each in rule.conclusions:
                if isinstance(each.weight, str) or each.term is None:
                    own.refuse("weights and degrees that are variables", each.span or rule.span)
                    continue
                word = degree
                if each.weight != 1:
                    weight = own.wiring.constant(round(each.weight * FULL))
                    name = f"the weight of rule {label}"
                    word = own.wiring.step(name, TABLE.index(PROD_INT), [degree, weight], 2, [0])
                target = (each.variable.casefold(), each.term.casefold())
                conclusions.setdefault(target, {}).setdefault(number, []).append(word)
        if not rule_block.enabled:
            own.refuse(f"rule block `{rule_block.name}` is switched off", rule_block.span)
    return degrees, conclusions


def _condition(own: _Translation, rule_block: RuleBlock, rule: Rule, condition: Condition) -> int:
    """Add a condition; return the word of its degree."""
    if isinstance(condition, Is) and not condition.hedges:
        key = condition.variable.casefold(), condition.term.casefold()
        if key not in own.terms:
            own.refuse("degrees that rules have concluded, in a condition", condition.span or rule.span)
        return own.terms.get(key, 0)
    if isinstance(condition, And | Or):
        conjunction = isinstance(condition, And)
        chosen = (
            AND.get(rule_block.and_operator) if isinstance(condition, And) else OR.get(rule_block.or_operator)
        )
        if chosen is None:
            said = f"AND: {rule_block.and_operator}" if conjunction else f"OR: {rule_block.or_operator}"
            own.refuse(said, rule_block.span)
        words = [_condition(own, rule_block, rule, each) for each in condition.arguments]
        return _joined(own, f"rule {rule.label}", TABLE.index(chosen or MIN_INT), words)
    own.refuse("NOT, hedges, and degrees brought in", getattr(condition, "span", None) or rule.span)
    return 0


def _joined(own: _Translation, name: str, opcode: int, words: Sequence[int]) -> int:
    """Add as many blocks as it takes to join degrees; return the word of the result."""

    def join(members: Sequence[int]) -> int:
        return own.wiring.step(name, opcode, list(members), len(members), [0])

    first, rest = list(words[:CEILING]), words[CEILING:]
    if len(words) == 1:
        return words[0]
    parts = [rest[at : at + CEILING - 1] for at in range(0, len(rest), CEILING - 1)]
    return reduce(lambda before, part: join([before, *part]), parts, join(first))


def _defuzzify(own: _Translation, output: Defuzzification, conclusions: Conclusions) -> int:
    """Add the accumulation and DEFUZ of an output; return the word of its value."""
    _refuse_output(own, output)
    kinds = {
        number: output.accumulation or rule_block.accumulation
        for number, rule_block in enumerate(own.block.rule_blocks)
        if any(
            number in conclusions.get((output.variable.casefold(), each.name.casefold()), {})
            for each in output.terms
        )
    }
    for kind in set(kinds.values()) - set(ACCU):
        own.refuse(f"ACCU: {kind}", output.span)
    pairs: list[int] = []
    accumulate = partial(_accumulated, own, output, kinds, conclusions)
    for term in output.terms:
        place = term.shape.value if isinstance(term.shape, Singleton) else None
        if place is None or isinstance(place, str):
            own.refuse(f"`{term.name}` of `{output.variable}` is not a constant singleton", term.span)
            continue
        pairs += [accumulate(term), own.wiring.constant(own.counts(output.variable, place, term.span))]
    own.shares[output.variable] = pairs[::2]
    pairs += [own.wiring.constant(0)] * (4 - len(pairs))
    if len(pairs) > DEFUZ_INT.most:
        own.refuse(f"`{output.variable}` has more than {DEFUZ_INT.most // 2} terms", output.span)
    zero = own.wiring.constant(int(not output.held and output.default is not None))
    name = f"defuzzification of {output.variable}"
    return own.wiring.step(name, TABLE.index(DEFUZ_INT), [zero, *pairs], len(pairs), [_initial(own, output)])


def _accumulated(
    own: _Translation,
    output: Defuzzification,
    kinds: Mapping[int, Accumulation],
    conclusions: Conclusions,
    term: Term,
) -> int:
    """Add the accumulation of one term; rule blocks that disagree are joined by MAX (S26)."""
    members = conclusions.get((output.variable.casefold(), term.name.casefold()), {})
    agreed = len(set(kinds.values())) <= 1
    groups = [[word for words in members.values() for word in words]] if agreed else list(members.values())
    operators = [kinds[number] for number in members]
    name = f"accumulation of {output.variable} IS {term.name}"
    joined = [
        _joined(own, name, TABLE.index(ACCU.get(kind, MAX_INT)), group)
        for kind, group in zip(operators, groups, strict=False)
        if group
    ]
    return _joined(own, name, TABLE.index(MAX_INT), joined) if joined else own.wiring.constant(0)


def _refuse_output(own: _Translation, output: Defuzzification) -> None:
    for feature in _beyond(own, output):
        own.refuse(feature, output.span)


def _beyond(own: _Translation, output: Defuzzification) -> Iterator[str]:
    variable = output.variable
    if output.method not in {Method.COG, Method.COGS}:
        yield f"METHOD: {output.method}"
    if output.clamped or not output.enabled:
        yield f"`{variable}` is locked to its range, or switched off"
    if output.default and not output.held:
        yield f"DEFAULT := {output.default:g}, where FUZ has 0 or the last value"
    if not output.held and output.default == 0 and own.scales[variable.casefold()].offset:
        yield f"DEFAULT := 0 of `{variable}`, whose count 0 is another value"


def _initial(own: _Translation, output: Defuzzification) -> int:
    """Return what an output begins with, in counts."""
    declared = [each for each in own.block.outputs if each.name.casefold() == output.variable.casefold()]
    value = output.default if output.held and output.default is not None else declared[0].initial
    return 0 if value is None else own.counts(output.variable, value, output.span)
