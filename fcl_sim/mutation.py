"""Which mutants of its rule bases a bench kills: scenarios in, the fate of each mutant out."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass, replace
from enum import StrEnum
from os import cpu_count
from pathlib import Path

from fcl_sim.block import Block
from fcl_sim.diagnostics import InputFault
from fcl_sim.engine.assemble import assemble
from fcl_sim.judge.compare import compare
from fcl_sim.judge.judge import judge
from fcl_sim.judge.verdict import Status, Verdict
from fcl_sim.loop.diagram import Diagram, FuzzyNode
from fcl_sim.loop.run import run as simulate
from fcl_sim.loop.trace import Trace
from fcl_sim.model import FunctionBlock
from fcl_sim.scenario.model import Scenario
from fcl_sim.testbench import Prepared, Run, prepare, run_together
from fcl_sim.verify.cause import with_rule_bases
from fcl_sim.verify.mutants import Mutant, mutants
from fcl_sim.verify.same_law import SAME, Difference, Visits, difference, visits

PILOTS = 16
"""How many mutants go through all runs first, to see which runs kill."""


class Group(StrEnum):
    """What became of a mutant."""

    REQUIREMENTS = "killed by requirements"
    """The verdict on a requirement that passes with the original is another one."""
    BASELINES = "killed by baselines"
    """No verdict changes, but a run leaves its baseline."""
    SAME = "alive, same law"
    """Nothing changes, and it gives the same as the original wherever the original's runs go."""
    DIFFERENT = "alive and different"
    """Nothing changes, though it gives something else where the runs go."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Killer:
    """What told a mutant from the original: the requirement, or `baseline`, with its verdict now."""

    scenario: str
    variant: str
    by: str
    status: Status


@dataclass(frozen=True, slots=True, kw_only=True)
class Fate:
    """A mutant, its group, what killed it, and where in the original's runs it differs most."""

    mutant: Mutant
    group: Group
    killer: Killer | None
    difference: Difference


@dataclass(frozen=True, slots=True, kw_only=True)
class Case:
    """A run that uses a rule base: the scenario, the run as it is prepared and as it came out, its others.

    `nodes` are its fuzzy blocks with this rule base, `visits` where each went.
    `others` are the runs of the scenario by variant, which requirements may be relative to.
    """

    scenario: str
    prepared: Prepared
    original: Run
    nodes: Mapping[str, FuzzyNode]
    visits: Mapping[str, Visits]
    others: Mapping[str, tuple[Prepared, Run, frozenset[str]]]

    @property
    def cost(self) -> float:
        """How long it takes, in samples."""
        return float(len(self.original.trace.ticks))


@dataclass(frozen=True, slots=True, kw_only=True)
class RuleBase:
    """A function block in a file, and the runs of a bench that use it."""

    file: Path
    function_block: FunctionBlock
    cases: tuple[Case, ...]

    @property
    def not_passing(self) -> int:
        """How many verdicts on its runs are not PASS as it is: they kill nothing."""
        return sum(not passes for each in self.cases for passes in _passes(each.original).values())

    @property
    def without_baseline(self) -> int:
        """How many of its runs have no baseline that they keep, to be killed by."""
        return sum(not _keeps_baseline(each.original) for each in self.cases)


@dataclass(frozen=True, slots=True, kw_only=True)
class Survey:
    """The fates of the mutants of a rule base; `refused` cannot be computed in the arithmetic of a run."""

    rule_base: RuleBase
    fates: tuple[Fate, ...]
    refused: tuple[Mutant, ...]

    def of(self, group: Group) -> tuple[Fate, ...]:
        """Return the fates of a group, in the order of the text."""
        return tuple(each for each in self.fates if each.group is group)


Advance = Callable[[int, int], None]
"""Is told how many mutants of how many have met their fate."""


