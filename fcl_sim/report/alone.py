"""The report of a rule base alone: its terms, rules, characteristic and findings, without any run."""

import hashlib
from collections.abc import Sequence
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from fcl_sim import __version__
from fcl_sim.block import Block, load_all
from fcl_sim.diagnostics import Severity
from fcl_sim.diagnostics.as_json import as_json
from fcl_sim.fcl.files import open_source
from fcl_sim.loop.diagram import FuzzyNode
from fcl_sim.report.placed import Register
from fcl_sim.report.proved import Proved, proved
from fcl_sim.report.provenance import EPOCH, InputFile, Origin, date_asked, shown
from fcl_sim.report.results import printed, versions
from fcl_sim.report.rule_bases import Base, rule_base_data
from fcl_sim.report.sign_off import SIGNERS, fact, open_findings, revisions, waivers
from fcl_sim.report.words import counted, joined, one_line
from fcl_sim.scenario.bench import bench_of
from fcl_sim.scenario.revision import revision_of

Data = dict[str, Any]

KIND = "Rule base report"
CLEAN = "NO FINDINGS"


def of_file(path: Path) -> tuple[tuple[Block, ...], InputFile, Origin]:
    """Return the blocks of an FCL file, the file, and where it comes from; InputFault where it has errors."""
    blocks = tuple(load_all(path).values())
    digest = hashlib.sha256(path.read_bytes()).hexdigest()
    file = InputFile(
        role="rule base", name=shown(path), path=path, digest=digest, text=open_source(path).text
    )
    changed = datetime.fromtimestamp(int(path.stat().st_mtime), UTC) if path.is_file() else EPOCH
    date = date_asked() or changed
    return blocks, file, Origin(date=date, revisions=(revision_of(bench_of(path)),))


def report_data(blocks: Sequence[Block], file: InputFile, origin: Origin, register: Register) -> Data:
    """Return the report's data as `content.report_data` does for runs."""
    proofs = [proved(each, file) for each in blocks]
    names = joined([one_line(each.name) for each in blocks])
    told = _sentence(blocks, proofs)
    return {
        "title": f"Rule base{'s' if len(blocks) > 1 else ''} {names}",
        "kind": KIND,
        "version": __version__,
        "description": told,
        "keywords": ["fuzzy control", "FCL", "IEC 61131-7"],
        "status": _status(proofs),
        "sentence": told,
        "footer": f"fcl_sim {__version__}",
        "overview": [],
        "signed": {
            "files": [{"role": "Rule base", "name": one_line(file.name), "digest": file.digest}],
            "facts": [*revisions(origin), fact("Versions", _versions())],
            "assumptions": None,
            "open": [*open_findings(proofs)],
            "waivers": [*waivers((), proofs)],
            "signers": list(SIGNERS),
        },
        "matrix": None,
        "scenarios": [],
        "depth": 2,
        "rule_bases": rule_base_data([_base(each, file) for each in blocks], register, (), proofs),
    }


def findings_text(blocks: Sequence[Block], file: InputFile) -> str:
    """Return what is found in the blocks as JSON, which the PDF carries."""
    found = [finding for each in blocks for finding in proved(each, file).findings]
    return printed(as_json(found, [file.name]))


def _base(block: Block, file: InputFile) -> Base:
    return Base(file=file, node=FuzzyNode(name=block.name, block=block, inputs={}), records={})


def _versions() -> str:
    return ", ".join(f"{name} {each}" for name, each in versions().items())


def _status(proofs: Sequence[Proved]) -> str:
    """Return the gravest kind of finding with its number."""
    kinds = [each.severity for own in proofs for each in own.findings]
    for severity in Severity:
        if severity in kinds:
            return counted(kinds.count(severity), str(severity)).upper()
    return CLEAN


def _sentence(blocks: Sequence[Block], proofs: Sequence[Proved]) -> str:
    """Return how large the blocks are and how much was found in them."""
    rules = sum(len(part.rules) for each in blocks for part in each.function_block.rule_blocks)
    inputs, outputs = (sum(len(each) for each in sizes) for sizes in zip(*map(_ends, blocks), strict=True))
    kinds = [each.severity for own in proofs for each in own.findings]
    found = [counted(kinds.count(each), str(each)) for each in Severity if each in kinds]
    size = ", ".join([counted(rules, "rule"), counted(inputs, "input"), counted(outputs, "output")])
    return f"{size}: {joined(found) or 'nothing was found'}."


def _ends(block: Block) -> tuple[tuple[str, ...], tuple[str, ...]]:
    return block.inputs, block.outputs
