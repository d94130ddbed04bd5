"""The shape of scenario and controller files, as pydantic models: which keys, which kinds of value.

Names, units and references are the binder's work. The leaves are the types of
`scenario.fields`, whose refusals are written for people.
"""

import math
from collections.abc import Mapping
from functools import cache
from types import MappingProxyType
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, WithJsonSchema, create_model

from fcl_sim.judge.verdict import Over
from fcl_sim.loop.blocks import BLOCKS, BlockParameter, BlockType
from fcl_sim.loop.diagram import SKIP
from fcl_sim.scenario.fields import (
    Arithmetic,
    Chance,
    Count,
    CycleTime,
    Expectation,
    Filled,
    FormName,
    LongScan,
    Name,
    OverName,
    PointsAtLeast,
    Policy,
    Positive,
    PositiveTime,
    Quantified,
    QuantifiedOrList,
    QuantifiedOrWire,
    Ranged,
    RestartKind,
    RoundingName,
    RunNames,
    Scaled,
    SchemeName,
    Text,
    Time,
    Truth,
    UnitText,
    WireText,
    choice_of,
)

DIALECT = "https://json-schema.org/draft/2020-12/schema"
FUZZY = "fuzzy"
PLANT_MODEL = (
    "the plant: plants/NAME.py of the bench, a shipped one, or a linear one: "
    "first_order, transfer_function, zero_pole_gain, state_space"
)


class Table(BaseModel):
    """A TOML table without keys that nobody reads."""

    model_config = ConfigDict(extra="forbid", frozen=True)


class BlockTable(BaseModel):
    """A block; `type` decides what else it takes, see `block_models`."""

    model_config = ConfigDict(extra="allow", frozen=True)

    type: Filled = Field(description="kind of block")


class FuzzyTable(Table):
    """A fuzzy function block in FCL."""

    type: Literal["fuzzy"]
    file: Filled = Field(description="FCL file, relative to the file that names it")
    block: Filled = Field(None, description="which FUNCTION_BLOCK, where the file has several")
    arithmetic: Arithmetic = Field(None, description="what it computes in; by default as it declares")
    scale: dict[str, Scaled] = Field({}, description="in INT: what a count of a variable is, in its unit")
    rounding: RoundingName = Field("truncate", description="in INT: of quotients")
    units: dict[str, UnitText] = Field({}, description="unit of each variable; FCL has none")
    ranges: dict[str, Ranged] = Field(
        {}, description="from where to where inputs go: what `fcl-sim check --scenario` proves over"
    )
    inputs: dict[str, WireText] = Field(description="for each input of the block, the signal it reads")


class OverrunsTable(Table):
    """Scans that take longer than the scan time."""

    policy: Policy = Field(
        SKIP, description="what becomes of scans that fall due meanwhile: left out, or the last run late"
    )
    scans: list[LongScan] = Field([], description="scans by number from 0, each with the time it takes")
    chance: Chance = Field(0, description="probability that a scan overruns, drawn from the seed")
    longest: PositiveTime = Field(None, description="longest of those that are drawn")


class RestartTable(Table):
    """A restart of the PLC in mid-run."""

    at: PositiveTime = Field(description="time of the restart")
    kind: RestartKind = Field(description="warm: its blocks remember everything; cold: they begin anew")
    lasts: Time = Field(None, description="how long there are no scans; what was written is held")


class TimingTable(Table):
    """When a scan reads and writes, as the PLC does it."""

    latency: Time = Field(None, description="from reading inputs to writing outputs, up to the scan time")
    jitter: Time = Field(None, description="each scan begins late by up to this, drawn from the seed")
    seed: Count = Field(0, description="seed of everything drawn in the run")
    cycle_time: CycleTime = Field("nominal", description="time between scans as the blocks take it")
    overruns: OverrunsTable = Field(default_factory=OverrunsTable, description="scans that take too long")


class IntegrationTable(Table):
    """How the plant is integrated between writes."""

    scheme: SchemeName = Field("dormand_prince", description="integration scheme")
    rtol: Positive = Field(1e-8, description="relative tolerance of a scheme with step control")
    step: PositiveTime = Field(None, description="step of a scheme without step control")


class PlantTable(Table):
    """The plant, and what differs from its declaration."""

    model: Filled = Field(description=PLANT_MODEL)
    name: Name | None = Field(None, description="what its signals begin with; else the model's name")
    parameters: dict[str, QuantifiedOrList] = Field(
        {}, description="parameters, where not at their defaults; all that make a linear plant"
    )
    start: dict[str, Quantified] = Field({}, description="start values of states, where not as declared")
    inputs: dict[str, WireText] = Field(
        {}, description="for each input of the plant, the signal that drives it"
    )
    outputs: list[Name] = Field(["output"], description="names of the outputs of a linear plant")
    units: dict[str, UnitText] = Field(
        {}, description="unit of each input and output of a linear plant, where it has one"
    )


