"""What is to be said about rules beside each other: twice the same, contradictions, rules without effect."""

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations

from fcl_sim.model import Accumulation, AndOperator, Conclusion, FunctionBlock, OrOperator, Rule, RuleBlock
from fcl_sim.model.labels import unique_labels
from fcl_sim.proof.axes import Axis
from fcl_sim.proof.clauses import Ask, Clause, clauses_of
from fcl_sim.proof.cubes import firings

KEEPING = frozenset((AndOperator.MIN, AndOperator.PROD))
"""AND under which one more subcondition never raises a degree, and of which the Basic Level speaks."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Said:
    """One conclusion of a rule: `place` counts through the text, `clauses` are the alternatives asked for."""

    label: str
    place: int
    rule: Rule
    rule_block: RuleBlock
    conclusion: Conclusion
    clauses: frozenset[Clause] | None

    @property
    def output(self) -> str:
        """The variable it concludes on, in lower case."""
        return self.conclusion.variable.casefold()

    @property
    def what(self) -> tuple[str, tuple[str, ...]]:
        """The term it concludes, and hedges."""
        return (self.conclusion.term or "").casefold(), tuple(map(str, self.conclusion.hedges))

    @property
    def operators(self) -> tuple[str, str]:
        """The algorithms of AND and OR."""
        return self.rule_block.and_operator, self.rule_block.or_operator


@dataclass(frozen=True, slots=True)
class Pair:
    """Two conclusions of which the first is to be told, and the other is why."""

    told: Said
    because: Said


def said(block: FunctionBlock) -> tuple[Said, ...]:
    """Return every conclusion of the rules that count, in the order of the text."""
    labels = iter(unique_labels(block))
    found = []
    place = 0
    for rule_block in block.rule_blocks:
        for rule in rule_block.rules:
            label, clauses = next(labels), clauses_of(rule.condition)
            if rule_block.enabled:
                found += [
                    Said(
                        label=label,
                        place=place,
                        rule=rule,
                        rule_block=rule_block,
                        conclusion=each,
                        clauses=clauses,
                    )
                    for each in rule.conclusions
                ]
            place += 1
    return tuple(found)


def without_weight(conclusions: Sequence[Said]) -> tuple[Said, ...]:
    """Return the conclusions WITH 0."""
    return tuple(each for each in conclusions if each.conclusion.weight == 0.0)


def dead(block: FunctionBlock, axes: Sequence[Axis], conclusions: Sequence[Said]) -> tuple[Said, ...]:
    """Return the first conclusion of each rule that cannot fire anywhere, its weight aside."""
    alive = {each.rule for each in firings(block, axes, certain=False, least=-1.0) if each.cubes}
    found: dict[int, Said] = {}
    for each in conclusions:
        if each.place not in alive:
            found.setdefault(each.place, each)
    return tuple(found.values())


def asks_in_vain(each: Said, terms: Collection[tuple[str, str]]) -> bool:
    """Return whether every alternative of a rule asks for one of `terms`, by input and name in lower case."""
    return bool(each.clauses) and all(
        any((ask.variable, ask.term) in terms and not ask.hedges and not ask.negated for ask in clause)
        for clause in each.clauses or ()
    )


def twice(conclusions: Sequence[Said]) -> tuple[Pair, ...]:
    """Return conclusions that an earlier rule with the same condition has already."""
    return _once(Pair(later, first) for first, later in _alike(conclusions) if first.what == later.what)


def contradictory(conclusions: Sequence[Said]) -> tuple[Pair, ...]:
    """Return conclusions on one output that differ though the conditions are the same."""
    return _once(Pair(later, first) for first, later in _alike(conclusions) if first.what != later.what)


def _once(pairs: Iterable[Pair]) -> tuple[Pair, ...]:
    """Return the first pair of each conclusion that is told."""
    found: dict[tuple[int, str], Pair] = {}
    for each in pairs:
        found.setdefault((each.told.place, each.told.output), each)
    return tuple(found.values())


def _alike(conclusions: Sequence[Said]) -> Iterator[tuple[Said, Said]]:
    """Yield pairs of two rules that ask for the same and conclude on the same output."""
    groups: dict[tuple[str, frozenset[Clause]], list[Said]] = {}
    for each in conclusions:
        if each.clauses is not None and each.conclusion.weight != 0.0:
            groups.setdefault((each.output, each.clauses), []).append(each)
    for group in groups.values():
        for first, later in combinations(group, 2):
            if first.place != later.place:
                yield first, later


def idle(conclusions: Sequence[Said], axes: Sequence[Axis]) -> tuple[Pair, ...]:
    """Return conclusions that never matter: another rule concludes the same, never less.

    That is so only where MAX accumulates; rules with the same condition are `twice`.
    """
    implied = _Implied(axes)
    groups: dict[tuple[object, ...], list[Said]] = {}
    for each in _comparable(conclusions):
        if each.rule_block.accumulation is Accumulation.MAX:
            groups.setdefault((each.output, each.what), []).append(each)
    found = []
    for told, because in (pair for own in groups.values() for pair in _pairs(own)):
        if (
            told.place != because.place
            and told.clauses != because.clauses
            and _weight(told) <= _weight(because)
            and implied.rule(told, because)
        ):
            found.append(Pair(told, because))
    return tuple(sorted(_once(found), key=lambda each: each.told.place))


def nested(conclusions: Sequence[Said]) -> tuple[Pair, ...]:
    """Return conclusions of rules that ask for more than another one that concludes something else.

    Whatever OR is, it is not below any of its arguments: the other one may have several alternatives.
    """
    general: dict[str, dict[Clause, list[Said]]] = {}
    for each in conclusions:
        if _counts(each):
            for clause in each.clauses or ():
                general.setdefault(each.output, {}).setdefault(clause, []).append(each)
    found = []
    for told in _comparable(conclusions):
        known = general[told.output]
        first = next(iter(told.clauses or (frozenset(),)))
        others = {
            (each.place, each.what): each
            for part in (first, *_parts(first, [*known]))
            for each in known.get(part, ())
        }
        found += [
            Pair(told, others[key])
            for key in sorted(others)
            if told.what != others[key].what and _asks_for_more(told, others[key])
        ]
    return tuple(found)


def _parts(own: Clause, known: Sequence[Clause]) -> Iterator[Clause]:
    """Yield those of the known clauses that are a part of the own: the shorter way is taken."""
    if len(known) < 2 ** len(own):
        yield from (each for each in known if each < own)
    else:
        for size in range(len(own)):
            yield from map(frozenset, combinations(own, size))


def _pairs(conclusions: Sequence[Said]) -> Iterator[tuple[Said, Said]]:
    """Yield pairs of conclusions of which the first may ask for more than the other."""
    shortest = [min(map(len, each.clauses or ()), default=0) for each in conclusions]
    longest = [max(map(len, each.clauses or ()), default=0) for each in conclusions]
    for first, told in enumerate(conclusions):
        for other, because in enumerate(conclusions):
            if first != other and shortest[other] <= longest[first]:
                yield told, because


def _asks_for_more(told: Said, because: Said) -> bool:
    """Return whether each alternative of the first has one of the other's in it, under the same AND."""
    own, others = told.clauses or (), because.clauses or ()
    return (
        told.rule_block.and_operator is because.rule_block.and_operator
        and own != others
        and all(any(other <= each for other in others) for each in own)
    )


