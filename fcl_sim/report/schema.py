"""The JSON Schema of everything that fcl-sim prints with `--json`, key by key.

Each document is closed: a key that is not written down here does not occur. A
later version may add keys; `schema` rises when one changes its meaning or goes.
"""

from fcl_sim.judge.metrics import METRICS
from fcl_sim.judge.verdict import Form, Status
from fcl_sim.report import (
    schema_baseline,
    schema_constants,
    schema_coverage,
    schema_documents,
    schema_envelope,
    schema_proof,
    schema_rules,
)
from fcl_sim.report.schema_parts import (
    Schema,
    by_name,
    figure,
    list_of,
    number,
    or_null,
    reference,
    referring,
    status,
    table,
    text,
    texts,
    whole,
)

DIALECT = "https://json-schema.org/draft/2020-12/schema"

HASH = "^[0-9a-f]{64}$"


def json_schema() -> Schema:
    """Return the schema of all documents, told apart by their keys."""
    whole_documents = {
        "results": _results(),
        "judged_trace": _judged_trace(),
        **schema_documents.documents(),
        **schema_proof.documents(),
        **schema_rules.documents(_made_by()),
    }
    return {
        "$schema": DIALECT,
        "title": "What fcl-sim prints as JSON",
        "description": "Numbers that JSON has no word for are null.",
        "oneOf": [reference(name) for name in whole_documents],
        "$defs": {
            **whole_documents,
            "scenario": _scenario(),
            "input": _input(),
            "against": _against(),
            "run": _run(),
            "plant": _plant(),
            "rule_base": _rule_base(),
            "fault": _fault(),
            "event": _event(),
            "verdict": _verdict(),
            "corridor": _corridor(),
            "band": _band(),
            **schema_constants.definitions(),
            **schema_baseline.definitions(),
            **schema_envelope.definitions(_asked()),
            **schema_coverage.definitions(),
            **schema_rules.definitions(),
            **schema_documents.definitions(),
            **schema_proof.definitions(),
            "status": {
                "description": "in order of gravity; only PASS is green",
                "enum": [str(each) for each in Status],
            },
        },
    }


def _results() -> Schema:
    return table(
        "What came of a run of scenarios: `fcl-sim run --json`",
        **_made_by(),
        verdict=status("the gravest of all scenarios"),
        scenarios=list_of("every scenario that was run", "scenario"),
        coverage=list_of("how far the rules were exercised, by rule base", "coverage"),
    )


def _judged_trace() -> Schema:
    return table(
        "What came of a recorded trace: `fcl-sim judge --json`",
        **_made_by(),
        verdict=status("the gravest of the requirements"),
        trace=text("file of the trace"),
        scenario=text("name of the scenario whose requirements are asked"),
        variant=text("run whose expectations count"),
        requirements=list_of("the verdicts, in the order of the scenario", "verdict"),
    )


def _made_by() -> Schema:
    versions = {name: text(f"version of {name}") for name in ("fcl_sim", "python", "numpy", "numba")}
    return {
        "schema": {"const": 1, "description": "version of this form"},
        "tool": {"const": "fcl_sim", "description": "what wrote it"},
        "versions": table("what computed the results", **versions),
    }


def _scenario() -> Schema:
    return table(
        "A scenario with all its runs",
        name=text("path below `scenarios/`, without the ending"),
        title=text("what it is about"),
        verdict=status("the gravest of its runs"),
        overrides=by_name("what was laid over the file, by key", {"type": "string"}),
        inputs=list_of("the files that it depends on", "input"),
        variants=list_of("its runs; the base run stands first", "run"),
        against=or_null(referring("against", "an older version, where one was named by --against")),
    )


def _against() -> Schema:
    return table(
        "An older version of a scenario, run by the same bench",
        label=text("the revision or the rule base"),
        variants=list_of("its runs", "run"),
    )


def _input() -> Schema:
    return table(
        "A file that results depend on",
        role=text("what it is for, such as `rule base`"),
        name=text("the file, as the user calls it"),
        sha256={"type": "string", "pattern": HASH, "description": "SHA-256 of its bytes, in hex"},
    )


