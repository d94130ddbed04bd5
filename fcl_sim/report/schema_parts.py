"""The parts of a JSON Schema: closed tables, lists, texts, numbers, each with what it is."""

from typing import Any

Schema = dict[str, Any]


def table(described: str, **keys: Schema) -> Schema:
    """Return an object that has all of these keys and no other."""
    return {
        "type": "object",
        "description": described,
        "properties": keys,
        "required": list(keys),
        "additionalProperties": False,
    }


def by_name(described: str, of: Schema) -> Schema:
    """Return an object with any keys, each of one kind."""
    return {"type": "object", "description": described, "additionalProperties": of}


def list_of(described: str, of: str) -> Schema:
    """Return a list of what a definition describes."""
    return {"type": "array", "description": described, "items": reference(of)}


def texts() -> Schema:
    """Return a list of texts."""
    return {"type": "array", "items": {"type": "string"}}


def text(described: str) -> Schema:
    """Return a text."""
    return {"type": "string", "description": described}


def whole(described: str) -> Schema:
    """Return a whole number that is not negative."""
    return {"type": "integer", "minimum": 0, "description": described}


def number(described: str) -> Schema:
    """Return a number."""
    return {"type": "number", "description": described} if described else {"type": "number"}


def figure(described: str) -> Schema:
    """Return a number, or null where there is none that JSON has a word for."""
    kinds: Schema = {"type": ["number", "null"]}
    return {**kinds, "description": described} if described else kinds


def status(described: str) -> Schema:
    """Return a verdict."""
    return referring("status", described)


def referring(name: str, described: str) -> Schema:
    """Return what a definition describes, with what it is here."""
    return {**reference(name), "description": described}


def or_null(schema: Schema) -> Schema:
    """Return the same or null; a description stays outside, where readers look for it."""
    inner = {key: value for key, value in schema.items() if key != "description"}
    return {"anyOf": [inner, {"type": "null"}], "description": schema["description"]}


def reference(name: str) -> Schema:
    """Return a reference to a definition."""
    return {"$ref": f"#/$defs/{name}"}
