"""What became of mutants, as words and as data."""

from collections.abc import Iterator, Sequence
from math import isfinite

from fcl_sim.mutation import Fate, Group, RuleBase, Survey
from fcl_sim.report.results import SCHEMA, Json, printed, versions
from fcl_sim.report.words import counted, number, one_line
from fcl_sim.scenario.document import shown
from fcl_sim.verify.mutants import Kind, Mutant


def counts(survey: Survey) -> Iterator[tuple[str, int, dict[Group, int]]]:
    """Yield each kind of mutant that there is: its name, how many, and how many of each group; then all."""
    for kind in Kind:
        fates = [each for each in survey.fates if each.mutant.kind is kind]
        if fates:
            yield str(kind), len(fates), _by_group(fates)
    yield "all", len(survey.fates), _by_group(survey.fates)


def _by_group(fates: Sequence[Fate]) -> dict[Group, int]:
    return {group: sum(each.group is group for each in fates) for group in Group}


def line(fate: Fate, rule_base: RuleBase) -> str:
    """Return a mutant on one line: its place in the text, what it changes, what killed it, where it shows."""
    parts = [f"{place(fate.mutant, rule_base)}: {one_line(str(fate.mutant))}"]
    if fate.killer is not None:
        run = f"{fate.killer.scenario} {fate.killer.variant}"
        parts.append(f"{one_line(run)}: {one_line(fate.killer.by)} {fate.killer.status}")
    elif fate.group is Group.DIFFERENT:
        parts.append(where(fate))
    return "; ".join(parts)


def where(fate: Fate) -> str:
    """Return where a mutant differs most, by how much, and the inputs as `fcl-sim eval` takes them."""
    found = fate.difference
    moved = f"{found.output} {number(found.before)} → {number(found.after)}"
    share = f" ({number(100 * found.share, 2)} % of its range)" if isfinite(found.share) else ""
    inputs = " ".join(f"{name}={value!r}" for name, value in found.inputs.items())
    return f"{moved}{share} at {inputs}"


def place(mutant: Mutant, rule_base: RuleBase) -> str:
    """Return the file of a mutant, as short as it can be said, and the line of what it changes."""
    file = shown(rule_base.file)
    return file if mutant.span is None else f"{file}:{mutant.span.line}"


def remarks(rule_base: RuleBase, refused: Sequence[Mutant]) -> Iterator[str]:
    """Yield what takes from the force of a survey."""
    name, red, bare = shown(rule_base.file), rule_base.not_passing, rule_base.without_baseline
    if red:
        verbs = ("is", "kills") if red == 1 else ("are", "kill")
        yield (
            f"{name}: {counted(red, 'verdict')} of its runs {verbs[0]} not PASS with the rule base as it is, "
            f"and {verbs[1]} nothing"
        )
    if bare:
        runs = f"{counted(bare, 'run')} of {len(rule_base.cases)}"
        which = "which has none or leaves it" if bare == 1 else "which have none or leave theirs"
        yield f"{name}: no baseline can kill in {runs}, {which} anyway"
    if refused:
        yield f"{name}: left out, as INT cannot compute them: {counted(len(refused), 'mutant')}"


def sentence(surveys: Sequence[Survey]) -> str:
    """Return how many mutants there were and what became of them."""
    fates = [fate for survey in surveys for fate in survey.fates]
    groups = _by_group(fates)
    bases = counted(len(surveys), "rule base")
    return (
        f"{counted(len(fates), 'mutant')} of {bases}: "
        f"{groups[Group.REQUIREMENTS]} killed by requirements, {groups[Group.BASELINES]} by baselines, "
        f"{groups[Group.SAME]} alive with the same law where the runs go, "
        f"{groups[Group.DIFFERENT]} alive and different."
    )


def text(surveys: Sequence[Survey]) -> str:
    """Return the document of some surveys as JSON."""
    made = {
        "schema": SCHEMA,
        "tool": "fcl_sim",
        "versions": versions(),
        "rule_bases": [_survey(each) for each in surveys],
    }
    return printed(made)


def _survey(survey: Survey) -> Json:
    base = survey.rule_base
    return {
        "file": shown(base.file),
        "function_block": base.function_block.name,
        "runs": [{"scenario": each.scenario, "variant": each.original.variant} for each in base.cases],
        "verdicts_not_pass": base.not_passing,
        "runs_without_baseline": base.without_baseline,
        "kinds": [
            {"kind": kind, "mutants": count, **{group.name.lower(): groups[group] for group in Group}}
            for kind, count, groups in counts(survey)
        ],
        "mutants": [_fate(each) for each in survey.fates],
        "refused": [_mutant(each) for each in survey.refused],
    }


def _mutant(mutant: Mutant) -> Json:
    return {
        "kind": str(mutant.kind),
        "rule": mutant.rule or None,
        "where": mutant.where,
        "what": mutant.what,
        "line": None if mutant.span is None else mutant.span.line,
        "column": None if mutant.span is None else mutant.span.column,
    }


def _fate(fate: Fate) -> Json:
    killer, found = fate.killer, fate.difference
    killed_by = None
    if killer is not None:
        killed_by = {
            "scenario": killer.scenario,
            "variant": killer.variant,
            "by": killer.by,
            "verdict": str(killer.status),
        }
    difference = {
        "inputs": dict(found.inputs),
        "output": found.output,
        "before": _finite(found.before),
        "after": _finite(found.after),
        "share_of_range": _finite(found.share),
    }
    return _mutant(fate.mutant) | {
        "group": fate.group.name.lower(),
        "killed_by": killed_by,
        "largest_difference": difference if found.share > 0.0 else None,
    }


def _finite(value: float) -> float | None:
    return value if isfinite(value) else None