def _comparable(conclusions: Sequence[Said]) -> list[Said]:
    """Return the conclusions whose degree is the largest of those of their alternatives."""
    return [
        each
        for each in conclusions
        if _counts(each) and (len(each.clauses or ()) == 1 or each.rule_block.or_operator is OrOperator.MAX)
    ]


def _counts(each: Said) -> bool:
    return (
        each.clauses is not None and each.rule_block.and_operator in KEEPING and each.conclusion.weight != 0.0
    )


def _weight(each: Said) -> float:
    """Return a weight as it can be compared; one that a variable holds is at most 1."""
    return 1.0 if isinstance(each.conclusion.weight, str) else each.conclusion.weight


class _Implied:
    """Whether the degree of one subcondition is nowhere above that of another."""

    def __init__(self, axes: Sequence[Axis]) -> None:
        self._axes: Mapping[str, Axis] = {each.variable.casefold(): each for each in axes}
        self._known: dict[tuple[Ask, Ask], bool] = {}

    def rule(self, told: Said, because: Said) -> bool:
        """Whether a rule never fires more than another, which must have no weight of a variable."""
        if told.operators != because.operators or isinstance(because.conclusion.weight, str):
            return False
        own, others = told.clauses or (), because.clauses or ()
        return all(any(self._clause(each, other) for other in others) for each in own)

    def _clause(self, own: Clause, other: Clause) -> bool:
        """Whether each subcondition of the other follows from one of the own, no two from the same."""
        free = set(own)
        for wanted in sorted(other, key=lambda each: each not in own):
            found = next((each for each in sorted(free) if self._ask(each, wanted)), None)
            if found is None:
                return False
            free.remove(found)
        return True

    def _ask(self, own: Ask, other: Ask) -> bool:
        if own == other:
            return True
        if own.variable != other.variable or own.hedges or other.hedges or own.negated or other.negated:
            return False
        key = (own, other)
        if key not in self._known:
            axis = self._axes.get(own.variable)
            self._known[key] = axis is not None and all(
                high <= low for high, low in zip(axis.highs[own.term], axis.lows[other.term], strict=True)
            )
        return self._known[key]
