"""Concept's FUZZY blocks, made from their own declarations, and what takes signals to INT and back.

Pins have the names of the manual. As many of those that stretching the symbol
adds are in use as are given, without a gap. A structure is a list of signals on
its way in, and an output for each member on its way out.
"""

from collections.abc import Iterator, Mapping
from itertools import pairwise
from math import isinf

from fcl_sim import concept
from fcl_sim.arithmetic.integer import TRUNCATE
from fcl_sim.concept.declaration import CEILING
from fcl_sim.concept.events import NAMES
from fcl_sim.concept.values import REAL_MOST, data_type
from fcl_sim.jit import flat
from fcl_sim.loop.blocks.concept_row import integer_block, is_int, is_real, real_block
from fcl_sim.loop.blocks.conversions import FROM_INT, INT, TO_INT, from_int, to_int
from fcl_sim.loop.blocks.declaration import (
    BlockInput,
    BlockInputs,
    BlockOutput,
    BlockParameter,
    BlockType,
    Like,
    Misfit,
    Prepared,
    UnitRule,
)
from fcl_sim.loop.blocks.setting import Setting
from fcl_sim.loop.row import Row

OPEN = float("inf")
"""A pin that stretching could add and that is not in use."""

TYPES = {"INT": INT, "REAL": f"REAL, up to {REAL_MOST:.6g} either way"}

ENABLE = BlockInput(
    name="EN", meaning="0: the block does not run, outputs stay, ENO is 0", unit="", default=1.0
)

ROUNDING = BlockParameter(
    name="rounding",
    kind="choice",
    choices=tuple(concept.Rounding),
    default=str(concept.Rounding.TRUNCATE),
    meaning="what becomes of a quotient: cut off, or the nearest, halves away from 0",
)

STANDARD_OUTPUTS = (
    BlockOutput(name="ENO", meaning="1 where it ran without an error"),
    BlockOutput(
        name="event",
        meaning="0, or what it reports: "
        + ", ".join(f"{number} {name}" for number, name in enumerate(NAMES, 1))
        + "; negative: a warning",
    ),
)


def _block(code: int, kind: concept.BlockType) -> BlockType:
    """Return a row of the library's table as a block of a loop."""
    leading = _leading(kind)

    def prepare(setting: Setting) -> Prepared:
        count, members = _in_use(kind, setting), len(kind.leading) - len(leading)
        truths = leading.count("ZERO_Y")
        words = (code, count, truths, len(leading), members, len(kind.outputs))
        return Prepared(
            words=words if _whole(kind) else (TRUNCATE, *words),
            states=(0.0,) * (len(kind.leading) + count + len(kind.outputs)),
        )

    return BlockType(
        name=kind.name,
        summary=kind.summary,
        equation=f"{kind.equation}; outputs: at first 0; they stay where it does not run or reports an error",
        source=kind.source,
        kernel=integer_block if _whole(kind) else real_block,
        inputs=(ENABLE,),
        parameters=(*_pins(kind), *((ROUNDING,) if _whole(kind) else ())),
        group=_structure(kind),
        outputs=(*_outputs(kind), *STANDARD_OUTPUTS),
        prepare=prepare,
        check=lambda setting: _check(kind, setting),
        refusal=lambda values: _refusal(kind, values),
        events=NAMES,
    )


def _whole(kind: concept.BlockType) -> bool:
    return kind.number == "INT"


def _leading(kind: concept.BlockType) -> tuple[str, ...]:
    """Return the pins before those that stretching adds, but for a structure."""
    return tuple(each for each in kind.leading if "." not in each)


def _stretched(kind: concept.BlockType) -> tuple[str, ...]:
    return kind.inputs(CEILING)[len(kind.leading) :]


def _pins(kind: concept.BlockType) -> Iterator[BlockParameter]:
    for name in _leading(kind):
        if name == "ZERO_Y":
            meaning = "other than 0: Y is 0 where no term has a degree; 0: Y stays"
            yield BlockParameter(name=name, default=0.0, port=True, meaning=meaning)
        else:
            yield BlockParameter(name=name, unit=_unit(kind, name), port=True, meaning="the value")
    for number, name in enumerate(_stretched(kind), 1):
        yield BlockParameter(
            name=name,
            unit=_unit(kind, name),
            default=None if number <= kind.least else OPEN,
            port=True,
            meaning=_meaning(kind, number),
        )


