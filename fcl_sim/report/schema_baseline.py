"""The JSON Schema of a run beside its baseline."""

from fcl_sim.report.schema_parts import Schema, figure, list_of, or_null, referring, status, table, text


def definitions() -> Schema:
    """Return the definitions by name; `baseline` is the whole."""
    return {
        "baseline": _baseline(),
        "metric_change": _metric(),
        "signal_change": _signal(),
        "cause": _cause(),
        "edit": _edit(),
        "divergence": _divergence(),
        "rule_change": _rule(),
    }


def _baseline() -> Schema:
    return table(
        "A run beside what it came to when it was last accepted",
        verdict=status("PASS, FAIL or NO BASELINE"),
        file=or_null(text("file of the baseline, where there is one")),
        date=or_null(text("day on which it was accepted, as 2026-01-31")),
        reason=or_null(text("why it was accepted")),
        metrics=list_of("its figures", "metric_change"),
        signals=list_of("its signals", "signal_change"),
        cause=or_null(referring("cause", "why the run leaves it, where it does")),
    )


def _metric() -> Schema:
    return table(
        "A figure beside its reference",
        id=text("id of the requirement"),
        about=text("what is measured"),
        unit=text("unit of the figures"),
        verdict=status("PASS, FAIL, or NO BASELINE where there is no reference"),
        old=_figure("the reference"),
        new=_figure("the figure of this run"),
        change=figure("the new less the old, where both are numbers"),
        allowed=figure("by how much it may change"),
    )


def _figure(described: str) -> Schema:
    kinds = ["number", "string", "null"]
    return {"type": kinds, "description": f"{described}: a number, or the word for why there is none"}


def _signal() -> Schema:
    return table(
        "A signal beside its reference",
        name=text("the signal"),
        unit=text("its unit"),
        verdict=status("PASS, FAIL, or NO BASELINE where there is no reference"),
        first_s=figure("when it first leaves what is allowed, in seconds"),
        until_s=figure("the last scan of that stretch, in seconds"),
        value=figure("its value at the first"),
        low=figure("the lowest that is allowed there"),
        high=figure("the highest that is allowed there"),
        farthest_beyond=figure("the largest distance from what is allowed, in the run"),
        reason=or_null(text("why nothing could be compared, where that is so")),
    )


def _cause() -> Schema:
    setting = table("a line of the setting", old=or_null(text("before")), new=or_null(text("now")))
    return table(
        "Why a run leaves its baseline",
        setting={"type": "array", "items": setting, "description": "what changed besides the rule bases"},
        edits=list_of("what was edited in the rule bases", "edit"),
        first_divergence=or_null(referring("divergence", "where the former rule bases would first differ")),
        rule_base_is_the_whole_reason={
            "type": "boolean",
            "description": "whether the former rule bases would keep the baseline",
        },
    )


def _edit() -> Schema:
    return table(
        "Something that was edited in a rule base",
        block=text("path of the block"),
        kind=text("what it is"),
        owner=text("variable of a term or setting, rule block of a rule"),
        name=text("the term, the label of the rule, the keyword of the setting"),
        old=text("as it was; empty where it was added"),
        new=text("as it is; empty where it was taken out"),
    )


def _divergence() -> Schema:
    return table(
        "The first scan at which a signal is not what the former rule bases make of it",
        time_s=figure("when, in seconds"),
        signal=text("the signal"),
        unit=text("its unit"),
        old=figure("what it would be"),
        new=figure("what it is"),
        block=or_null(text("the fuzzy block of which it is an output, where it is one")),
        rules=list_of("those of its rules that fire otherwise, or fire and were edited", "rule_change"),
    )


def _rule() -> Schema:
    return table(
        "A rule that fires otherwise, or says something else",
        label=text("label of the rule"),
        old=figure("its degree before, where it was there"),
        new=figure("its degree now, where it is there"),
    )
