"""`fcl-sim check`: what is wrong with rule bases, what is proved of them."""

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import click

from fcl_sim import __version__, fcl
from fcl_sim.block import Block
from fcl_sim.cli.doors import Exit, say
from fcl_sim.cli.outputs import root
from fcl_sim.cli.rule_bases import rule_bases
from fcl_sim.cli.universes import Key as UseKey
from fcl_sim.cli.universes import Use, uses_of
from fcl_sim.diagnostics import Diagnostic, InputFault, Severity
from fcl_sim.diagnostics.as_github import as_github
from fcl_sim.diagnostics.as_json import as_json
from fcl_sim.diagnostics.as_sarif import as_sarif
from fcl_sim.diagnostics.render import render, summary
from fcl_sim.diagnostics.spelling import listed
from fcl_sim.engine.assemble import assemble
from fcl_sim.fcl.conformance_excess import excesses
from fcl_sim.fcl.conformance_statement import Statement
from fcl_sim.fcl.conformance_targets import target
from fcl_sim.fcl.targets import NAMES
from fcl_sim.model import FunctionBlock
from fcl_sim.proof.completeness import EPSILON
from fcl_sim.proof.finding import Finding
from fcl_sim.proof.finding import as_json as evidence
from fcl_sim.proof.law import OutputLaw, law_of
from fcl_sim.proof.prove import prove
from fcl_sim.proof.slabs import Budget
from fcl_sim.proof.told_law import law_json, law_lines
from fcl_sim.proof.universe import Asked, Universe, UniverseError, without_end
from fcl_sim.proof.words import quoted
from fcl_sim.scenario.bench import bench_of
from fcl_sim.scenario.kinds import File, check_kind
from fcl_sim.verify.visited import Key, Visits, joined, visits_of
from fcl_sim.verify.waive import waive

FORMATS = ("text", "json", "sarif", "github")


@click.command()
@click.argument("paths", metavar="PATH...", nargs=-1, required=True, type=click.Path(path_type=Path))
@click.option(
    "--format", "form", type=click.Choice(FORMATS), default="text", help="How findings are printed."
)
@click.option("--json", "form", flag_value="json", help="Print one JSON document: --format json.")
@click.option(
    "--target",
    "targets",
    metavar="NAME|FILE.toml",
    multiple=True,
    help=f"Hold them against the statement of a PLC as well: {', '.join(NAMES)}, or a file.",
)
@click.option(
    "--universe",
    "stretches",
    metavar="NAME=LOW..HIGH",
    multiple=True,
    help="From where to where an input goes, with its unit if you like: 'distance=-10..30 m'.",
)
@click.option(
    "--assume",
    "couplings",
    metavar="SUM=NUMBER",
    multiple=True,
    help="What inputs have in common: 'brown + light + dark = 1'; also <= and >=.",
)
@click.option(
    "--scenario",
    "scenarios",
    metavar="SCENARIO.toml",
    multiple=True,
    type=click.Path(path_type=Path),
    help="Inputs go as far as this scenario declares, or its blocks let them.",
)
@click.option(
    "--with",
    "reports",
    metavar="REPORTS",
    multiple=True,
    type=click.Path(path_type=Path),
    help="Results of runs, a folder or a results.json: where they were undefined is an error.",
)
@click.option(
    "--law",
    "laws",
    is_flag=True,
    help="Tell the control law of each output: its ends, its slopes and their bounds, its course.",
)
@click.option(
    "--epsilon",
    type=click.FloatRange(0.0, 0.5),
    default=EPSILON,
    show_default=True,
    help="From which part of the strongest term's degree on a term counts as cover; 0: all do.",
)
@click.option(
    "--budget",
    type=click.IntRange(1),
    default=Budget().cells,
    show_default=True,
    metavar="CELLS",
    help="How many cells of the input space are looked at; the largest first.",
)
def command(  # noqa: PLR0913  an option each
    *,
    paths: tuple[Path, ...],
    form: str,
    targets: tuple[str, ...],
    stretches: tuple[str, ...],
    couplings: tuple[str, ...],
    scenarios: tuple[Path, ...],
    reports: tuple[Path, ...],
    laws: bool,
    epsilon: float,
    budget: int,
) -> Exit:
    """Read rule bases, and prove what their rules say together.

    PATH is a file, a folder to search for *.fcl, or a pattern.

    Every finding is listed with its place and a hint: characters, grammar, names, what cannot be
    evaluated; and, without running them, where an output is undefined, which rules never fire,
    contradict each other or have no effect, which terms nobody needs.
    `fcl-sim explain CODE` tells more about a finding.
    """
    asked = Asked(stretches, couplings)
    for report in reports:
        if report.is_file():
            check_kind(report, File.RESULTS, "VER205")
    proof = _Proof(asked, uses_of(scenarios), epsilon, Budget(budget), visits_of(reports), laws=laws)
    statements = [target(each) for each in targets]
    files, faults = rule_bases(paths)
    findings = [*faults]
    for file in files:
        findings += _findings(file, statements, proof)
    try:
        proof.all_used()
    except UniverseError as error:
        raise click.UsageError(str(error)) from None
    match form:
        case "json":
            document = as_json(findings, [str(each) for each in files])
            for told, each in zip(document["findings"], findings, strict=True):
                if id(each) in proof.evidence:
                    told["proof"] = evidence(proof.evidence[id(each)])
            if laws:
                document["laws"] = [each.document() for each in proof.laws]
            click.echo(_document(document))
        case "sarif":
            click.echo(_document(as_sarif(findings, __version__, root())))
        case _:
            for each in findings:
                click.echo(as_github(each, root()) if form == "github" else render(each))
            for own in proof.laws:
                click.echo("\n".join(own.lines()))
            click.echo(_summary(files, findings))
    return Exit.INPUT if any(each.is_error for each in findings) else Exit.GREEN


