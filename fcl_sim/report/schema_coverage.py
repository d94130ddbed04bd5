"""The JSON Schema of coverage: how far the rules of a rule base were exercised."""

from fcl_sim.report.schema_parts import (
    Schema,
    by_name,
    figure,
    list_of,
    number,
    or_null,
    referring,
    table,
    text,
    texts,
    whole,
)
from fcl_sim.verify.coverage import Item


def definitions() -> Schema:
    """Return the definitions by name; `coverage` is the whole."""
    return {
        "coverage": _coverage(),
        "covered_rule": _rule(),
        "covered_input": _input(),
        "cell": _cell(),
        "covered_output": _output(),
        "seen": _seen(),
    }


def _coverage() -> Schema:
    combinations = table(
        "the combinations of terms of all inputs",
        inputs={**texts(), "description": "the inputs, in their order"},
        size=whole("how many there are"),
        visited=whole("how many were visited"),
        missing={"type": "array", "items": texts(), "description": "those that were not, 1000 at most"},
    )
    return table(
        "A rule base over all runs that have it",
        function_block=text("name of the FUNCTION_BLOCK"),
        file=text("its file"),
        runs={**texts(), "description": "the runs"},
        scans=whole("evaluations in all of them"),
        decisive_by=number("part of its range by which an output must change without a rule"),
        rules=list_of("its rules", "covered_rule"),
        inputs=list_of("its inputs", "covered_input"),
        combinations=combinations,
        outputs=list_of("its outputs", "covered_output"),
    )


def _rule() -> Schema:
    waiver = table("", reason=text("why"), date=text("until when, as 2026-01-31"))
    waiver["description"] = "a waiver"
    return table(
        "A rule, as far as it was exercised",
        label=text("its label"),
        text=text("the rule"),
        **{str(each): referring("seen", f"when it was {each}") for each in Item},
        largest_change=figure("largest change of an output without it, as a part of its range"),
        waived=by_name("what is waived, by what was not seen", waiver),
    )


def _input() -> Schema:
    return table(
        "An input, as far as it was moved",
        variable=text("its name"),
        cells=list_of("the stretches between the points of its terms", "cell"),
    )


def _cell() -> Schema:
    return table(
        "A stretch of an input; what has no end is null",
        low=figure("where it begins"),
        high=figure("where it ends"),
        scans=whole("evaluations within it"),
    )


def _output() -> Schema:
    return table(
        "An output",
        variable=text("its name"),
        undefined=referring("seen", "when no rule was active for it"),
    )


def _seen() -> Schema:
    first = table("the first of them", run=text("the run"), time_ns=whole("when, in nanoseconds"))
    return table("How often something was seen", scans=whole("evaluations"), first=or_null(first))
