"""The JSON Schema of the results: what `fcl-sim run --json` and `fcl-sim judge --json` print, key by key.

Each document is closed: a key that is not written down here does not occur. A
later version may add keys; `schema` rises when one changes its meaning or goes.
"""

from typing import Any

from fcl_sim.judge.metrics import METRICS
from fcl_sim.judge.verdict import Form, Status

DIALECT = "https://json-schema.org/draft/2020-12/schema"

Schema = dict[str, Any]

HASH = "^[0-9a-f]{64}$"


def json_schema() -> Schema:
    """Return the schema of both documents, told apart by `scenarios` and `trace`."""
    return {
        "$schema": DIALECT,
        "title": "Results of fcl-sim",
        "description": (
            "`fcl-sim run --json` and results.json beside a report have `scenarios`; "
            "`fcl-sim judge --json` has `trace`. Numbers that JSON has no word for are null."
        ),
        "oneOf": [_reference("results"), _reference("judged_trace")],
        "$defs": {
            "results": _results(),
            "judged_trace": _judged_trace(),
            "scenario": _scenario(),
            "input": _input(),
            "run": _run(),
            "plant": _plant(),
            "rule_base": _rule_base(),
            "fault": _fault(),
            "event": _event(),
            "verdict": _verdict(),
            "corridor": _corridor(),
            "band": _band(),
            "status": {
                "description": "in order of gravity; only PASS is green",
                "enum": [str(each) for each in Status],
            },
        },
    }


def _results() -> Schema:
    return _table(
        "What came of a run of scenarios",
        **_made_by(),
        verdict=_status("the gravest of all scenarios"),
        scenarios=_list("every scenario that was run", "scenario"),
    )


def _judged_trace() -> Schema:
    return _table(
        "What came of a recorded trace",
        **_made_by(),
        verdict=_status("the gravest of the requirements"),
        trace=_text("file of the trace"),
        scenario=_text("name of the scenario whose requirements are asked"),
        variant=_text("run whose expectations count"),
        requirements=_list("the verdicts, in the order of the scenario", "verdict"),
    )


def _made_by() -> Schema:
    versions = {name: _text(f"version of {name}") for name in ("fcl_sim", "python", "numpy", "numba")}
    return {
        "schema": {"const": 1, "description": "version of this form"},
        "tool": {"const": "fcl_sim", "description": "what wrote it"},
        "versions": _table("what computed the results", **versions),
    }


def _scenario() -> Schema:
    return _table(
        "A scenario with all its runs",
        name=_text("path below `scenarios/`, without the ending"),
        title=_text("what it is about"),
        verdict=_status("the gravest of its runs"),
        overrides=_by_name("what was laid over the file, by key", {"type": "string"}),
        inputs=_list("the files that it depends on", "input"),
        variants=_list("its runs; the base run stands first", "run"),
    )


def _input() -> Schema:
    return _table(
        "A file that results depend on",
        role=_text("what it is for, such as `rule base`"),
        name=_text("the file, as the user calls it"),
        sha256={"type": "string", "pattern": HASH, "description": "SHA-256 of its bytes, in hex"},
    )


def _run() -> Schema:
    return _table(
        "A variant, run and judged",
        name=_text("name of the variant; `base` is the run without one"),
        title=_text("what it is about"),
        verdict=_status("the gravest of its requirements"),
        scan_ns=_whole("time from scan to scan, in nanoseconds"),
        duration_ns=_whole("length of the run, in nanoseconds"),
        latency_ns=_whole("time from reading inputs to writing outputs, in nanoseconds"),
        jitter_ns=_whole("by how much the start of a scan moves, in nanoseconds"),
        seed={"type": "integer", "description": "what all random numbers are drawn from"},
        integration=_text("scheme of the plant's integration; `exact` of a linear one"),
        rtol=_number("relative tolerance of the integration"),
        plant=_of("plant", "the plant"),
        rule_bases=_list("the fuzzy blocks", "rule_base"),
        samples=_whole("number of scans in the trace, the end included"),
        fault=_or_null(_of("fault", "what ended the run before its time")),
        events=_list("what blocks reported, by block and event", "event"),
        requirements=_list("the verdicts, in the order of the scenario", "verdict"),
    )


def _plant() -> Schema:
    return _table(
        "The plant of a run",
        model=_text("name of the model"),
        parameters=_by_name("parameters that the scenario gives, in the model's units", _figure("")),
        start=_by_name("states at the start that the scenario gives, in the model's units", _figure("")),
    )


def _rule_base() -> Schema:
    return _table(
        "A fuzzy block",
        block=_text("path of the block"),
        function_block=_text("name of the FUNCTION_BLOCK"),
        arithmetic={"enum": ["LREAL", "REAL", "INT"], "description": "what it computes in"},
    )


