"""The leaves of a scenario file: each a type that refuses with a sentence and a mend."""

import re
from typing import Annotated, Any

from pydantic import PlainValidator, WithJsonSchema
from pydantic_core import PydanticCustomError

from fcl_sim.block import ARITHMETICS
from fcl_sim.concept.instance import Rounding
from fcl_sim.diagnostics import nearest
from fcl_sim.diagnostics.spelling import listed
from fcl_sim.judge.verdict import AtLeast, Form, Over
from fcl_sim.loop.diagram import POLICIES, RESTARTS
from fcl_sim.loop.schemes import SCHEMES
from fcl_sim.units import ONE, UnitError, exact, nanoseconds, parse_quantity, parse_unit

NAME = re.compile(r"[^\W\d]\w*")
WIRE = re.compile(rf"-?{NAME.pattern}(\.{NAME.pattern})*")
QUANTITY = r"^\s*[+-]?(\d+(\.\d*)?|\.\d+)([eE][+-]?\d+)?.*$"
CYCLE_TIMES = ("nominal", "measured")
FAIL = "fail"


def refused(code: str, message: str, hint: str = "") -> PydanticCustomError:
    """Return the refusal of a value; {it} in the message stands for its key."""
    return PydanticCustomError(code, "{message}", {"message": message, "hint": hint})


def kind(value: Any) -> str:
    """Return what a TOML value is, for a reader."""
    if isinstance(value, bool):
        return "true or false"
    names = {"a number": int | float, "a text": str, "a table": dict, "a list": list}
    return next((name for name, type_ in names.items() if isinstance(value, type_)), "a date or time")


def _text(value: Any) -> str:
    if not isinstance(value, str):
        raise refused("SCN203", f"{{it}} is a text, not {kind(value)}", "write it in quotes")
    return value


def _filled(value: Any) -> str:
    if not _text(value).strip():
        raise refused("SCN203", "{it} is empty")
    return str(value)


def _quantity(value: Any) -> str | float:
    if isinstance(value, bool) or not isinstance(value, str | int | float):
        raise refused("SCN203", f"{{it}} is a quantity, not {kind(value)}", 'write it as in "20 t"')
    try:
        parse_quantity(value)
    except UnitError as error:
        raise refused("SCN204", f"{{it}}: {error}", error.hint) from error
    return value


def _time(value: Any) -> str:
    if isinstance(value, int | float) and not isinstance(value, bool):
        raise refused("SCN204", f"{{it}} is a time and needs a unit, not {value} alone", f'write "{value} s"')
    if not isinstance(value, str):
        raise refused("SCN203", f"{{it}} is a time, not {kind(value)}", 'write it as in "50 ms"')
    try:
        ticks = nanoseconds(parse_quantity(value))
    except UnitError as error:
        raise refused("SCN204", f"{{it}}: {error}", error.hint) from error
    if ticks < 0:
        raise refused("SCN204", f"{{it}} is negative: {value}", "times run forward")
    return value


def _positive_time(value: Any) -> str:
    if nanoseconds(parse_quantity(_time(value))) == 0:
        raise refused("SCN204", "{it} must be greater than 0")
    return str(value)


def _positive(value: Any) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise refused("SCN203", f"{{it}} is a number, not {kind(value)}", "write it without quotes")
    if not 0 < value < float("inf"):
        raise refused("SCN203", f"{{it}} must be greater than 0 and finite, not {value}")
    return float(value)


def _count(value: Any) -> int:
    if isinstance(value, bool) or not isinstance(value, int):
        raise refused("SCN203", f"{{it}} is a whole number, not {kind(value)}", "as in seed = 1")
    if not 0 <= value < 2**63:
        raise refused("SCN203", "{it} must lie between 0 and 2^63 - 1")
    return value


def _chance(value: Any) -> Any:
    quantity = parse_quantity(_quantity(value))
    if not quantity.unit.commensurate(ONE) or not 0.0 <= quantity.to(ONE) <= 1.0:
        raise refused("SCN203", f"{{it}} is a probability, not {value}", 'as in 0.01, or "1 %"')
    return value


def _long_scan(value: Any) -> Any:
    if not isinstance(value, list) or len(value) != 2:
        raise refused("SCN203", "{it} has pairs: a scan and how long it takes", 'as in [[120, "70 ms"]]')
    return [_count(value[0]), _positive_time(value[1])]


def _name(value: Any) -> str:
    if not NAME.fullmatch(_text(value)):
        hint = "names are letters, digits and underscores, and begin with a letter"
        raise refused("SCN206", f"`{value}` is not a name", hint)
    return str(value)