def rule_bases(scenarios: Sequence[Scenario]) -> tuple[RuleBase, ...]:
    """Return the rule bases of a bench, each with all the runs that use it, run once as they are.

    InputFault carries the faults of all scenarios.
    """
    found: dict[tuple[Path, str], list[Case]] = {}
    blocks: dict[tuple[Path, str], FunctionBlock] = {}
    for scenario in scenarios:
        for key, block, case in _cases(scenario):
            found.setdefault(key, []).append(case)
            blocks.setdefault(key, block)
    return tuple(
        RuleBase(file=key[0], function_block=blocks[key], cases=tuple(cases)) for key, cases in found.items()
    )


def _cases(scenario: Scenario) -> Iterator[tuple[tuple[Path, str], FunctionBlock, Case]]:
    prepared = {each.variant: each for each in prepare(scenario)}
    runs = run_together(list(prepared.values()))
    used: dict[tuple[Path, str], dict[str, dict[str, FuzzyNode]]] = {}
    for variant, each in prepared.items():
        for node in _fuzzy(each.diagram):
            file = scenario.variants[variant].rule_bases[node.name]
            by_variant = used.setdefault((file, node.block.name), {})
            by_variant.setdefault(variant, {})[node.name] = node
    for key, by_variant in used.items():
        others = {
            variant: (prepared[variant], run, frozenset(by_variant.get(variant, ())))
            for variant, run in runs.items()
        }
        for variant, nodes in by_variant.items():
            case = Case(
                scenario=scenario.name,
                prepared=prepared[variant],
                original=runs[variant],
                nodes=nodes,
                visits={name: visits(node, runs[variant].trace.fuzzy[name]) for name, node in nodes.items()},
                others=others,
            )
            yield key, next(iter(nodes.values())).block.function_block, case


def _fuzzy(diagram: Diagram) -> list[FuzzyNode]:
    return [node for node in diagram.nodes if isinstance(node, FuzzyNode)]


def survey(
    rule_base: RuleBase,
    chosen: Callable[[Mutant], bool] | None = None,
    advance: Advance | None = None,
    workers: int | None = None,
) -> Survey:
    """Return what becomes of the mutants that are `chosen`, all by default, on `workers` threads.

    A mutant is run where its original was, until a requirement kills it. One
    that differs in no bit where the original's runs go is not run: it could do
    nothing else. Requirements that do not pass with the original kill nothing.
    """
    found = [each for each in mutants(rule_base.function_block) if chosen is None or chosen(each)]
    fates: dict[int, Fate | None] = {}
    with ThreadPoolExecutor(workers or cpu_count() or 1) as pool:
        try:
            cases = _fastest_first(rule_base.cases, found, pool)
            running = {pool.submit(_fate, each, cases): at for at, each in enumerate(found)}
            for done, future in enumerate(as_completed(running), 1):
                fates[running[future]] = future.result()
                if advance is not None:
                    advance(done, len(found))
        except BaseException:  # an interrupt as well must not wait for what has not begun
            pool.shutdown(wait=False, cancel_futures=True)
            raise
    return Survey(
        rule_base=rule_base,
        fates=tuple(fate for _, fate in sorted(fates.items()) if fate is not None),
        refused=tuple(each for at, each in enumerate(found) if fates[at] is None),
    )


