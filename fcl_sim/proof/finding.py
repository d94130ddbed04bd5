"""A finding of a proof: a diagnostic, and what proves it."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

from fcl_sim.diagnostics import Diagnostic, Place, Severity, Span
from fcl_sim.proof.completeness import Box, Certainty
from fcl_sim.proof.points import Point
from fcl_sim.proof.space import Side

Json = dict[str, Any]


@dataclass(frozen=True, slots=True, kw_only=True)
class Finding:
    """What was found, with the evidence.

    `rule` is the label of the rule that it is about, or empty, `beside` that of the
    one which it stands beside. At `witness`, an evaluation shows it; what is nowhere
    has none. `share` is the part of the universe it takes, None where
    that has no measure; `boxes` say where.
    """

    diagnostic: Diagnostic
    certainty: Certainty = Certainty.EXACT
    variable: str = ""
    rule: str = ""
    beside: str = ""
    witness: Point | None = None
    share: Fraction | None = None
    boxes: tuple[Box, ...] = field(default=())
    more: bool = False


def found(
    code: str,
    message: str,
    spans: Sequence[Span | None],
    hint: str = "",
    severity: Severity = Severity.WARNING,
    others: Sequence[tuple[Span | None, str]] = (),
    **evidence: Any,
) -> Finding:
    """Return a finding at `spans`; `others` are what they clash with, each with a label."""
    places = [Place(each) for each in spans if each is not None]
    places += [Place(span, label) for span, label in others if span is not None]
    diagnostic = Diagnostic(code=code, message=message, severity=severity, places=tuple(places), hint=hint)
    return Finding(diagnostic=diagnostic, **evidence)


def as_json(finding: Finding) -> Json:
    """Return the evidence as JSON's types: shares as numbers and as exact fractions, intervals by input."""
    told: Json = {"certainty": str(finding.certainty)}
    if finding.variable:
        told["variable"] = finding.variable
    if finding.rule:
        told["rule"] = finding.rule
    if finding.beside:
        told["beside"] = finding.beside
    if finding.witness is not None:
        told["witness"] = {name: float(value) for name, value in finding.witness.items()}
        told["witness_exact"] = {name: str(value) for name, value in finding.witness.items()}
    if finding.share is not None:
        told |= {"share": float(finding.share), "share_exact": str(finding.share)}
    if finding.boxes:
        told["boxes"] = boxes_json(finding.boxes)
        told["more_boxes"] = finding.more
    return told


def boxes_json(boxes: Sequence[Box]) -> list[Json]:
    """Return boxes as JSON's types: for each, intervals by input."""
    return [{name: _side(side) for name, side in each.sides.items()} for each in boxes]


def _side(side: Side) -> Mapping[str, float | bool | None]:
    return {
        "low": None if side.low is None else float(side.low),
        "high": None if side.high is None else float(side.high),
        "low_closed": side.low_closed,
        "high_closed": side.high_closed,
    }
