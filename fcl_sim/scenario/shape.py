"""Hold a tree against a model of `scenario.schema`: every fault at once, each where it stands."""

from collections.abc import Iterator, Mapping
from types import NoneType, UnionType
from typing import Any, get_args, get_origin

from pydantic import BaseModel, ValidationError
from pydantic_core import ErrorDetails

from fcl_sim.diagnostics import Diagnostic, Place, nearest
from fcl_sim.diagnostics.spelling import listed
from fcl_sim.loop.blocks import BLOCKS
from fcl_sim.scenario.fields import kind
from fcl_sim.scenario.schema import FUZZY, Table, model_of
from fcl_sim.toml.tree import Entry, finding

Location = tuple[int | str, ...]

LATER: Mapping[str, str] = {
    "extend": "write what differs as a variant: [variants.NAME]",
}
"""Keys of later versions, and what serves until then."""

OTHER_NAMES: Mapping[str, str] = {
    other: name
    for name, others in {
        "constant": "value const number fixed setpoint",
        "dead_band": "deadzone dead_zone deadband",
        "dead_time": "delay transport_delay transportdelay time_delay transport lag_time",
        "differentiator": "derivative derivation derive diff d dt1 rate difference",
        "expression": "formula function fcn math equation",
        "first_order_lag": "pt1 low_pass lowpass lag lag1 filter first_order smoothing",
        "fuzzy": "fcl flc rules rule_base fuzzy_controller",
        "gain": "p proportional factor scale amplifier",
        "hysteresis_relay": "relay two_point two_point_controller hysteresis bang_bang schmitt_trigger",
        "integrator": "i integral accumulator",
        "limiter": "saturation saturate limit clamp clip",
        "pid_velocity": "pid_incremental velocity_pid",
        "pid": "pi pd pid_controller",
        "product": "multiply multiplier mul times",
        "quantiser": "quantizer",
        "rate_limiter": "slew slew_rate ramp_limiter rate_limit",
        "second_order_lag": "pt2 second_order",
        "sine": "sin sinus oscillator",
        "step": "step_function jump",
        "sum": "add adder sub subtract error comparator difference_of summer",
        "table": "time_table timeseries time_series recorded csv",
        "characteristic": "lookup lookup_table polyline interpolation curve",
        "unit_delay": "memory z1 z-1 previous last",
        "sample_hold": "hold zoh zero_order_hold",
        "actuator": "valve motor drive",
        "sensor": "transmitter measurement probe",
    }.items()
    for other in others.split()
}
"""What else blocks are called elsewhere, and the kind of block that it is here."""

TABLES = {"model_type", "dict_type", "model_attributes_type"}


def shape_faults(model: type[BaseModel], entry: Entry, what: str) -> list[Diagnostic]:
    """Return what does not fit the model; `what` names the whole in messages."""
    try:
        model.model_validate(entry.plain())
    except ValidationError as error:
        details = error.errors(include_url=False, include_input=False)
        return list(_told(model, entry, what, details))
    return []


def block_faults(block: Entry, name: str) -> list[Diagnostic]:
    """Return what does not fit the shape of a block's type; nothing where the type is no text."""
    type_ = block.get("type")
    if type_ is None or not isinstance(type_.value, str):
        return []
    if type_.value not in BLOCKS:
        near = OTHER_NAMES.get(type_.value.casefold()) or nearest(type_.value, BLOCKS)
        hint = f"did you mean `{near}`?" if near else f"there are {listed(sorted(BLOCKS))}"
        return [finding("SCN302", f"there is no kind of block called `{type_.value}`", type_, hint)]
    return shape_faults(model_of(type_.value), block, f"`{name}`")


def flat(block: Entry) -> Entry:
    """Return a block whose tables have no tables within: `color.brown` is one name."""
    table = {
        key: each.keeping(dict(each.leaves())) if each.is_table else each for key, each in block.table.items()
    }
    return block.keeping(table)


def is_fuzzy(block: Entry) -> bool:
    """Return whether a block is a fuzzy one."""
    type_ = block.get("type")
    return type_ is not None and type_.value == FUZZY


def _told(
    model: type[BaseModel], entry: Entry, what: str, details: list[ErrorDetails]
) -> Iterator[Diagnostic]:
    unknown = [each for each in details if each["type"] == "extra_forbidden"]
    meant = {(*each["loc"][:-1], _meant(model, each["loc"])) for each in unknown}
    for each in details:
        if each["type"] == "missing" and each["loc"] in meant:
            continue  # misspelled, and said so
        yield _one(model, entry, what, each)


