"""What the one sequence makes: variants that are ready, runs, outcomes of scenarios."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from fcl_sim.envelope.envelope import Envelope
from fcl_sim.envelope.plan import Plan
from fcl_sim.judge.baseline import Baseline, Comparison
from fcl_sim.judge.verdict import Requirement, Status, Verdict
from fcl_sim.loop.diagram import Diagram
from fcl_sim.loop.trace import Trace
from fcl_sim.scenario.model import BASE, Scenario
from fcl_sim.verify.cause import Cause


@dataclass(frozen=True, slots=True, kw_only=True)
class Prepared:
    """A variant that is ready to run: everything that could be wrong with its texts was looked at.

    `baseline` is what it was when somebody last accepted it, `references` the
    signals that a baseline of it is told to keep. Unless `is_compared`, it is
    not held against its baseline.
    """

    variant: str
    title: str
    diagram: Diagram
    requirements: tuple[Requirement, ...]
    baseline: Baseline | None = None
    references: tuple[str, ...] | None = None
    is_compared: bool = False
    envelope: Plan | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Run:
    """One variant of a scenario, run and judged. `seconds` is the time the simulation took.

    `compared` is the run beside its baseline; None where it was not compared,
    as one with overrides is not. `cause` is why it left its baseline, where it did.
    `verdicts` are those on the nominal run, `envelope` has those over the points of
    its grid, where it has one; `verdict` is the gravest of both.
    """

    variant: str
    title: str
    diagram: Diagram
    trace: Trace
    verdicts: tuple[Verdict, ...]
    verdict: Status
    seconds: float
    compared: Comparison | None = None
    cause: Cause | None = None
    envelope: Envelope | None = None

    @property
    def metrics(self) -> Mapping[str, float | None]:
        """Measured value of each requirement, by its id."""
        return {each.requirement.id: each.value for each in self.verdicts}


@dataclass(frozen=True, slots=True, kw_only=True)
class Against:
    """An older version of a scenario: what it is called, and its runs by variant."""

    label: str
    runs: Mapping[str, Run]


@dataclass(frozen=True, slots=True, kw_only=True)
class Outcome:
    """A scenario with all its variants, run and judged; the base run stands first.

    `against` is the older version beside which it is shown, where one was named.
    """

    scenario: Scenario
    variants: Mapping[str, Run]
    verdict: Status
    against: Against | None = None

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


@dataclass(frozen=True, slots=True, kw_only=True)
class Update:
    """The baseline of a run: its file, what it was before, and what it is now."""

    path: Path
    before: Baseline | None
    after: Baseline
