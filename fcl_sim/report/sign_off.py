"""What is signed: inputs with their hashes, what they were computed with, assumptions, waivers."""

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from itertools import groupby
from typing import Any

from fcl_sim.diagnostics.page import page
from fcl_sim.model import FunctionBlock
from fcl_sim.plant.catalog import PlantModel
from fcl_sim.plant.declaration import Parameter
from fcl_sim.report.archive import Stored
from fcl_sim.report.constants import ASSUMED
from fcl_sim.report.proved import Proved
from fcl_sim.report.provenance import InputFile, Origin, fuzzy_nodes, inputs_of
from fcl_sim.report.results import versions
from fcl_sim.report.setting import accuracy, milliseconds
from fcl_sim.report.story import Story
from fcl_sim.report.words import counted, exactly, joined, one_line
from fcl_sim.scenario.revision import Revision
from fcl_sim.testbench import Outcome, Run
from fcl_sim.verify.coverage import Coverage
from fcl_sim.verify.waivers import Waiver

Data = dict[str, Any]

FORMATS = {
    "LREAL": "LREAL, IEC 60559 binary64",
    "REAL": "REAL, IEC 60559 binary32",
    "INT": "INT, 16 bits, degrees 0 to 10000",
}
"""Arithmetics of fuzzy blocks, in words."""

SIGNERS = ("Author", "Checker", "Approver")

MOST_FILES = 6
"""Changed files that are named; of more their number is told."""

MOST_VALUES = 4
"""Other values of an assumption that are listed; of more the least and the largest are told."""


def fact(label: str, *values: str, mono: bool = False) -> Data:
    """Return a row of a table of facts."""
    return {"label": label, "values": [one_line(each) for each in values], "mono": mono}


def sign_off(stored: Stored) -> Data:
    """Return what the page says that is signed."""
    runs = [run for outcome in stored.outcomes for run in outcome.variants.values()]
    return {
        "files": files(stored.outcomes, stored.stories),
        "facts": [*revisions(stored.origin), *computed(runs)],
        "assumptions": [*assumptions(runs)],
        "open": [*open_findings(stored.proofs)],
        "waivers": [*waivers(stored.covered, stored.proofs)],
        "signers": list(SIGNERS),
    }


def files(outcomes: Iterable[Outcome], stories: Iterable[Story] = ()) -> list[Data]:
    """Return every input once, by its role, with its SHA-256; the texts that are told last."""
    inputs = [each for outcome in outcomes for each in inputs_of(outcome)]
    inputs += [
        InputFile(role="text", name=each.name, path=each.folder, digest=each.digest) for each in stories
    ]
    found = {(each.role, each.name, each.digest): each for each in inputs}
    roles = list(dict.fromkeys(each.role for each in found.values()))
    ordered = sorted(found.values(), key=lambda each: roles.index(each.role))
    return [
        {"role": role.capitalize(), "name": one_line(each.name), "digest": each.digest}
        for role, group in groupby(ordered, key=lambda each: each.role)
        for each in group
    ]


def revisions(origin: Origin) -> list[Data]:
    """Return where each bench stands in git."""
    several = len(origin.revisions) > 1
    return [
        fact(f"Git revision of {each.bench}" if several else "Git revision", *_revision(each))
        for each in origin.revisions
    ]


def _revision(revision: Revision) -> Iterator[str]:
    if not revision.commit:
        yield "none: the bench is not under version control"
        return
    yield revision.commit
    if revision.is_clean:
        yield "The working tree was clean: every file is as it is in that revision."
        return
    named = [*revision.changed[:MOST_FILES]]
    more = len(revision.changed) - len(named)
    told = joined([*named, f"{more} more"] if more else named)
    count = counted(len(revision.changed), "file is", "files are")
    yield f"The working tree was not clean: {count} not as in that revision: {told}."


def computed(runs: Sequence[Run]) -> Iterator[Data]:
    """Yield what the runs were computed with: scans, seeds, arithmetics, integration, versions."""
    timings = [run.diagram.timing for run in runs]
    if timings:
        yield fact("Scan", joined([milliseconds(each) for each in sorted({each.scan for each in timings})]))
    seeds = [joined([str(each) for each in sorted({each.seed for each in timings})])] if timings else []
    varied = sorted({int(each) for run in runs for each in _varied(run, "timing.seed")})
    if varied:
        seeds.append(f"in envelopes {joined([str(each) for each in varied])}")
    if seeds:
        yield fact("Seeds of noise and jitter", "; ".join(seeds))
    blocks = [node for run in runs for node in fuzzy_nodes(run)]
    if blocks:
        yield fact(
            "Arithmetic", *_arithmetics([(each.arithmetic, each.block.function_block) for each in blocks])
        )
    if runs:
        yield fact("Integration", *_integrations(runs))
    yield fact("Versions", ", ".join(f"{name} {each}" for name, each in versions().items()))