def _one(model: type[BaseModel], entry: Entry, what: str, error: ErrorDetails) -> Diagnostic:
    location = tuple(each for each in error["loc"] if each != "[key]")
    name = location[-1]
    at = _at(entry, location)
    if error["type"] == "missing":
        owner = _at(entry, location[:-1])
        return _missing(model, owner, _owner(location[:-1], owner, what), location)
    if error["type"] == "extra_forbidden":
        return _unknown(model, location, at, _owner(location[:-1], _at(entry, location[:-1]), what))
    if error["type"] in TABLES:
        hint = f"write [{name}], or {name} = {{ ... }}" if len(location) == 1 else f"write {name} = {{ ... }}"
        hint = hint if isinstance(name, str) else "write { ... }"
        return finding("SCN203", f"{_named(location)} is a table, not {kind(at.plain())}", at, hint)
    if error["type"] == "list_type":
        hint = (
            f"write [[{name}]]"
            if name in {"require", "restart"}
            else f"write {_named(location).strip('`')} = [ ... ]"
        )
        return finding("SCN203", f"{_named(location)} is a list, not {kind(at.plain())}", at, hint)
    context = error.get("ctx", {})
    message, hint = str(context.get("message", error["msg"])), str(context.get("hint", ""))
    place = at.key if error["loc"][-1] == "[key]" else at.span
    code = error["type"] if error["type"].startswith("SCN") else "SCN203"
    return finding(code, message.replace("{it}", _named(location)), place, hint)


def _at(entry: Entry, location: Location) -> Entry:
    """Return the entry at a location, or the last on the way there."""
    for each in location:
        following = entry.items[each] if isinstance(each, int) else entry.get(each)
        if following is None:
            return entry
        entry = following
    return entry


def _named(location: Location) -> str:
    if isinstance(location[-1], int):
        return f"an entry of `{next(each for each in reversed(location) if isinstance(each, str))}`"
    return f"`{location[-1]}`"


def _owner(location: Location, entry: Entry, what: str) -> str:
    """Return what a table is called: a requirement by its id, else by its key."""
    identity = entry.get("id")
    if location and isinstance(location[-1], int):
        known = identity is not None and isinstance(identity.value, str)
        return (
            f"requirement {identity.value}" if known and identity else f"`{location[-2]}` {location[-1] + 1}"
        )
    return f"`{location[-1]}`" if location else what


def _missing(model: type[BaseModel], owner: Entry, owner_name: str, location: Location) -> Diagnostic:
    name = str(location[-1])
    fields = _fields(model, location[:-1])
    field = fields.get(name)
    hint = f"`{name}` is {field.description}" if field is not None and field.description else ""
    if owner.key.end > owner.key.start:
        return finding("SCN202", f"{owner_name} has no `{name}`", owner.key, hint)
    place = Place(file=owner.key.source.name)
    return Diagnostic(code="SCN202", message=f"{owner_name} has no `{name}`", places=(place,), hint=hint)


def _unknown(model: type[BaseModel], location: Location, at: Entry, owner_name: str) -> Diagnostic:
    name = str(location[-1])
    if name in LATER:
        return finding("SCN205", f"`{name}` is not read by this version", at.key, LATER[name])
    fields = _fields(model, location[:-1])
    near = _meant(model, location)
    known = [each for each in fields if each != "type"]
    hint = f"did you mean `{near}`?" if near else f"there are {listed(known)}"
    return finding("SCN201", f"{owner_name} has no key `{name}`", at.key, hint)


def _meant(model: type[BaseModel], location: Location) -> str:
    return nearest(str(location[-1]), _fields(model, location[:-1])) or ""


def _fields(model: type[BaseModel], location: Location) -> Mapping[str, Any]:
    """Return the fields of the model at a location."""
    here: Any = model
    for each in location:
        here = _without_none(here)
        if isinstance(here, type) and issubclass(here, BaseModel):
            field = here.model_fields.get(str(each))
            here = field.annotation if field else None
        elif get_origin(here) in {dict, list}:
            here = get_args(here)[-1]
    here = _without_none(here)
    return here.model_fields if isinstance(here, type) and issubclass(here, Table) else {}


def _without_none(annotation: Any) -> Any:
    """Return X of `X | None`."""
    if get_origin(annotation) is UnionType:
        return next(each for each in get_args(annotation) if each is not NoneType)
    return annotation
