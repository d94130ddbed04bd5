"""What a run leaves behind: every signal at every scan."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

Values = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class FuzzyRecord:
    """A fuzzy block over a run of n samples.

    `inputs` (n, inputs) and `outputs` (n, outputs) are what it read and gave;
    `degrees` (n, rules) each rule's degree of firing after aggregation;
    `flags` (n, outputs) are not 0 where any rule was active for the output. `cold` are
    the samples, besides the first, before which it was set to its initial
    state; `units` the units of its variables, `1` where none is told.
    """

    input_names: tuple[str, ...]
    output_names: tuple[str, ...]
    rule_labels: tuple[str, ...]
    inputs: Values
    outputs: Values
    degrees: Values
    flags: NDArray[Any]
    cold: tuple[int, ...] = ()
    units: Mapping[str, str] = field(default_factory=dict)

    @property
    def active(self) -> NDArray[np.bool_]:
        """Whether any rule was active, (n, outputs)."""
        found: NDArray[np.bool_] = self.flags != 0.0  # of a long run it costs as much as a tenth of the run
        return found

    def previous(self, initial: Values) -> Values:
        """Return the outputs (n, outputs) before each sample, `initial` (outputs,) where it began anew."""
        before = np.vstack([initial[None, :], self.outputs])[: len(self.outputs)]
        before[list(self.cold)] = initial
        return before


@dataclass(frozen=True, slots=True)
class Fault:
    """Why a run ended early: the time in nanoseconds, the signal or state, the reason in words."""

    tick: int
    signal: str
    reason: str


@dataclass(frozen=True, slots=True)
class BlockEvent:
    """What a block reported, as a PLC enters it into its diagnostic buffer: the first of scans in a row.

    `tick` is the time in nanoseconds, `name` that of the event; with a `warning` the block ran.
    """

    tick: int
    block: str
    name: str
    warning: bool


@dataclass(frozen=True, slots=True)
class Incident:
    """Something that happened to the PLC: the time in nanoseconds, `restart` or `overrun`, a few words."""

    tick: int
    kind: str
    text: str


@dataclass(frozen=True, eq=False)
class Trace:
    """Samples of one run, at its scans, the end included.

    `ticks` (n,) nanoseconds; `values` (n, signals) in the order of `names`, of a run a part of its record;
    `units` the unit of each signal. `fault` is set when the run ended early;
    the samples up to there are kept. `events` are what blocks reported, in the order of time,
    `incidents` the restarts and overruns of the PLC. `constants` are numbers that have a
    name as signals have: the parameters of the plant.
    """

    ticks: NDArray[np.int64]
    names: tuple[str, ...]
    units: Mapping[str, str]
    values: Values
    fuzzy: Mapping[str, FuzzyRecord] = field(default_factory=dict)
    fault: Fault | None = None
    events: tuple[BlockEvent, ...] = ()
    incidents: tuple[Incident, ...] = ()
    constants: Mapping[str, float] = field(default_factory=dict)

    @property
    def events_by_kind(self) -> tuple[tuple[BlockEvent, ...], ...]:
        """The events, those of one block and name together, by the time of the first."""
        kinds: dict[tuple[str, str], list[BlockEvent]] = {}
        for each in self.events:
            kinds.setdefault((each.block, each.name), []).append(each)
        return tuple(map(tuple, kinds.values()))

    @property
    def time(self) -> Values:
        """Times of the samples in seconds, (n,)."""
        return self.ticks / 1e9

    def __contains__(self, name: str) -> bool:
        return name in self.units or name in self.constants

    def __getitem__(self, name: str) -> Values:
        """Return the samples (n,) of the signal `name`, or the constant; KeyError where there is none."""
        if name in self.constants:
            return np.full(self.ticks.size, self.constants[name])
        if name not in self.units:
            raise KeyError(name)
        return self.values[:, self.names.index(name)]
