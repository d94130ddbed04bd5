"""The shape of a baseline's file, as pydantic models; what the keys mean stands in docs/baselines.md."""

from datetime import date
from typing import Annotated, Any, Literal

from pydantic import Field, PlainValidator

from fcl_sim.scenario.fields import Arithmetic, Filled, Quantified, Text, Time, UnitText, kind, refused
from fcl_sim.scenario.schema import Table

WORDS = ("never", "untested", "inconclusive", "fault", "pass", "fail")
"""What stands for a figure where there is none."""


def _day(value: Any) -> date:
    if type(value) is not date:
        raise refused("SCN203", f"{{it}} is a date, not {kind(value)}", "as in date = 2026-01-31")
    return value


def _figure(value: Any) -> Any:
    return value if value in WORDS else Quantified.__metadata__[0].func(value)


def _samples(value: Any) -> Any:
    if not isinstance(value, list) or len(value) < 1:
        raise refused("SCN203", "{it} has rows of time and value", "as in [ [0, 25], [60, 0.32] ]")
    before = -1.0
    for row in value:
        if not _is_sample(row) or row[0] <= before:
            hint = "a row is [seconds, value], and the seconds rise"
            raise refused("SCN203", f"{{it}} cannot have the row {row}", hint)
        before = row[0]
    return value


def _is_sample(row: Any) -> bool:
    if not isinstance(row, list) or len(row) != 2:
        return False
    return all(
        isinstance(each, int | float) and not isinstance(each, bool) and abs(each) < float("inf")
        for each in row
    )


def _not_negative(value: Any) -> Any:
    if isinstance(value, bool) or not isinstance(value, int | float) or not 0.0 <= value < 1.0:
        message = f"{{it}} is a part of the value, from 0 to less than 1, not {value}"
        raise refused("SCN203", message, "as in 0.01")
    return value


Day = Annotated[Any, PlainValidator(_day)]
FigureText = Annotated[Any, PlainValidator(_figure)]
Samples = Annotated[Any, PlainValidator(_samples)]
Part = Annotated[Any, PlainValidator(_not_negative)]


class MetricTable(Table):
    """The figure of a requirement."""

    id: Filled = Field(description="the requirement")
    about: Filled = Field(description="what is measured, of which signal")
    value: FigureText = Field(description="the figure with its unit, or never, untested ...")
    absolute: Quantified = Field(0, description="what it may change by")
    relative: Part = Field(0, description="what it may change by, as a part of it, on top")


class SignalTable(Table):
    """A reference signal."""

    name: Filled = Field(description="the signal")
    unit: UnitText = Field("", description="its unit")
    thinned: Quantified = Field(0, description="how far samples that were left out may be from the line")
    absolute: Quantified = Field(0, description="what it may differ by")
    relative: Part = Field(0, description="what it may differ by, as a part of the value, on top")
    leading: Time = Field("0 s", description="how much earlier it may be")
    lagging: Time = Field("0 s", description="how much later it may be")
    samples: Samples = Field(description="rows of seconds and value, with a line between two")


class RuleBaseTable(Table):
    """A rule base that the run was made with."""

    block: Filled = Field(description="the fuzzy block")
    arithmetic: Arithmetic = Field(description="what it was computed in")
    fcl: Filled = Field(description="its text in canonical FCL")


class BaselineFile(Table):
    """What a run came to when it was accepted."""

    schema_: Literal[1] = Field(alias="schema", description="1")
    scenario: Filled = Field(description="the scenario")
    variant: Filled = Field(description="the variant")
    date: Day = Field(description="when it was accepted")
    reason: Filled = Field(description="why it was accepted")
    setting: list[Text] = Field([], description="under which circumstances, a line for each")
    left_out: Text = Field("", description="why no signals are kept")
    metrics: list[MetricTable] = Field([], description="the figures, by requirement")
    rule_base: list[RuleBaseTable] = Field([], description="the rule bases")
    signal: list[SignalTable] = Field([], description="the reference signals")