class ControllerTable(Table):
    """Which controller a scenario runs, what it reads, and what is laid over its file."""

    file: Filled = Field(description="controller file, relative to the scenario")
    inputs: dict[str, WireText] = Field(
        {}, description="for each input of the controller, the signal it reads"
    )
    scan: PositiveTime = Field(None, description="scan time instead of the file's")
    timing: TimingTable = Field(
        default_factory=TimingTable, description="what differs from the file's timing"
    )
    blocks: dict[str, Any] = Field({}, description="what differs from the file's blocks")
    outputs: dict[str, WireText] = Field({}, description="what differs from the file's outputs")


RELATIVE: dict[str, Any] = {
    "variant": (Filled, Field(description="the run whose figure it is held against")),
    "as": (FormName, Field(description="ratio, or difference in the unit of the metric")),
}
RelativeTable = create_model(
    "RelativeTable", __base__=Table, __doc__="The run beside which a metric is judged.", **RELATIVE
)


class CorridorTable(Table):
    """Limits that change with time, from a table."""

    signal: Filled = Field(description="the signal that stays within")
    file: Filled = Field(description="CSV with the columns time, low and high, relative to the scenario")


class RequirementTable(Table):
    """A bound on a metric of a signal, or a formula that holds."""

    id: Filled = Field(description="what the requirement is called in tables")
    text: Filled = Field(description="the requirement in words, with the reason of an expected miss")
    metric: dict[str, dict[str, Any]] | None = Field(None, description="one metric with its arguments")
    formula: Filled = Field(None, description="temporal formula or sentence, instead of a metric")
    corridor: CorridorTable | None = Field(None, description="limits over time, instead of a metric")
    relative_to: RelativeTable | None = Field(None, description="bound the metric beside that of a variant")
    min: Quantified = Field(None, description="smallest allowed value")
    max: Quantified = Field(None, description="largest allowed value")
    runs: RunNames = Field(None, description='names of the runs it is asked of, "base" among them; else all')
    expect: Expectation = Field(None, description='"fail", or { VARIANT = "fail" }: the miss is expected')
    over: OverName = Field(
        Over.BOTH, description="the nominal run, each of the points of its envelope, their mean, or both"
    )
    at_least: PointsAtLeast = Field(
        None, description='points at which it must hold, as in 30 or "95 %", or by run; else all'
    )


class BaselineTable(Table):
    """What the baseline of a run keeps."""

    signals: list[WireText] | None = Field(
        None,
        description="reference signals, none for a limit cycle; else outputs and moved inputs of the plant",
    )


class ControllerFile(Table):
    """What goes into the PLC."""

    title: Filled = Field(None, description="one line for people")
    description: Text = Field("", description="what a reader should know")
    scan: PositiveTime = Field(description="scan time")
    timing: TimingTable = Field(default_factory=TimingTable, description="latency, jitter and cycle time")
    blocks: dict[Name, BlockTable] = Field(description="the blocks, by name")
    inputs: dict[Name, UnitText] = Field(description="the inputs, each with its unit")
    outputs: dict[Name, WireText] = Field(description="the outputs, each with the signal it gives out")


SCALAR: dict[str, Any] = {"anyOf": [{"type": "string"}, {"type": "number"}]}
RANGE: dict[str, Any] = {
    "type": "object",
    "properties": {"from": SCALAR, "to": SCALAR, "count": {"type": "integer", "minimum": 2}},
    "required": ["from", "to", "count"],
    "additionalProperties": False,
}
GRID: dict[str, Any] = {
    "title": "GridTable",
    "description": "Values by key, which may be dotted.",
    "type": "object",
    "additionalProperties": {
        "anyOf": [{"type": "array", "minItems": 1}, RANGE, {"$ref": "#/$defs/GridTable"}]
    },
}
Vary = Annotated[Any, WithJsonSchema({"anyOf": [{"type": "object"}, {"const": False}]})]
"""Its shape is checked by `scenario.vary`: it may have the keys of all tables."""


