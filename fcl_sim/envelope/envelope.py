"""What came of a run over its envelope."""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

from fcl_sim.envelope.grid import Grid
from fcl_sim.judge.envelope import EnvelopeVerdict
from fcl_sim.judge.verdict import Status, Verdict, worst
from fcl_sim.loop.diagram import Diagram
from fcl_sim.loop.trace import Trace, Values


@dataclass(frozen=True, slots=True, kw_only=True)
class PointRun:
    """The run at one point: its number in the grid, where it lies in words, and all that came of it."""

    index: int
    label: str
    diagram: Diagram
    trace: Trace
    verdicts: tuple[Verdict, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Envelope:
    """A run at every point of a grid, judged.

    `worst_runs` are the runs at the worst point of each requirement, by the
    number of the point; the traces of all others are dropped. `seconds` is the
    time that it took.
    """

    grid: Grid
    verdicts: tuple[EnvelopeVerdict, ...]
    worst_runs: Mapping[int, PointRun]
    seconds: float

    def __len__(self) -> int:
        return len(self.grid)

    @property
    def verdict(self) -> Status:
        """The gravest verdict; UNTESTED where nothing is required."""
        return worst([each.status for each in self.verdicts])

    @property
    def points(self) -> tuple[dict[str, Any], ...]:
        """What each point sets, by dotted key, in the order of the grid: overrides that run it alone."""
        return tuple(self.grid.values(index) for index in range(len(self)))

    @property
    def values(self) -> Mapping[str, Values]:
        """Figures of each requirement (N,), by its id, NaN where there is none."""
        return MappingProxyType({each.requirement.id: each.values for each in self.verdicts})
