"""A scenario, read: every variant spelled out, every value with its place in the text."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from fcl_sim.diagnostics import Source, Span
from fcl_sim.judge.temporal.formula import Statement
from fcl_sim.judge.temporal.tree import signals
from fcl_sim.judge.verdict import Over, Relative
from fcl_sim.loop.diagram import Integration, Timing
from fcl_sim.loop.trace import Trace
from fcl_sim.toml.tree import Entry

BASE = "base"
"""The name of the run without a variant."""

CONTROLLER = "controller"
"""What the paths of the controller's blocks, inputs and outputs begin with."""

Entries = Mapping[str, Entry]


@dataclass(frozen=True, slots=True, kw_only=True)
class Axis:
    """One axis of an envelope: the dotted `key` that it sets, its values in order, each with its place."""

    key: str
    values: tuple[Entry, ...]
    span: Span = field(compare=False, repr=False)


@dataclass(frozen=True, slots=True, kw_only=True)
class SourceFile:
    """A file that a scenario was read from: its role, its text, the SHA-256 of its bytes in hex."""

    role: str
    path: Path
    source: Source = field(repr=False)
    digest: str

    @property
    def name(self) -> str:
        """The file, as the user calls it."""
        return self.source.name


@dataclass(frozen=True, slots=True, kw_only=True)
class ControllerSetup:
    """The controller of a run. `inputs` are its units, `wires` what drives them, by input."""

    file: Path
    title: str
    inputs: Entries
    wires: Entries
    outputs: Entries
    span: Span = field(compare=False, repr=False)


@dataclass(frozen=True, slots=True, kw_only=True)
class PlantSetup:
    """The plant of a run, by the name of its model; `name` begins the names of its signals.

    `outputs` and `units` are told of linear plants, which have no file to declare them.
    """

    model: Entry
    name: str
    parameters: Entries
    start: Entries
    inputs: Entries
    span: Span = field(compare=False, repr=False)
    outputs: tuple[Entry, ...] = ()
    units: Entries = field(default_factory=dict)


@dataclass(frozen=True, slots=True, kw_only=True)
class Setup:
    """Everything that one variant says.

    `blocks` has every block by its path: `controller.speed` in the controller,
    `speed` outside of it. `rule_bases` gives the FCL file of each fuzzy block,
    `block_files` every other file that a block names, by block and parameter.
    `references` are the signals that its baseline keeps, where it says so.
    `vary` are the axes of its envelope, the first varying slowest; none where it
    has no envelope. `tree` is what all this was read from.
    """

    variant: str
    title: str
    description: str
    timing: Timing
    integration: Integration
    plant: PlantSetup
    controller: ControllerSetup | None
    blocks: Entries
    rule_bases: Mapping[str, Path]
    block_files: Mapping[tuple[str, str], "SourceFile"] = field(default_factory=dict)
    references: tuple[Entry, ...] | None = None
    tree: Entry = field(compare=False, repr=False)
    vary: tuple[Axis, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class CorridorText:
    """A corridor as written: the signal, and the table with its own units."""

    signal: Entry
    file: Entry
    table: Trace = field(compare=False, repr=False)


@dataclass(frozen=True, slots=True, kw_only=True)
class RequirementText:
    """A requirement as written: numbers still have their own units.

    It has either a `statement`, a formula that was read, or a `corridor`, or a
    `metric` with all that follows it. `runs` are those that it is asked of, `expect`
    those of them that are expected to miss it; `over` and `at_least` say how it
    is held to an envelope.
    `span` is where its id stands, `asked` where its bounds, formula or corridor do.
    """

    id: str
    text: str
    runs: frozenset[str]
    expect: frozenset[str]
    span: Span = field(compare=False, repr=False)
    over: Over = Over.BOTH
    at_least: Entry | None = None
    statement: Statement | None = None
    corridor: CorridorText | None = None
    metric: str = ""
    signal: Entry | None = None
    arguments: Entries = field(default_factory=dict)
    relative_to: Relative | None = None
    minimum: Entry | None = None
    maximum: Entry | None = None
    asked: tuple[Span, ...] = field(default=(), compare=False, repr=False)

    @property
    def names(self) -> tuple[str, ...]:
        """What it is about, as written: signals, and parameters of the plant."""
        if self.statement is not None:
            return tuple(signals(self.statement.tree))
        signal = self.corridor.signal if self.corridor is not None else self.signal
        return () if signal is None else (str(signal.value),)


@dataclass(frozen=True, slots=True, kw_only=True)
class Scenario:
    """A scenario with its variants, the run without one first under `BASE`.

    `files` are the texts it was read from: the scenario, the controllers, the
    rule bases. `bench` is the folder in which its plant is looked up.
    """

    path: Path
    name: str
    title: str
    description: str
    bench: Path
    variants: Mapping[str, Setup]
    requirements: tuple[RequirementText, ...]
    files: tuple[SourceFile, ...]
    overrides: Mapping[str, Any] = field(default_factory=dict)

    @property
    def base(self) -> Setup:
        """The run without a variant."""
        return self.variants[BASE]

    @property
    def digests(self) -> Mapping[str, str]:
        """SHA-256 of each file that was read, by the file's name."""
        return {each.name: each.digest for each in self.files}
