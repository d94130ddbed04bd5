"""The page of the results' JSON, from its schema."""

from typing import Any

from fcl_sim.report.schema import json_schema

HEAD = """\
# Results as JSON

With `--json` a command prints one document. `results.json` beside a report is that of `fcl-sim run --json`,
and the PDF carries it. One JSON Schema tells of them all; it is printed by

    fcl-sim schema results

Results depend on the inputs alone: no times of day, no durations of a computation. Numbers that JSON has no
word for (an infinite settling time) are null. A key that is marked *optional* may be left out, every other is
always there. `schema` rises when a key changes its meaning or goes; a later version may add keys."""

WORDS = {"string": "text", "object": "table", "boolean": "true or false"}
NAMES = {
    "results": "Results",
    "judged_trace": "A judged trace",
    "findings": "Findings",
    "codes": "Codes",
    "evaluation": "An evaluation",
    "conformance_tables": "Tables of conformance",
    "conformance": "Conformance of rule bases",
    "difference": "A difference of rule bases",
    "replay": "A replay",
    "mutants": "Mutants",
}
"""Of the documents; what they consist of has the name that the schema gives it."""


def page() -> str:
    """Return the page in Markdown."""
    definitions = json_schema()["$defs"]
    parts = [_part(name, each) for name, each in definitions.items()]
    return "\n\n".join([HEAD, *parts]) + "\n"


def _part(name: str, schema: dict[str, Any]) -> str:
    heading = f"## {NAMES.get(name, name)}"
    if "properties" not in schema:
        words = ", ".join(f"`{each}`" for each in schema["enum"])
        return f"{heading}\n\n{_sentence(schema['description'])}\n\n{words}"
    rows = "\n".join(_rows(schema))
    return f"{heading}\n\n{_sentence(schema['description'])}\n\n| key | | |\n|---|---|---|\n{rows}"


def _rows(schema: dict[str, Any], prefix: str = "") -> list[str]:
    rows = []
    for key, each in schema["properties"].items():
        inner = next((one for one in (each, *each.get("anyOf", ())) if "properties" in one), None)
        optional = "" if key in schema["required"] else ", *optional*"
        rows.append(f"| `{prefix}{key}` | {_kind(each)}{optional} | {each['description']} |")
        rows += _rows(inner, f"{prefix}{key}.") if inner else []
    return rows


def _kind(schema: dict[str, Any]) -> str:
    match schema:
        case {"anyOf": kinds}:
            return " or ".join(_kind(each) for each in kinds)
        case {"$ref": reference}:
            name = reference.rpartition("/")[2]
            return f"[{name}](#{NAMES.get(name, name).lower().replace(' ', '-')})"
        case {"const": _} | {"enum": _}:
            return f"`{schema['const']}`" if "const" in schema else "text"
        case {"type": "array"}:
            return _list(schema)
        case {"additionalProperties": dict(inner)}:
            return f"{_kind(inner)} by name"
    kinds = schema["type"] if isinstance(schema["type"], list) else [schema["type"]]
    return " or ".join(WORDS.get(each, each) for each in kinds)


def _list(schema: dict[str, Any]) -> str:
    if "items" not in schema:
        return "list"
    return f"list of {_kind(schema['items'])}" if schema["items"] else "pair of numbers"


def _sentence(words: str) -> str:
    return f"{words[0].upper()}{words[1:]}."