def _unit(value: Any) -> str:
    try:
        parse_unit(_text(value))
    except UnitError as error:
        raise refused("SCN204", f"{{it}}: {error}", error.hint) from error
    return str(value)


def _wire(value: Any) -> str:
    if not isinstance(value, str):
        hint = 'name the signal in quotes, as in "crane.distance"'
        raise refused("SCN203", f"{{it}} is the name of a signal, not {kind(value)}", hint)
    if not WIRE.fullmatch(value.replace(" ", "")):
        hint = 'write it as in "crane.distance", or "-crane.distance" for its negative'
        raise refused("SCN206", f"{{it}}: `{value}` is not the name of a signal", hint)
    return value


def _choice(value: Any, known: tuple[str, ...]) -> str:
    if _text(value) not in known:
        near = nearest(value, known)
        hint = f"did you mean `{near}`?" if near else f"it is {listed(known)}"
        raise refused("SCN203", f"{{it}} cannot be `{value}`", hint)
    return str(value)


def _truth(value: Any) -> bool:
    if not isinstance(value, bool):
        raise refused("SCN203", f"{{it}} is true or false, not {kind(value)}", "write it without quotes")
    return value


def is_wire(value: Any) -> bool:
    """Return whether what a key holds is the name of a signal, not a quantity."""
    return isinstance(value, str) and WIRE.fullmatch(value.replace(" ", "")) is not None


def _quantity_or_wire(value: Any) -> str | float:
    return value if is_wire(value) else _quantity(value)


def _scaled(value: Any) -> Any:
    if not isinstance(value, list):
        return _quantity(value)
    if len(value) != 2:
        hint = 'write it as in ["0.01 m", "-5 m"]'
        raise refused("SCN203", "{it} is what a count is, or that and what the count 0 is", hint)
    return [_quantity(each) for each in value]


def _ranged(value: Any) -> Any:
    if not isinstance(value, list) or len(value) != 2:
        hint = 'write it as in ["-10 m", "30 m"]'
        raise refused("SCN203", "{it} is from where to where a variable goes: two quantities", hint)
    return [_quantity(each) for each in value]


def _quantity_or_list(value: Any) -> Any:
    return value if isinstance(value, list) else _quantity(value)


def choice_of(known: tuple[str, ...]) -> Any:
    """Return the type of a text that is one of `known`."""
    return Annotated[Any, PlainValidator(lambda value: _choice(value, known)), _schema({}, enum=list(known))]


def _form(value: Any) -> str:
    return _choice(value, tuple(Form))


def at_least(value: Any) -> AtLeast:
    """Return how many points of an envelope a count or a share, `"95 %"`, means; a refusal where none."""
    if isinstance(value, int) and not isinstance(value, bool):
        if value < 1:
            raise refused("SCN203", f"{{it}} must be 1 or more, not {value}", "it counts points")
        return AtLeast(count=value)
    hint = 'write the number of points, as in at_least = 30, or their share, as in at_least = "95 %"'
    if not isinstance(value, str):
        raise refused("SCN203", f"{{it}} is a number of points or a share of them, not {kind(value)}", hint)
    quantity = parse_quantity(_quantity(value))
    if quantity.unit.symbol != "%" or not 0.0 < quantity.value <= 100.0:
        raise refused("SCN203", f"{{it}} cannot be `{value}`", hint)
    return AtLeast(share=exact(quantity.value) / 100)


def _at_least(value: Any) -> Any:
    for each in value.values() if isinstance(value, dict) else [value]:
        at_least(each)
    return value


def _expectation(value: Any) -> Any:
    if isinstance(value, dict):
        for each in value.values():
            _choice(each, (FAIL,))
    elif value != FAIL:
        shown = f"`{value}`" if isinstance(value, str) else kind(value)
        hint = 'write expect = "fail", or name the runs: expect = { base = "fail" }'
        raise refused("SCN203", f"{{it}} can only be `fail`, not {shown}", hint)
    return value


def _run_names(value: Any) -> list[str]:
    hint = 'name the runs in quotes, as in runs = ["base", "light"]'
    if not isinstance(value, list):
        raise refused("SCN203", f"{{it}} is a list of runs, not {kind(value)}", hint)
    if not value:
        raise refused("SCN203", "{it} is empty, so that it would be asked of no run", hint)
    for each in value:
        if not isinstance(each, str):
            raise refused("SCN203", f"{{it}} has {kind(each)} among the names of runs", hint)
    return value


TEXT = {"type": "string"}
NUMBER = {"type": "number"}
WRITTEN = {**TEXT, "pattern": QUANTITY}