class ScenarioFile(Table):
    """A closed loop, its variants, and what is required of it."""

    title: Filled = Field(description="one line for tables and reports")
    description: Text = Field("", description="the story: what is shown, what to look at")
    duration: PositiveTime = Field(description="length of a run, a whole number of scans")
    scan: PositiveTime = Field(None, description="scan time, where there is no controller file")
    controller: ControllerTable | None = Field(None, description="the controller")
    blocks: dict[Name, BlockTable] = Field({}, description="blocks that stand outside the controller")
    plant: PlantTable = Field(description="the plant")
    timing: TimingTable = Field(default_factory=TimingTable, description="timing, laid over the controller's")
    integration: IntegrationTable = Field(
        default_factory=IntegrationTable, description="integration of the plant"
    )
    restart: list[RestartTable] = Field([], description="restarts of the PLC")
    vary: Vary = Field(None, description="envelope: lists of values by key, or { from, to, count }")
    variants: dict[Name, dict[str, Any]] = Field({}, description="further runs, each by what differs")
    baseline: BaselineTable = Field(default_factory=BaselineTable, description="what its baselines keep")
    require: list[RequirementTable] = Field([], description="what is required of the runs")


@cache
def model_of(kind: str) -> type[Table]:
    """Return the shape of a kind of block, by type; made when first needed, for it takes milliseconds."""
    return FuzzyTable if kind == FUZZY else block_model(BLOCKS[kind])


def block_models() -> Mapping[str, type[Table]]:
    """Return the shape of each kind of block, by type, made from the loop's own table."""
    return MappingProxyType({kind: model_of(kind) for kind in BLOCKS})


GROUPS: Mapping[str, Any] = {
    "gains": dict[str, Quantified],
    "list": list[WireText],
    "named": dict[Name, WireText],
}
"""How the signals of a group are written, by its form."""

PARAMETERS: Mapping[str, Any] = {
    "quantity": Quantified,
    "count": Count,
    "truth": Truth,
    "text": Filled,
    "formula": Filled,
    "list": list[Quantified],
    "table": list[list[Quantified]],
    "rows": dict[Name, list[Quantified]],
    "units": dict[Name, UnitText],
    "file": Filled,
}
"""How a parameter is written, by its kind; a choice is made from its words."""


def block_model(block: BlockType) -> type[Table]:
    """Return the shape of a kind of block, made from its declaration."""
    fields: dict[str, Any] = {"type": (Literal[block.name], ...)}
    for port in block.inputs:
        default = ... if port.default is None else None
        fields[port.name] = (WireText, Field(default, description=f"a signal: {port.meaning}"))
    for each in block.parameters:
        written = choice_of(each.choices) if each.kind == "choice" else PARAMETERS[each.kind]
        default = ... if each.default is None else _finite(each.default)
        described = f"{each.meaning}{_unit(each)}"
        fields[each.name] = (
            QuantifiedOrWire if each.port else written,
            Field(default, description=described),
        )
    group = block.group
    if group:
        least: Any = {} if group.least == 0 else ...
        fields[group.name] = (GROUPS[group.form], Field(least, description=group.meaning))
    name = f"{block.name.capitalize()}Table"
    made: type[Table] = create_model(
        name, __base__=Table, __doc__=f"{block.summary}: {block.equation}", **fields
    )
    return made


def _unit(parameter: BlockParameter) -> str:
    if parameter.kind not in {"quantity", "list"}:
        return ""
    written = f", in {parameter.unit}" if isinstance(parameter.unit, str) and parameter.unit else ""
    return f"{written}; or a signal" if parameter.port else written


def _finite(default: Any) -> Any:
    """Return a default as an editor may show it: JSON has no infinity."""
    return None if isinstance(default, float) and math.isinf(default) else default


def json_schema(of: str = "scenario") -> dict[str, Any]:
    """Return the JSON Schema of scenario files, or of controller files, for editors."""
    files: Mapping[str, type[Table]] = {"scenario": ScenarioFile, "controller": ControllerFile}
    schema = files[of].model_json_schema(ref_template="#/$defs/{model}")
    definitions = schema.setdefault("$defs", {})
    references = []
    for table_model in block_models().values():
        inner = table_model.model_json_schema(ref_template="#/$defs/{model}")
        definitions |= inner.pop("$defs", {})
        definitions[inner["title"]] = inner
        references.append({"$ref": f"#/$defs/{inner['title']}"})
    definitions["BlockTable"] = {"title": "BlockTable", "oneOf": references}
    if of == "scenario":
        definitions["GridTable"] = GRID
        schema["properties"]["vary"]["anyOf"] = [{"$ref": "#/$defs/GridTable"}, {"const": False}]
    for table in (schema, *definitions.values()):
        for each in table.get("properties", {}).values():
            _tidy(each)
    return {"$schema": DIALECT, **schema}


def _tidy(field: dict[str, Any]) -> None:
    """Take out of a field what pydantic adds: a title that is its key again, and null, which TOML has not."""
    field.pop("title", None)
    if field.get("default", 0) is None:
        del field["default"]
    kinds = [each for each in field.pop("anyOf", ()) if each != {"type": "null"}]
    if len(kinds) == 1:
        field |= kinds[0]
    elif kinds:
        field["anyOf"] = kinds