@dataclass(frozen=True, slots=True)
class _Laws:
    """The laws of a block of a file."""

    file: Path
    name: str
    universe: Universe
    laws: tuple[OutputLaw, ...]

    def lines(self) -> list[str]:
        """Return them in words."""
        told = [line for each in self.laws for line in law_lines(each, self.universe)]
        return [f"{self.file}: the law of {self.name}", *told]

    def document(self) -> dict[str, object]:
        """Return them as JSON's types."""
        laws = [law_json(each) for each in self.laws]
        return {"file": str(self.file), "function_block": self.name, "outputs": laws}


class _Proof:
    """How rule bases are proved, and the evidence of what was found, by the identity of its diagnostic."""

    def __init__(
        self,
        asked: Asked,
        uses: Mapping[UseKey, Use],
        epsilon: float,
        budget: Budget,
        visits: Mapping[Key, Visits],
        *,
        laws: bool,
    ) -> None:
        self._asked, self._epsilon, self._budget, self._visits = asked, epsilon, budget, visits
        self._uses = dict(uses)
        self._unused = set(uses)
        self._with_laws = laws
        self.evidence: dict[int, Finding] = {}
        self.laws: list[_Laws] = []

    def all_used(self) -> None:
        """Raise UniverseError for what was asked of inputs or rule bases that none of the files has."""
        self._asked.all_used()
        if self._uses and self._unused == set(self._uses):
            files = listed(sorted({file.name for file, _ in self._uses}))
            raise UniverseError(f"the scenarios use none of these rule bases: they use {files}")

    def _universe(self, block: FunctionBlock, file: Path) -> Universe:
        key = (file.resolve(), block.name.casefold())
        use = self._uses.get(key, Use())
        self._unused.discard(key)
        try:
            universe = self._asked.universe_of(block, use.stretches, use.units)
        except UniverseError as error:
            raise click.UsageError(str(error)) from None
        free = [each for each in without_end(block, universe) if each.casefold() in use.ends]
        if free:
            names = f"{quoted(free)} of {block.name} {'go' if len(free) > 1 else 'goes'} anywhere"
            say(f"{names} in its scenarios: bound them there by `ranges`, or here by --universe")
        return universe

    def of(self, blocks: Sequence[FunctionBlock], file: Path) -> list[Diagnostic]:
        """Return what is to be said of the blocks of a file, and of the waivers of it."""
        findings: list[Finding] = []
        for block in blocks:
            universe = self._universe(block, file)
            proved = prove(block, universe, self._epsilon, self._budget)
            findings += [joined(each, file, block.name, self._visits) for each in proved]
            if self._with_laws:
                laws = law_of(Block(block, assemble(block)), universe)
                self.laws.append(_Laws(file, block.name, universe, laws))
        sources = [each.span.source for each in blocks if each.span is not None]
        if not sources:
            return []
        try:
            left = waive(findings, sources[0], file, bench_of(file))
        except InputFault as fault:
            return [*(each.diagnostic for each in findings), *fault.diagnostics]
        self.evidence |= {id(each.diagnostic): each for each in left.findings}
        return [*(each.diagnostic for each in left.findings), *left.faults]


def _findings(file: Path, statements: Sequence[Statement], proof: _Proof) -> list[Diagnostic]:
    """Return everything that is to be said about a file, whether it can be read or not."""
    try:
        reading = fcl.read_file(file)
    except InputFault as fault:
        return list(fault.diagnostics)
    findings = list(reading.diagnostics)
    sound = []
    for block in reading.blocks:
        try:
            assemble(block)
        except InputFault as fault:
            findings += fault.diagnostics
        else:
            sound.append(block)
        for statement in statements:
            findings += excesses(block, statement)
    findings += proof.of(sound, file)
    return [each.within(str(file)) for each in findings]


def _summary(files: Sequence[Path], findings: Sequence[Diagnostic]) -> str:
    """Return one line on all files, and where to read more of the gravest finding."""
    subject = str(files[0]) if len(files) == 1 else f"{len(files)} files"
    line = f"{subject}: {summary(findings)}"
    if not findings:
        return line
    gravest = min(findings, key=lambda each: list(Severity).index(each.severity))
    return f"{line} (fcl-sim explain {gravest.code} tells more)"


def _document(content: object) -> str:
    return json.dumps(content, indent=2, ensure_ascii=False)
