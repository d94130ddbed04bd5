"""What happened during a run, as marks over time: what blocks reported, restarts and overruns of the PLC."""

from dataclasses import dataclass

from fcl_sim.loop.trace import Trace
from fcl_sim.report.words import one_line

MOST = 12
"""Marks of a figure; of more, each kind has its first alone."""


@dataclass(frozen=True, slots=True)
class Mark:
    """What happened at a time, in seconds, in a few words."""

    time: float
    text: str


def marks_of(trace: Trace) -> list[Mark]:
    """Return what happened in a run, in the order of time; of many of a kind the first, with their number."""
    found: dict[str, list[int]] = {}
    for event in trace.events:
        found.setdefault(one_line(f"{event.block}: {event.name}"), []).append(event.tick)
    for incident in trace.incidents:
        found.setdefault(one_line(incident.kind), []).append(incident.tick)
    several = sum(map(len, found.values())) > MOST
    marks = []
    for text, ticks in found.items():
        if several and len(ticks) > 1:
            marks.append(Mark(min(ticks) / 1e9, f"{text}, first of {len(ticks)}"))
        else:
            marks += [Mark(tick / 1e9, text) for tick in ticks]
    return sorted(marks, key=lambda each: each.time)[:MOST]
