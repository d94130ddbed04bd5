"""The JSON Schema of a run over its envelope."""

from fcl_sim.judge.verdict import Over
from fcl_sim.report.schema_parts import (
    Schema,
    figure,
    list_of,
    or_null,
    reference,
    status,
    table,
    text,
    whole,
)


def definitions(asked: Schema) -> Schema:
    """Return the definitions by name; `asked` are the keys that tell what a requirement asks."""
    return {"envelope": _envelope(), "axis": _axis(), "envelope_verdict": _verdict(asked)}


def _envelope() -> Schema:
    return table(
        "A run at every point of a grid; the last axis varies fastest",
        verdict=status("the gravest of its requirements"),
        axes=list_of("the axes of the grid", "axis"),
        points=whole("number of points"),
        requirements=list_of("the verdicts over all points", "envelope_verdict"),
    )


def _axis() -> Schema:
    return table(
        "An axis of an envelope",
        key=text("the dotted key that it sets"),
        values={"type": "array", "description": "what it is set to, as written"},
    )


def _verdict(asked: Schema) -> Schema:
    worst = table(
        "the worst point, where a figure tells",
        point=whole("its number in the grid, from 0"),
        at={"type": "object", "description": "what it sets, by dotted key"},
    )
    return table(
        "A requirement, judged over the points of an envelope",
        **asked,
        over={"enum": [str(each) for each in Over], "description": "what it is held to"},
        verdict=status("after the expectation"),
        measured=status("before the expectation"),
        passed=whole("points at which it came out as it should; of a mean, those with a figure"),
        needed=whole("points at which it must"),
        value=figure("the figure at the worst point, or the mean, in `unit`"),
        worst=or_null(worst),
        definition=text("what the figure is, in words, or the formula"),
        reason=text("one sentence for a reader"),
        values={"type": "array", "items": figure(""), "description": "the figure at each point, in `unit`"},
        verdicts={"type": "array", "items": reference("status"), "description": "the verdict at each point"},
    )