def _schema(base: dict[str, Any], **more: Any) -> WithJsonSchema:
    return WithJsonSchema({**base, **more})


Text = Annotated[Any, PlainValidator(_text), _schema(TEXT)]
Filled = Annotated[Any, PlainValidator(_filled), _schema(TEXT, minLength=1)]
Quantified = Annotated[
    Any, PlainValidator(_quantity), _schema({}, anyOf=[{**WRITTEN, "examples": ["20 t", "-25 m"]}, NUMBER])
]
Truth = Annotated[Any, PlainValidator(_truth), _schema({"type": "boolean"})]
QuantifiedOrWire = Annotated[
    Any,
    PlainValidator(_quantity_or_wire),
    _schema({}, anyOf=[{**TEXT, "examples": ["2.5 kW/m", "rules.kp"]}, NUMBER]),
]
QuantifiedOrList = Annotated[
    Any,
    PlainValidator(_quantity_or_list),
    _schema({}, anyOf=[{**WRITTEN, "examples": ["20 t", "-25 m"]}, NUMBER, {"type": "array"}]),
]
Time = Annotated[Any, PlainValidator(_time), _schema(WRITTEN, examples=["20 ms"])]
PositiveTime = Annotated[Any, PlainValidator(_positive_time), _schema(WRITTEN, examples=["50 ms", "60 s"])]
Positive = Annotated[Any, PlainValidator(_positive), _schema(NUMBER, exclusiveMinimum=0)]
Count = Annotated[Any, PlainValidator(_count), _schema({"type": "integer"}, minimum=0)]
Chance = Annotated[Any, PlainValidator(_chance), _schema({}, anyOf=[WRITTEN, NUMBER])]
LongScan = Annotated[
    Any, PlainValidator(_long_scan), _schema({"type": "array"}, prefixItems=[{"type": "integer"}, WRITTEN])
]
Name = Annotated[str, PlainValidator(_name), _schema(TEXT, pattern=f"^{NAME.pattern}$")]
UnitText = Annotated[Any, PlainValidator(_unit), _schema(TEXT, examples=["m", "deg", "kW", "1"])]
WireText = Annotated[
    Any, PlainValidator(_wire), _schema(TEXT, examples=["crane.distance", "-crane.distance"])
]
Arithmetic = choice_of(ARITHMETICS)
RoundingName = choice_of(tuple(str(each) for each in Rounding))
Scaled = Annotated[
    Any,
    PlainValidator(_scaled),
    _schema(
        {},
        anyOf=[
            {**WRITTEN, "examples": ["0.01 m"]},
            NUMBER,
            {"type": "array", "items": {"anyOf": [WRITTEN, NUMBER]}, "minItems": 2, "maxItems": 2},
        ],
    ),
]
Ranged = Annotated[
    Any,
    PlainValidator(_ranged),
    _schema(
        {},
        type="array",
        items={"anyOf": [WRITTEN, NUMBER]},
        minItems=2,
        maxItems=2,
        examples=[["-10 m", "30 m"]],
    ),
]
SchemeName = Annotated[
    Any, PlainValidator(lambda value: _choice(value, tuple(SCHEMES))), _schema({}, enum=sorted(SCHEMES))
]
CycleTime = Annotated[
    Any, PlainValidator(lambda value: _choice(value, CYCLE_TIMES)), _schema({}, enum=list(CYCLE_TIMES))
]
Policy = Annotated[
    Any, PlainValidator(lambda value: _choice(value, POLICIES)), _schema({}, enum=list(POLICIES))
]
RestartKind = Annotated[
    Any, PlainValidator(lambda value: _choice(value, RESTARTS)), _schema({}, enum=list(RESTARTS))
]
OverName = choice_of(tuple(str(each) for each in Over))
FormName = Annotated[Any, PlainValidator(_form), _schema({}, enum=list(Form))]
Expectation = Annotated[
    Any,
    PlainValidator(_expectation),
    _schema({}, anyOf=[{"const": FAIL}, {"type": "object", "additionalProperties": {"const": FAIL}}]),
]
RunNames = Annotated[
    Any,
    PlainValidator(_run_names),
    _schema({"type": "array"}, items=TEXT, minItems=1, examples=[["base", "light"]]),
]
NUMBER_OF_POINTS = [{"type": "integer", "minimum": 1}, {**WRITTEN, "examples": ["95 %"]}]
PointsAtLeast = Annotated[
    Any,
    PlainValidator(_at_least),
    _schema(
        {},
        anyOf=[
            *NUMBER_OF_POINTS,
            {"type": "object", "additionalProperties": {"anyOf": NUMBER_OF_POINTS}},
        ],
    ),
]
