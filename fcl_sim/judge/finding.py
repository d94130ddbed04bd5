"""What a run came to in one requirement, before the expectation is looked at."""

from dataclasses import dataclass

from fcl_sim.judge.metric import Limits
from fcl_sim.judge.verdict import Status


@dataclass(frozen=True, slots=True, kw_only=True)
class Finding:
    """Status, number and reason; `limits` and `violation` in seconds of the trace."""

    status: Status
    reason: str
    value: float | None = None
    limits: Limits | None = None
    violation: tuple[float, float] | None = None
    blamed: tuple[str, ...] = ()