def _meaning(kind: concept.BlockType, number: int) -> str:
    if kind.stem == "MDiSi":
        return "degree of a term" if number % 2 else "place of its singleton"
    if kind.stem == "S":
        return "a point" if "X" in kind.leading else "place of a singleton"
    return "a degree"


def _place(kind: concept.BlockType) -> str:
    """Return the pin whose unit the places have, and a value or an output that is one."""
    return "MDiSi2" if kind.stem == "MDiSi" else "X" if "X" in kind.leading else "S1"


def _unit(kind: concept.BlockType, name: str) -> str | UnitRule | None:
    """Return the unit of a pin: counts and degrees have none, values and places in REAL have any, all one."""
    degree = kind.stem in {"IN", "MD"} or (name.startswith("MDiSi") and int(name[5:]) % 2 == 1)
    if _whole(kind) or degree:
        return ""
    return None if name == _place(kind) else Like(_place(kind))


def _structure(kind: concept.BlockType) -> BlockInputs | None:
    if len(_leading(kind)) == len(kind.leading):
        return None
    meaning = "members of the structure: n, term1, term2, ..; those left out are 0"
    return BlockInputs(name="MD", meaning=meaning, least=2, unit="")


def _outputs(kind: concept.BlockType) -> Iterator[BlockOutput]:
    for name in kind.outputs:
        if name != "Y":
            meaning = "terms that are in use" if name == "MD.n" else "a degree"
            yield BlockOutput(name=name, meaning=meaning)
        elif _whole(kind):
            yield BlockOutput(name=name, meaning="the mean")
        else:
            yield BlockOutput(name=name, meaning="the mean", unit=Like(_place(kind)), told_by=_place(kind))


def _in_use(kind: concept.BlockType, setting: Setting) -> int:
    """Return how many of the pins that stretching adds are in use."""
    pins = _stretched(kind)
    return max(i for i, name in enumerate(pins, 1) if _given(name, setting))


def _given(name: str, setting: Setting) -> bool:
    return name in setting.connected or not isinf(setting.values[name])


def _check(kind: concept.BlockType, setting: Setting) -> Iterator[Misfit]:
    for before, name in pairwise(_stretched(kind)):
        if _given(name, setting) and not _given(before, setting):
            hint = f"write {before} = 0, as Concept takes an open pin"
            yield Misfit(parameter=name, message=f"`{name}` is in use and `{before}` is not", hint=hint)
    fits = is_int if _whole(kind) else is_real
    for name in (*_leading(kind), *_stretched(kind)):
        value = setting.values.get(name, OPEN)
        if name != "ZERO_Y" and not isinf(value) and not fits(value):
            hint = f"it is {TYPES[kind.number]}"
            yield Misfit(parameter=name, message=f"`{name}` cannot be {value:.9g}", hint=hint)
    members = [port for port in setting.connected if port.isdigit()]
    room = len(kind.leading) - len(_leading(kind))
    if len(members) > room:
        message = f"`MD` has {len(members)} members, and the structure has {room}"
        yield Misfit(parameter="MD", message=message, hint="it is n, then term1 to term9")


def _refusal(kind: concept.BlockType, values: Mapping[str, float]) -> tuple[str, str] | None:
    """Return the pin whose value is none of its data type, and what it would take."""
    for pin, value in values.items():
        name = f"MD.{'n' if pin == '1' else 'term'}" if pin.isdigit() else pin
        number = data_type(name, kind.number)
        if name not in {"EN", "ZERO_Y"} and not (is_int if number == "INT" else is_real)(value):
            return pin, TYPES[number]
    return None


TABLE = (*(_block(code, kind) for code, kind in enumerate(concept.TABLE)), TO_INT, FROM_INT)

REAL = 1
"""Bit of the codes of the library's blocks in REAL."""


@flat
def execute(code: int, row: Row) -> None:
    """Execute a block of this family by its row in TABLE."""
    if code == 18:
        to_int(row)
    elif code == 19:
        from_int(row)
    elif code & REAL:
        real_block(row)
    else:
        integer_block(row)
