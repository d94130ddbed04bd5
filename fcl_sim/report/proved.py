"""What `fcl-sim check` says of the rule bases of a run: findings, and what is waived."""

from dataclasses import dataclass, replace

from fcl_sim.block import Block
from fcl_sim.diagnostics import Diagnostic
from fcl_sim.proof.prove import prove
from fcl_sim.report.provenance import InputFile
from fcl_sim.scenario.bench import bench_of
from fcl_sim.verify.waive import waive
from fcl_sim.verify.waivers import Waiver


@dataclass(frozen=True, slots=True, kw_only=True)
class Proved:
    """A rule base, read and proved: its name and that of its file, what was found, and which waivers hold."""

    name: str
    file: str
    findings: tuple[Diagnostic, ...]
    waivers: tuple[Waiver, ...] = ()


def proved(block: Block, file: InputFile) -> Proved:
    """Return what is to be said of a rule base, over the ranges of its own text.

    InputFault with every fault of the files of waivers.
    """
    model = block.function_block
    found = prove(model)
    findings = [each.diagnostic for each in found]
    waivers: tuple[Waiver, ...] = ()
    if model.span is not None:
        left = waive(found, model.span.source, file.path, bench_of(file.path))
        findings = [*(each.diagnostic for each in left.findings), *left.faults]
        waivers = left.waivers
    told = tuple(_with_name(each, file) for each in (*block.diagnostics, *findings))
    return Proved(name=model.name, file=file.name, findings=told, waivers=waivers)


def _with_name(found: Diagnostic, file: InputFile) -> Diagnostic:
    """Return a finding that calls the file as a reader does: its hint may tell a command with its path."""
    path = str(file.path)
    message, hint = (each.replace(path, file.name) for each in (found.message, found.hint))
    return replace(found, message=message, hint=hint)
