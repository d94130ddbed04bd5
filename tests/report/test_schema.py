"""The schema of the results is true: what is written follows it, and it says of every key what it is."""

import json
from dataclasses import replace

import pytest
from jsonschema import Draft202012Validator
from jsonschema.exceptions import ValidationError

from fcl_sim.judge.verdict import Corridor, Form, Relative, Status
from fcl_sim.loop.trace import BlockEvent
from fcl_sim.report.results import recorded, text
from fcl_sim.report.schema import json_schema
from tests.report.synthetic import of_formula, outcome, run, verdict

SCHEMA = json_schema()


def hold(document):
    """Raise where a document does not follow the schema."""
    Draft202012Validator(SCHEMA).validate(document)


def everything(folder):
    """Return results with every kind of requirement, a fault, an event, overrides, figures that are none."""
    corridor = Corridor(
        name="limits.csv", signal="crane.sway", ticks=(0, 10**9), low=(-1.0, float("nan")), high=(1.0, 2.0)
    )
    verdicts = (
        verdict(),
        verdict(Status.FAIL, float("inf"), minimum=1.0, restart_at=(2.0, 4.0)),
        verdict(relative_to=Relative("raw_distance", Form.RATIO), unit=""),
        replace(verdict(metric="", signal="", arguments={}, corridor=corridor), band=None),
        of_formula("never crane.sway > 3 deg", Status.FAIL, -0.5),
    )
    given = run(folder, verdicts=verdicts)
    events = (BlockEvent(9 * 10**9, "press", "OVERFLOW", False),)
    base = replace(given, trace=replace(given.trace, events=events))
    return outcome(folder, base, run(folder, "fault", "fault"), overrides={"duration": "1 s"})


def test_the_schema_is_one():
    Draft202012Validator.check_schema(SCHEMA)


def test_results_follow_it(tmp_path):
    hold(json.loads(text([everything(tmp_path)])))
    hold(json.loads(text([])))


def test_a_judged_trace_follows_it(tmp_path):
    made = everything(tmp_path)
    hold(json.loads(recorded("x.csv", made.scenario, "base", made.base.verdicts)))


def tables(schema, path=""):
    """Yield every closed table of the schema with its place."""
    if isinstance(schema, dict):
        if "properties" in schema:
            yield path, schema
        for key, each in schema.items():
            yield from tables(each, f"{path}/{key}")
    elif isinstance(schema, list):
        for number, each in enumerate(schema):
            yield from tables(each, f"{path}/{number}")


def test_a_key_more_or_less_is_refused_everywhere(tmp_path):
    document = json.loads(text([everything(tmp_path)]))
    run_of = document["scenarios"][0]["variants"][0]
    for table in (document, document["scenarios"][0], run_of, run_of["plant"], run_of["requirements"][0]):
        for change in ({**table, "more": 1}, dict(list(table.items())[:-1])):
            kept = dict(table)
            table.clear()
            table.update(change)
            with pytest.raises(ValidationError):
                hold(document)
            table.clear()
            table.update(kept)
    hold(document)
    assert all(table["additionalProperties"] is False for _, table in tables(SCHEMA))


def test_every_key_says_what_it_is():
    nameless = [
        f"{path}/{key}"
        for path, table in tables(SCHEMA)
        for key, each in table["properties"].items()
        if not each.get("description")
    ]
    assert nameless == []


def test_every_definition_is_used():
    told = json.dumps(SCHEMA)
    assert [name for name in SCHEMA["$defs"] if f'"#/$defs/{name}"' not in told] == []