def _arithmetics(blocks: Iterable[tuple[str, FunctionBlock]]) -> list[str]:
    """Return what the fuzzy blocks computed in, each arithmetic with its blocks where there are several."""
    users: dict[str, dict[str, None]] = {}
    for arithmetic, block in blocks:
        users.setdefault(arithmetic, {})[block.name] = None
    if len(users) < 2:
        return [FORMATS[each] for each in users]
    return [f"{FORMATS[each]}: {joined(list(users[each]))}" for each in FORMATS if each in users]


def _integrations(runs: Iterable[Run]) -> list[str]:
    found = dict.fromkeys(
        "exact, of linear plants" if run.diagram.exact else accuracy(run.diagram.integration) for run in runs
    )
    return list(found)


def assumptions(runs: Sequence[Run]) -> Iterator[Data]:
    """Yield every parameter of a plant whose value is assumed, and with which others it was run.

    Axes of envelopes count as well: they tell how much hangs on it.
    """
    models: dict[str, tuple[PlantModel, list[Run]]] = {}
    for run in runs:
        model = run.diagram.plant.model
        models.setdefault(model.digest, (model, []))[1].append(run)
    for model, own in models.values():
        for each in model.declaration.parameters:
            if each.source.startswith(ASSUMED):
                yield _assumption(model, each, own)


def _assumption(model: PlantModel, parameter: Parameter, runs: Sequence[Run]) -> Data:
    given = {run.diagram.plant.parameters.get(parameter.name, parameter.default) for run in runs}
    others = sorted(given - {parameter.default})
    told = [exactly(each, parameter.unit) for each in others]
    if len(told) > MOST_VALUES:
        told = [f"{counted(len(told), 'value')} from {exactly(others[0], '')} to {told[-1]}"]
    used = "" if parameter.default in given else " (in no run)"
    return {
        "plant": one_line(model.declaration.name),
        "name": one_line(parameter.name),
        "value": exactly(parameter.default, parameter.unit) + used,
        "meaning": one_line(parameter.meaning),
        "reason": one_line(parameter.source.removeprefix(ASSUMED)),
        "others": joined([*told, *_axes(parameter, runs)]),
    }


def _axes(parameter: Parameter, runs: Sequence[Run]) -> list[str]:
    """Return what envelopes make of a parameter, each range once."""
    found: dict[str, None] = {}
    for run in runs:
        values = _varied(run, f".parameters.{parameter.name}")
        ends = [one_line(str(each)) for each in (*values[:1], *values[-1:])]
        if ends:
            found[f"{' to '.join(dict.fromkeys(ends))} in envelopes"] = None
    return list(found)


def _varied(run: Run, ending: str) -> list[Any]:
    """Return the values that the envelope of a run gives to what ends so, as the scenario writes them."""
    axes = run.envelope.grid.axes if run.envelope is not None else ()
    return [each.plain() for axis in axes if axis.key.endswith(ending) for each in axis.values]


def open_findings(proofs: Sequence[Proved]) -> Iterator[Data]:
    """Yield what the check finds in the rule bases and nobody has waived: code, what it means, how often."""
    for each in proofs:
        for code, count in Counter(found.code for found in each.findings).items():
            title = page(code).title
            yield {
                "rule_base": f"{one_line(each.name)} in {one_line(each.file)}",
                "code": code,
                "what": f"{title[:1].upper()}{title[1:]}{f', {count} times' if count > 1 else ''}",
            }


def waivers(covered: Sequence[Coverage], proofs: Sequence[Proved]) -> Iterator[Data]:
    """Yield what need not be as it should, each with its reason and its day."""
    owners = [(each.name, each.file, each.waivers) for each in covered]
    owners += [(each.name, each.file, each.waivers) for each in proofs]
    for name, file, own in owners:
        for waiver in own:
            yield _waiver(name, file, waiver)


def _waiver(name: str, file: str, waiver: Waiver) -> Data:
    what = f"{waiver.what} of {waiver.rule}" if waiver.rule else waiver.what
    return {
        "rule_base": f"{one_line(name)} in {one_line(file)}",
        "what": one_line(what),
        "reason": one_line(waiver.reason),
        "date": waiver.date.isoformat(),
    }
