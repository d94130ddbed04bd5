"""Overrides from outside, `plant.parameters.load_mass = "10 t"`, as a tree to lay over a scenario."""

import json
import tomllib
from collections.abc import Mapping
from typing import Any

from fcl_sim.diagnostics import InputFault, Source
from fcl_sim.scenario.document import parse
from fcl_sim.toml.tree import Entry

NAME = "override"


def setting(text: str) -> tuple[str, Any]:
    """Return key and value of `KEY=VALUE`, as `--set` takes it.

    A value that reads as TOML is that value; anything else is a text, so that
    quantities need no second pair of quotes: `plant.parameters.load_mass=10 t`.
    """
    key, equals, value = (each.strip() for each in text.partition("="))
    if not equals or not key:
        raise InputFault.at_file(
            "SCN104", "", f"`{text}` sets nothing", "write KEY=VALUE, as in duration=30 s"
        )
    try:
        return key, tomllib.loads(f"value = {value}")["value"]
    except tomllib.TOMLDecodeError:
        return key, value


def overrides_tree(overrides: Mapping[str, Any]) -> Entry:
    """Return overrides by dotted key as a tree; texts, numbers, booleans, lists and mappings of these."""
    lines = [f"{_quoted(key)} = {_toml(key, value)}" for key, value in overrides.items()]
    return parse(Source(NAME, "\n".join(lines)))


def _toml(key: str, value: Any) -> str:
    if isinstance(value, str):
        return _quoted(value)
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, int | float):
        return repr(value)
    if isinstance(value, list | tuple):
        return f"[{', '.join(_toml(key, each) for each in value)}]"
    if isinstance(value, Mapping):
        pairs = (f"{_quoted(str(name))} = {_toml(key, each)}" for name, each in value.items())
        return f"{{ {', '.join(pairs)} }}"
    kind = type(value).__name__
    hint = "give a text, a number, a list or a mapping of these"
    raise InputFault.at_file("SCN104", "", f"`{key}` cannot be set to a {kind}", hint)


def _quoted(text: str) -> str:
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007F")
