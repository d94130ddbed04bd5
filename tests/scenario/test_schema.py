"""The schema says what the reader does: every block of the loop, every key, no pydantic noise."""

import json

import pytest

from fcl_sim.loop.blocks import BLOCKS
from fcl_sim.scenario.schema import ControllerFile, ScenarioFile, block_models, json_schema


def test_every_kind_of_block_has_its_shape():
    assert set(block_models()) == set(BLOCKS)
    for name, block in BLOCKS.items():
        fields = set(block_models()[name].model_fields)
        assert fields >= {"type", *(each.name for each in (*block.inputs, *block.parameters))}
        assert block.group is None or block.group.name in fields


@pytest.mark.parametrize(("kind", "model"), [("scenario", ScenarioFile), ("controller", ControllerFile)])
def test_the_json_schema_has_every_key_and_only_those(kind, model):
    schema = json_schema(kind)
    assert set(schema["properties"]) == set(model.model_fields)
    assert schema["additionalProperties"] is False
    assert schema["$schema"].startswith("https://json-schema.org/")
    assert "null" not in json.dumps(schema, allow_nan=False)


def test_the_json_schema_resolves_its_references():
    schema = json_schema()
    names = {each.rpartition("/")[2] for each in _references(schema)}
    assert names <= set(schema["$defs"])
    assert {f"{name.capitalize()}Table" for name in BLOCKS} <= names


def _references(schema):
    if isinstance(schema, dict):
        for key, each in schema.items():
            if key == "$ref":
                yield each
            else:
                yield from _references(each)
    elif isinstance(schema, list):
        for each in schema:
            yield from _references(each)


def test_every_key_says_what_it_is():
    for table in [json_schema(), json_schema("controller"), *json_schema()["$defs"].values()]:
        for name, each in table.get("properties", {}).items():
            assert name == "type" or each.get("description"), (table.get("title"), name)
