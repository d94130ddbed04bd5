"""The JSON Schema of what a run computes with: constants of its plant, settings of its blocks."""

from fcl_sim.report.schema_parts import Schema, by_name, figure, table, text


def definitions() -> dict[str, Schema]:
    """Return the definitions of a constant and of a block, by name."""
    return {"constant": _constant(), "block": _block()}


def _constant() -> Schema:
    return table(
        "A constant of a plant",
        name=text("its name"),
        value=figure("what it is in this run, in `unit`"),
        unit=text("its unit; empty or 1 for a pure number"),
        meaning=text("what it is of"),
        source=text("where the declared value comes from; `[A]` marks an assumption; empty of a start value"),
        declared=figure("what it is where no scenario gives it"),
        assumed={"type": "boolean", "description": "whether its value here is an assumption"},
        minimum=figure("the least that it may be"),
        maximum=figure("the largest that it may be"),
    )


def _block() -> Schema:
    anything: Schema = {"type": ["string", "number", "boolean", "array", "object", "null"]}
    described = "numbers with units are texts, as in a scenario"
    return table(
        "A block of the loop",
        name=text("path of the block"),
        type=text("its type"),
        given=by_name(f"what the scenario sets it to; {described}", anything),
        left=by_name("what else it is set to, by its type; bounds that there are not are left out", anything),
        wired=by_name("the signals that it reads, by port", {"type": "string"}),
    )
