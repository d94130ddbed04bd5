"""`fault`: a signal that fails for a time."""

from collections.abc import Iterator
from math import inf, nan

from numpy import floor

from fcl_sim.jit import inlined
from fcl_sim.loop.blocks.declaration import (
    BlockInput,
    BlockOutput,
    BlockParameter,
    BlockType,
    Like,
    Misfit,
    Prepared,
)
from fcl_sim.loop.blocks.setting import Setting
from fcl_sim.loop.blocks.windows import CLOSE
from fcl_sim.loop.row import Row, keep, number, read, recall, word, write

KINDS = ("stuck", "dropout", "spike", "wire_break", "offset", "delayed")
STUCK, DROPOUT, SPIKE, WIRE_BREAK, OFFSET, DELAYED = range(len(KINDS))
GIVEN = ("hold", "zero", "nan")
HOLD, ZERO, NAN = range(len(GIVEN))

VALUE, EVERY = 2, 4
BEGIN, END, LOST = 6, 7, 8
KIND, DURING, LENGTH, DELAY = 0, 1, 2, 3
HELD, SPIKES, RING = 0, 1, 2


@inlined
def lost(row: Row, now: float) -> float:
    """Return what a dropout gives in a scan that is lost, else the input."""
    if number(row, LOST + min(row.scan, word(row, LENGTH) - 1)) < 0.5:
        return now
    if word(row, DURING) == HOLD:
        return recall(row, HELD)
    return 0.0 if word(row, DURING) == ZERO else nan


@inlined
def spiked(row: Row, now: float) -> float:
    """Return the input with what is added to it where a spike is due."""
    every, spikes = number(row, EVERY), 1.0
    if every > 0.0:
        spikes += floor((row.time - number(row, BEGIN)) / every + CLOSE)
    due = spikes > recall(row, SPIKES)
    keep(row, SPIKES, spikes)
    return now + number(row, VALUE) if due else now


@inlined
def fault(row: Row) -> None:
    """Kernel of `fault`; whether a scan is lost stands behind its numbers, the last inputs in a ring."""
    now, kind, delay = read(row, 0), word(row, KIND), word(row, DELAY)
    if row.scan == 0:
        keep(row, HELD, now)
    keep(row, RING + row.scan % (delay + 1), now)
    value = now
    if row.time >= number(row, BEGIN) and row.time < number(row, END):
        if kind == STUCK:
            value = recall(row, HELD)
        elif kind == DROPOUT:
            value = lost(row, now)
        elif kind == SPIKE:
            value = spiked(row, now)
        elif kind == WIRE_BREAK:
            value = number(row, VALUE)
        elif kind == OFFSET:
            value = now + number(row, VALUE)
        else:
            value = recall(row, RING + (row.scan - min(delay, row.scan)) % (delay + 1))
    if kind <= DROPOUT:
        keep(row, HELD, value)
    write(row, 0, value)


def _prepare(setting: Setting) -> Prepared:
    values = setting.values
    begin, end = (_tick(values[each]) for each in ("from", "to"))
    chance = values["chance"]
    drawn = (setting.random().random(setting.scans + 1) < chance).astype(float).tolist()
    scans = drawn if chance < 1.0 else [1.0]
    delay = round(values["delay"] / setting.cycle)
    return Prepared(
        numbers=(begin, end, *scans), words=(len(scans), delay), states=(0.0,) * (RING + delay + 1)
    )


def _tick(time: float) -> float:
    """Return a time as scans tell theirs, in whole nanoseconds."""
    return time if time == inf else round(time * 1e9) / 1e9


def _check(setting: Setting) -> Iterator[Misfit]:
    values = setting.values
    kind, scans = values["kind"], values["delay"] / setting.cycle
    if not values["from"] < values["to"]:
        yield Misfit(parameter="to", message="`to` does not lie behind `from`", hint="exchange the two")
    for name, owners in OWNERS.items():
        default = next(each.default for each in PARAMETERS if each.name == name)
        if kind not in owners and values[name] != default:
            hint = f"it belongs to {' and '.join(f'`{each}`' for each in owners)}"
            yield Misfit(parameter=name, message=f"a fault of kind `{kind}` has no `{name}`", hint=hint)
    if kind in {"spike", "offset"} and values["value"] == 0.0:
        yield Misfit(parameter="value", message="nothing is added", hint="give the `value` that is")
    if kind == "delayed" and (abs(scans - round(scans)) > CLOSE or round(scans) < 1):
        whole = max(1, round(scans)) * setting.cycle
        yield Misfit(
            parameter="delay",
            message=f"{values['delay']:.9g} s is not a whole number of scans of {setting.cycle:.9g} s",
            hint=f"give a `delay` of {whole:.9g} s",
        )


OWNERS = {
    "value": ("spike", "wire_break", "offset"),
    "during": ("dropout",),
    "chance": ("dropout",),
    "every": ("spike",),
    "delay": ("delayed",),
}
"""Parameters that only some kinds have."""

PARAMETERS = (
    BlockParameter(name="kind", kind="choice", choices=KINDS, meaning="what fails"),
    BlockParameter(name="from", unit="s", default=0.0, minimum=0.0, meaning="first time of the fault"),
    BlockParameter(name="to", unit="s", default=inf, meaning="time from which it is gone"),
    BlockParameter(
        name="value",
        unit=Like("input"),
        default=0.0,
        meaning="of a spike and an offset what is added, of a broken wire what is read",
    ),
    BlockParameter(
        name="during", kind="choice", choices=GIVEN, default="hold", meaning="what a dropout gives"
    ),
    BlockParameter(
        name="chance",
        default=1.0,
        minimum=0.0,
        maximum=1.0,
        meaning="probability that a scan is lost in a dropout",
    ),
    BlockParameter(
        name="every", unit="s", default=0.0, minimum=0.0, meaning="from one spike to the next; 0: only one"
    ),
    BlockParameter(
        name="delay", unit="s", default=0.0, minimum=0.0, meaning="of a delayed signal, in whole scans"
    ),
)

FAULT = BlockType(
    name="fault",
    summary="a signal that fails for a time: stuck, dropout, spike, wire_break, offset, delayed",
    equation=(
        "y = u unless from <= t < to; then, stuck: y_k = y_{k-1}, y_0 = u_0; dropout: in a scan that is "
        "lost y_k = y_{k-1} (hold), 0 (zero) or NaN (nan), which ends the run with FAULT; scans are lost "
        "independently with the probability `chance`, drawn from the seed; spike: y = u + value in the first "
        "scan at or after each of from, from + every, ...; wire_break: y = value; offset: y = u + value; "
        "delayed: y_k = u_{k-n}, n = delay/T, u_0 before the start. t is the time at which a scan reads"
    ),
    source="of its own; kinds after Isermann: Fault-Diagnosis Systems, 2006, 5",
    kernel=fault,
    inputs=(BlockInput(name="input", meaning="u, the signal as it would be"),),
    parameters=PARAMETERS,
    outputs=(BlockOutput(unit=Like("input")),),
    prepare=_prepare,
    check=_check,
    device=True,
)