def _run() -> Schema:
    return table(
        "A variant, run and judged",
        name=text("name of the variant; `base` is the run without one"),
        title=text("what it is about"),
        verdict=status("the gravest of its requirements"),
        scan_ns=whole("time from scan to scan, in nanoseconds"),
        duration_ns=whole("length of the run, in nanoseconds"),
        latency_ns=whole("time from reading inputs to writing outputs, in nanoseconds"),
        jitter_ns=whole("by how much the start of a scan moves, in nanoseconds"),
        seed={"type": "integer", "description": "what all random numbers are drawn from"},
        integration=text("scheme of the plant's integration; `exact` of a linear one"),
        rtol=number("relative tolerance of the integration"),
        plant=referring("plant", "the plant"),
        blocks=list_of("all blocks, with what they are set to", "block"),
        rule_bases=list_of("the fuzzy blocks", "rule_base"),
        samples=whole("number of scans in the trace, the end included"),
        fault=or_null(referring("fault", "what ended the run before its time")),
        events=list_of("what blocks reported, by block and event", "event"),
        requirements=list_of("the verdicts, in the order of the scenario", "verdict"),
        baseline=or_null(referring("baseline", "the run beside its baseline, where it was compared")),
        envelope=or_null(referring("envelope", "the run over its envelope, where it has one")),
    )


def _plant() -> Schema:
    return table(
        "The plant of a run",
        model=text("name of the model"),
        parameters=by_name("parameters that the scenario gives, in the model's units", figure("")),
        start=by_name("states at the start that the scenario gives, in the model's units", figure("")),
        constants=list_of("every parameter, in the order of the plant's file", "constant"),
        states=list_of("every start value, and what inputs stay at that nothing drives", "constant"),
    )


def _rule_base() -> Schema:
    return table(
        "A fuzzy block",
        block=text("path of the block"),
        function_block=text("name of the FUNCTION_BLOCK"),
        arithmetic={"enum": ["LREAL", "REAL", "INT"], "description": "what it computes in"},
    )


def _fault() -> Schema:
    return table(
        "What ended a run before its time",
        time_ns=whole("when, in nanoseconds"),
        signal=text("the signal that was no number, where there is one"),
        reason=text("what happened"),
    )


def _event() -> Schema:
    return table(
        "What a block reported",
        block=text("path of the block"),
        event=text("what it reports"),
        warning={"type": "boolean", "description": "whether it is a warning only"},
        times=whole("how often"),
        first_ns=whole("when first, in nanoseconds"),
    )


def _asked() -> Schema:
    """Return the keys that tell what a requirement asks."""
    return {
        "id": text("id of the requirement"),
        "text": text("what is required, in words"),
        "metric": or_null({"enum": list(METRICS), "description": "the metric, where one is bounded"}),
        "signal": or_null(text("the signal, where there is one alone")),
        "signals": {**texts(), "description": "the signals that it is about"},
        "formula": or_null(text("the formula, where it is one")),
        "corridor": or_null(referring("corridor", "the corridor, where it is one")),
        "arguments": by_name("arguments of the metric, in the unit of the signal or seconds", figure("")),
        "restart_at": {
            "type": "array",
            "items": number(""),
            "description": "times at which the metric is taken anew, in seconds",
        },
        "relative_to": or_null(
            table(
                "the run whose figure it is compared with",
                variant=text("name of that run"),
                **{"as": {"enum": [str(each) for each in Form], "description": "how"}},
            )
        ),
        "minimum": figure("lower bound, in `unit`"),
        "maximum": figure("upper bound, in `unit`"),
        "unit": text("unit of value and bounds; empty for a pure number"),
        "expect_fail": {"type": "boolean", "description": "whether the run is expected to miss it"},
    }


def _verdict() -> Schema:
    return table(
        "A requirement, judged",
        **_asked(),
        verdict=status("after the expectation: an expected miss is a PASS"),
        measured=status("before the expectation"),
        value=figure("the figure, in `unit`; of a formula or corridor the margin"),
        definition=text("what the figure is, in words, or the formula"),
        reason=text("one sentence for a reader"),
        band=or_null(referring("band", "limits that a plot draws")),
        violation_s=or_null(
            {
                "type": "array",
                "prefixItems": [figure("start"), figure("end")],
                "items": False,
                "minItems": 2,
                "description": "when it is first violated, from and to, in seconds",
            }
        ),
    )


def _corridor() -> Schema:
    return table(
        "Limits over time, from a table",
        table=text("name of the table"),
        time_s={"type": "array", "items": number(""), "description": "times of its rows, in seconds"},
        low={"type": "array", "items": figure(""), "description": "lower edge, null where there is none"},
        high={"type": "array", "items": figure(""), "description": "upper edge, null where there is none"},
    )


def _band() -> Schema:
    return table(
        "Limits of a signal over an interval",
        signal=text("the signal"),
        low=figure("lower limit, in the unit of the signal"),
        high=figure("upper limit, in the unit of the signal"),
        start_s=figure("from when, in seconds"),
        end_s=figure("to when, in seconds"),
    )
