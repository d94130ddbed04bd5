"""Findings of a proof that are waived: by a file of waivers, or by a comment in the rule base.

A comment names the code, perhaps the term, rule or variable that the finding is
about, the day and the reason:

    (* waive FCL608 of too_far, 2026-03-01: drawn for the long jib that comes next year *)
"""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from datetime import date
from pathlib import Path

from fcl_sim.diagnostics import Diagnostic, Source, Span
from fcl_sim.fcl.scanner import scan
from fcl_sim.proof.finding import Finding
from fcl_sim.toml import finding as told
from fcl_sim.verify.coverage import Item
from fcl_sim.verify.waivers import Waiver, unused, waivers_of

PROVED = "FCL6"
"""How the codes of what can be waived begin."""

COMMENT = re.compile(r"\bwaive\s+(?P<code>FCL6\d\d)\b(?:\s+of\s+(?P<name>[\w.]+))?(?P<rest>.*)", re.DOTALL)
REST = re.compile(r"\s*,?\s*(?P<date>\d{4}-\d{2}-\d{2})\s*:\s*(?P<reason>\w.*)", re.DOTALL)
FORM = "write (* waive FCL608 of NAME, 2026-03-01: the reason *)"


@dataclass(frozen=True, slots=True)
class Left:
    """The findings that are left, what is wrong with waivers, and the waivers of those that are gone."""

    findings: tuple[Finding, ...]
    faults: tuple[Diagnostic, ...]
    waivers: tuple[Waiver, ...] = ()


def waive(findings: Sequence[Finding], source: Source, file: Path, bench: Path) -> Left:
    """Return the findings on a file that no waiver covers; a waiver that covers none is a finding itself.

    `source` is the text of the file. Raises InputFault for files of waivers that cannot be read.
    """
    own, faults = _of_comments(source, file)
    own += [each for each in waivers_of(file, bench, [*Item]) if each.what.startswith(PROVED)]
    used: set[int] = set()
    left = []
    for each in findings:
        covering = [place for place, waiver in enumerate(own) if _covers(waiver, each)]
        used.update(covering)
        if not covering:
            left.append(each)
    idle = [waiver for place, waiver in enumerate(own) if place not in used]
    faults += [unused(each, f"there is no {each.what}{_of(each)}") for each in idle]
    return Left(tuple(left), tuple(faults), tuple(own[place] for place in sorted(used)))


def _of(waiver: Waiver) -> str:
    return f" of {waiver.rule}" if waiver.rule else ""


def _covers(waiver: Waiver, finding: Finding) -> bool:
    if waiver.what != finding.diagnostic.code:
        return False
    names = {finding.rule.casefold(), finding.variable.casefold(), *_marked(finding)}
    return not waiver.rule or waiver.rule.casefold() in names


def _marked(finding: Finding) -> Iterator[str]:
    """Yield what the finding points at, where that is a name; of several nothing, for a waiver waives all."""
    spans = [each.span for each in finding.diagnostic.places if each.span is not None]
    if len(spans) == 1:
        yield spans[0].source.text[spans[0].start : spans[0].end].casefold()


def _of_comments(source: Source, file: Path) -> tuple[list[Waiver], list[Diagnostic]]:
    """Return the waivers in the comments of a text, and what is wrong with those that say too little."""
    waivers, faults = [], []
    for comment in scan(source).comments:
        found = COMMENT.search(comment.text)
        if found is None:
            continue
        start = comment.start + found.start()
        span = Span(source, start, start + len(found.group(0)[: found.start("rest") - found.start()]))
        waiver = _waiver(found, span, file)
        if waiver is None:
            message = "a waiver says by which day and for what reason"
            faults.append(told("VER103", message, span, FORM))
        else:
            waivers.append(waiver)
    return waivers, faults


def _waiver(found: re.Match[str], span: Span, file: Path) -> Waiver | None:
    rest = REST.match(found["rest"])
    if rest is None:
        return None
    try:
        day = date.fromisoformat(rest["date"])
    except ValueError:
        return None
    reason = " ".join(rest["reason"].removesuffix("*)").removesuffix("*/").split())
    return Waiver(
        rule_base=file, what=found["code"], rule=found["name"] or "", reason=reason, date=day, span=span
    )