def _fault() -> Schema:
    return _table(
        "What ended a run before its time",
        time_ns=_whole("when, in nanoseconds"),
        signal=_text("the signal that was no number, where there is one"),
        reason=_text("what happened"),
    )


def _event() -> Schema:
    return _table(
        "What a block reported",
        block=_text("path of the block"),
        event=_text("what it reports"),
        warning={"type": "boolean", "description": "whether it is a warning only"},
        times=_whole("how often"),
        first_ns=_whole("when first, in nanoseconds"),
    )


def _verdict() -> Schema:
    return _table(
        "A requirement, judged",
        id=_text("id of the requirement"),
        text=_text("what is required, in words"),
        metric=_or_null({"enum": list(METRICS), "description": "the metric, where one is bounded"}),
        signal=_or_null(_text("the signal, where there is one alone")),
        signals={**_texts(), "description": "the signals that it is about"},
        formula=_or_null(_text("the formula, where it is one")),
        corridor=_or_null(_of("corridor", "the corridor, where it is one")),
        arguments=_by_name("arguments of the metric, in the unit of the signal or seconds", _figure("")),
        restart_at={
            "type": "array",
            "items": _number(""),
            "description": "times at which the metric is taken anew, in seconds",
        },
        relative_to=_or_null(
            _table(
                "the run whose figure it is compared with",
                variant=_text("name of that run"),
                **{"as": {"enum": [str(each) for each in Form], "description": "how"}},
            )
        ),
        minimum=_figure("lower bound, in `unit`"),
        maximum=_figure("upper bound, in `unit`"),
        unit=_text("unit of value and bounds; empty for a pure number"),
        expect_fail={"type": "boolean", "description": "whether the run is expected to miss it"},
        verdict=_status("after the expectation: an expected miss is a PASS"),
        measured=_status("before the expectation"),
        value=_figure("the figure, in `unit`; of a formula or corridor the margin"),
        definition=_text("what the figure is, in words, or the formula"),
        reason=_text("one sentence for a reader"),
        band=_or_null(_of("band", "limits that a plot draws")),
        violation_s=_or_null(
            {
                "type": "array",
                "prefixItems": [_figure("start"), _figure("end")],
                "items": False,
                "minItems": 2,
                "description": "when it is first violated, from and to, in seconds",
            }
        ),
    )


def _corridor() -> Schema:
    return _table(
        "Limits over time, from a table",
        table=_text("name of the table"),
        time_s={"type": "array", "items": _number(""), "description": "times of its rows, in seconds"},
        low={"type": "array", "items": _figure(""), "description": "lower edge, null where there is none"},
        high={"type": "array", "items": _figure(""), "description": "upper edge, null where there is none"},
    )


def _band() -> Schema:
    return _table(
        "Limits of a signal over an interval",
        signal=_text("the signal"),
        low=_figure("lower limit, in the unit of the signal"),
        high=_figure("upper limit, in the unit of the signal"),
        start_s=_figure("from when, in seconds"),
        end_s=_figure("to when, in seconds"),
    )


def _table(described: str, **keys: Schema) -> Schema:
    """Return an object that has all of these keys and no other."""
    return {
        "type": "object",
        "description": described,
        "properties": keys,
        "required": list(keys),
        "additionalProperties": False,
    }


def _by_name(described: str, of: Schema) -> Schema:
    return {"type": "object", "description": described, "additionalProperties": of}


def _list(described: str, of: str) -> Schema:
    return {"type": "array", "description": described, "items": _reference(of)}


def _texts() -> Schema:
    return {"type": "array", "items": {"type": "string"}}


def _text(described: str) -> Schema:
    return {"type": "string", "description": described}


def _whole(described: str) -> Schema:
    return {"type": "integer", "minimum": 0, "description": described}


def _number(described: str) -> Schema:
    return {"type": "number", "description": described} if described else {"type": "number"}


def _figure(described: str) -> Schema:
    """Return a number, or null where there is none that JSON has a word for."""
    kinds: Schema = {"type": ["number", "null"]}
    return {**kinds, "description": described} if described else kinds


def _status(described: str) -> Schema:
    return _of("status", described)


def _of(name: str, described: str) -> Schema:
    return {**_reference(name), "description": described}


def _or_null(schema: Schema) -> Schema:
    """Return the same or null; a description stays outside, where readers look for it."""
    inner = {key: value for key, value in schema.items() if key != "description"}
    return {"anyOf": [inner, {"type": "null"}], "description": schema["description"]}


def _reference(name: str) -> Schema:
    return {"$ref": f"#/$defs/{name}"}
