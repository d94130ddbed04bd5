"""The one sequence: read, check, bind, run, judge."""

from collections.abc import Mapping
from dataclasses import dataclass

from fcl_sim.judge.verdict import Status, Verdict
from fcl_sim.loop.diagram import Diagram
from fcl_sim.loop.trace import Trace
from fcl_sim.scenario.model import Scenario

BASE = "base"
"""The name of the run without a variant."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Run:
    """One variant of a scenario, run and judged. `seconds` is the time the simulation took."""

    variant: str
    title: str
    diagram: Diagram
    trace: Trace
    verdicts: tuple[Verdict, ...]
    verdict: Status
    seconds: float

    @property
    def metrics(self) -> Mapping[str, float | None]:
        """Measured value of each requirement, by its id."""
        return {each.requirement.id: each.value for each in self.verdicts}


@dataclass(frozen=True, slots=True, kw_only=True)
class Outcome:
    """A scenario with all its variants, run and judged; the base run stands first."""

    scenario: Scenario
    variants: Mapping[str, Run]
    verdict: Status

    @property
    def base(self) -> Run:
        """The run without a variant."""
        return self.variants[BASE]

    @property
    def trace(self) -> Trace:
        """The base run's trace."""
        return self.base.trace

    @property
    def metrics(self) -> Mapping[str, float | None]:
        """The base run's measured values, by requirement."""
        return self.base.metrics