def _fastest_first(
    cases: Sequence[Case], found: Sequence[Mutant], pool: ThreadPoolExecutor
) -> Sequence[Case]:
    """Return the cases so that those come first that kill most in the time they take.

    A few mutants go through all cases. The first case kills the most of them per sample,
    the next the most of those that the first leaves alive, and so on.
    """
    if len(cases) < 2 or len(found) < 4 * PILOTS:
        return cases
    pilots = found[:: len(found) // PILOTS]
    kills = list(pool.map(lambda each: {at for at, case in enumerate(cases) if _kills(case, each)}, pilots))
    waiting, order = list(range(len(cases))), list[int]()
    while waiting:
        best = max(waiting, key=lambda at: (sum(at in each for each in kills) / cases[at].cost, -at))
        waiting.remove(best)
        order.append(best)
        kills = [each for each in kills if best not in each]
    return [cases[at] for at in order]


def _kills(case: Case, mutant: Mutant) -> bool:
    block = _block(mutant, [case])
    return block is not None and _requirement(case, _judged(case, block)[1]) is not None


def _fate(mutant: Mutant, cases: Sequence[Case]) -> Fate | None:
    """Return what becomes of a mutant; None where a run's arithmetic cannot compute it."""
    block = _block(mutant, cases)
    if block is None:
        return None
    found = [
        difference(node, replace(node, block=block), case.visits[name])
        for case in cases
        for name, node in case.nodes.items()
    ]
    largest = max(found, key=lambda each: each.share)
    if all(each.same for each in found):
        return Fate(mutant=mutant, group=Group.SAME, killer=None, difference=largest)
    baseline = None
    for case in cases:
        trace, verdicts = _judged(case, block)
        killer = _requirement(case, verdicts)
        if killer is not None:
            return Fate(mutant=mutant, group=Group.REQUIREMENTS, killer=killer, difference=largest)
        baseline = baseline or _baseline(case, trace, verdicts)
    alive = Group.SAME if largest.share <= SAME else Group.DIFFERENT
    group = alive if baseline is None else Group.BASELINES
    return Fate(mutant=mutant, group=group, killer=baseline, difference=largest)


def _block(mutant: Mutant, cases: Sequence[Case]) -> Block | None:
    """Return a mutant as a block; None where the arithmetic of a run cannot compute it."""
    block = Block(mutant.function_block, assemble(mutant.function_block))
    try:
        for case in cases:
            for node in case.nodes.values():
                if node.in_int:
                    replace(node, block=block).integer_instance()
    except InputFault:
        return None
    return block


def _judged(case: Case, block: Block) -> tuple[Trace, tuple[Verdict, ...]]:
    """Run a case with another block in place of its rule base, and so the runs that it is relative to."""
    prepared = case.prepared
    trace = simulate(with_rule_bases(prepared.diagram, dict.fromkeys(case.nodes, block)))
    return trace, judge(trace, prepared.requirements, _Others(case, block))


class _Others(Mapping[str, Trace]):
    """The traces of a scenario's runs by variant with another block, each simulated when it is asked for."""

    def __init__(self, case: Case, block: Block) -> None:
        self._case, self._block = case, block

    def __getitem__(self, variant: str) -> Trace:
        prepared, original, names = self._case.others[variant]
        if not names:
            return original.trace
        return simulate(with_rule_bases(prepared.diagram, dict.fromkeys(names, self._block)))

    def __iter__(self) -> Iterator[str]:
        return iter(self._case.others)

    def __len__(self) -> int:
        return len(self._case.others)


def _passes(run: Run) -> dict[str, bool]:
    return {each.requirement.id: each.status is Status.PASS for each in run.verdicts}


def _requirement(case: Case, verdicts: Sequence[Verdict]) -> Killer | None:
    """Return the first requirement that no longer passes, an expected miss that is met among them."""
    passed = _passes(case.original)
    for each in verdicts:
        if passed[each.requirement.id] and each.status is not Status.PASS:
            return _killer(case, each.requirement.id, each.status)
    return None


def _baseline(case: Case, trace: Trace, verdicts: Sequence[Verdict]) -> Killer | None:
    """Return the baseline that a run leaves where the original keeps it."""
    if not _keeps_baseline(case.original):
        return None
    prepared = case.prepared
    status = compare(trace, verdicts, prepared.baseline, prepared.references or ()).status
    return None if status is Status.PASS else _killer(case, "baseline", status)


def _killer(case: Case, by: str, status: Status) -> Killer:
    return Killer(scenario=case.scenario, variant=case.original.variant, by=by, status=status)


def _keeps_baseline(run: Run) -> bool:
    return run.compared is not None and run.compared.status is Status.PASS
