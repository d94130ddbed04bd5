"""What a block type declares of itself."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from fcl_sim.diagnostics import Span
from fcl_sim.loop.blocks.setting import Setting
from fcl_sim.units import ONE, Quantity, Unit, UnitError, parse_unit

UnitRule = Callable[[Mapping[str, Unit], Mapping[str, Quantity]], Unit]
"""From the units of the inputs, by port, and the parameters as given, to a unit; UnitError if they clash."""


class ToldElsewhere(UnitError):
    """Why there is no unit is what a block's `check` yields."""


@dataclass(frozen=True, slots=True)
class Like:
    """A unit rule: the unit of the input or parameter called `name`, times a fixed one.

    A parameter that is left at a plain number has none. With `apart` it is that
    of a difference: K where the other is in degC.
    """

    name: str
    times: str = ""
    apart: bool = False

    def __call__(self, inputs: Mapping[str, Unit], parameters: Mapping[str, Quantity]) -> Unit:
        """Return the unit."""
        given = parameters.get(self.name)
        unit = inputs.get(self.name, given.unit if given else ONE)
        return (unit.difference if self.apart else unit) * parse_unit(self.times)

    def __str__(self) -> str:
        return f"as {self.name}" + (f" * {self.times}" if self.times else "")


@dataclass(frozen=True, slots=True, kw_only=True)
class BlockInput:
    """A signal that a block reads; one that is not connected is the constant `default`, if it has one.

    `unit` is the unit that the signal must have: a text, a rule, None for any.
    """

    name: str
    meaning: str
    unit: str | UnitRule | None = None
    default: float | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class BlockInputs:
    """Any number of signals under one key, at least `least`; a block type has one such group at most.

    `form` is how they are written: `list`, ["a", "b"], ports 1, 2, ...; `named`,
    { a = "signal" }; `gains`, { signal = gain }, which the kernel gets in
    place of the signs.
    """

    name: str
    meaning: str
    form: str = "list"
    least: int = 1
    unit: str | UnitRule | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class BlockOutput:
    """A signal that a block gives. A block's only output has no name: the signal is called as the block.

    `told_by` is a parameter in the same unit: where the units of a loop follow
    from each other in a circle, it says where to begin.
    """

    name: str = ""
    meaning: str = ""
    unit: str | UnitRule = ""
    told_by: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class BlockParameter:
    """A constant of a block, required where it has no default.

    `kind` is one of KINDS. `unit`, of quantities, lists and tables, is what it
    must convert to: a text, a rule, None for any; a table has one for each
    column in `columns`, and rules know column 0 of `curve` as `curve.0`. Rows
    have `columns` too, None for the unit of the first such cell in the row; or
    they are of any length, in `unit`. A default that is a number is in that
    unit, whatever it is. `minimum`, `maximum` and `above` (exclusive) bound it
    in that unit. With `port` it may also be the name of a signal; the kernel
    then finds it among the inputs.
    """

    name: str
    meaning: str
    kind: str = "quantity"
    unit: str | UnitRule | None = ""
    default: Any = None
    choices: tuple[str, ...] = ()
    columns: tuple[str | UnitRule | None, ...] = ()
    minimum: float | None = None
    maximum: float | None = None
    above: float | None = None
    port: bool = False


KINDS: Mapping[str, str] = {
    "quantity": "a number with its unit",
    "count": "a whole number from 0",
    "choice": "one of some words",
    "truth": "true or false",
    "text": "a text",
    "formula": "a formula",
    "list": "a list of quantities",
    "table": "a list of rows of quantities",
    "rows": "names, each with a list of quantities",
    "units": "names, each with its unit",
    "file": "a file, relative to the file that names it",
}
"""Kinds of parameters. A kernel finds quantities among its numbers, and counts, choices and truths
(by number, 0 or 1) among its words; of the others, a block's `prepare` makes what its kernel needs."""

NUMBERS, WORDS = ("quantity",), ("count", "choice", "truth")
"""Kinds that are laid down for the kernel as they are: as a float, as an integer."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Prepared:
    """What a kernel finds besides the parameters themselves.

    `numbers` stand behind its numbers, `words` behind its words. `states` are
    the initial values of its states; `late` those of its late inputs, 0 unless
    told.
    """

    numbers: Sequence[float] = ()
    words: Sequence[int] = ()
    states: Sequence[float] = ()
    late: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True, slots=True, kw_only=True)
class Misfit:
    """What is wrong with a parameter, and what would be right; `span` where it stands in a file or text."""

    parameter: str
    message: str
    hint: str = ""
    span: Span | None = None
    code: str = "WIR202"


@dataclass(frozen=True, slots=True, kw_only=True)
class BlockType:
    """A kind of block.

    `equation` is the law, then the initial value; `source` where it comes from.
    `kernel` executes it once, given its Row. Its inputs are `inputs`, the
    parameters with `port`, then the signals of `group`, in this order.
    `outputs` may follow from the parameters as given. `states` counts its words
    of memory besides the outputs, all 0 at first; with `prepare` that says.
    `late` are inputs of which the block takes the value of the last scan, so
    that they close no algebraic loop. `check` yields what is wrong with
    parameters beyond their bounds; `legible`, given the parameters as written,
    what is wrong with a file or text, before any unit is looked at.
    `refusal`, given the signals that it read by port, returns the port at which a value
    is of no use, so that the kernel gave NaN, and what that port takes. `events`
    names the numbers of an output `event`, from 1; 0 is none, negative a warning.
    A `device` stands beside the PLC, whose restarts leave it alone.
    """

    name: str
    summary: str
    equation: str
    source: str
    kernel: Callable[..., None] | None
    inputs: tuple[BlockInput, ...] = ()
    group: BlockInputs | None = None
    outputs: tuple[BlockOutput, ...] | Callable[[Mapping[str, Any]], tuple[BlockOutput, ...]] = ()
    parameters: tuple[BlockParameter, ...] = ()
    states: int = 0
    prepare: Callable[[Setting], Prepared] | None = None
    late: tuple[str, ...] | Callable[[Setting], tuple[str, ...]] = ()
    check: Callable[[Setting], Iterator[Misfit]] | None = None
    legible: Callable[[Mapping[str, Any]], Iterator[Misfit]] | None = None
    refusal: Callable[[Mapping[str, float]], tuple[str, str] | None] | None = None
    events: tuple[str, ...] = ()
    device: bool = False

    @property
    def ports(self) -> tuple[BlockParameter, ...]:
        """The parameters that may be signals."""
        return tuple(each for each in self.parameters if each.port)

    @property
    def named_inputs(self) -> tuple[BlockInput | BlockParameter, ...]:
        """The inputs that have names, parameters that may be signals included, in the kernel's order."""
        return (*self.inputs, *self.ports)

    def prepared(self, setting: Setting) -> Prepared:
        """Return what the kernel finds besides parameters."""
        return self.prepare(setting) if self.prepare else Prepared(states=(0.0,) * self.states)

    def late_inputs(self, setting: Setting) -> tuple[str, ...]:
        """Return the inputs that are taken from the last scan; before units are known, values may lack."""
        return self.late(setting) if callable(self.late) else self.late

    def outputs_of(self, parameters: Mapping[str, Any]) -> tuple[BlockOutput, ...]:
        """Return the outputs of a block with these parameters, as given."""
        return self.outputs(parameters) if callable(self.outputs) else self.outputs


@dataclass(frozen=True, slots=True, kw_only=True)
class Family:
    """Block types of one file or folder, by their codes, and the kernel that executes one by its code."""

    name: str
    title: str
    table: tuple[BlockType, ...]
    execute: Callable[..., None] | None
