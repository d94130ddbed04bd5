"""A loop in the hand: run it scan by scan from Python, look at every signal, force one."""

from collections.abc import Mapping
from dataclasses import dataclass
from math import isfinite, nan
from types import MappingProxyType

from fcl_sim.diagnostics import InputFault, nearest
from fcl_sim.diagnostics.spelling import listed
from fcl_sim.loop.run import empty_record, proceed, trace_of
from fcl_sim.loop.state import RunState, initial_state
from fcl_sim.loop.tape import lower
from fcl_sim.loop.trace import Trace, Values
from fcl_sim.loop.wiring import Wiring
from fcl_sim.loop.work import SAMPLES
from fcl_sim.units import UnitError, parse_quantity


@dataclass(frozen=True, eq=False)
class SavedLoop:
    """A loop as it was between two scans: its run, the samples up to there, what was forced."""

    run: RunState
    record: Values
    forced: Mapping[str, float]


class OpenLoop:
    """A closed loop that runs on by so many scans at a time.

    `loop["crane.angle"]` is the value of a signal of the last scan, in its unit
    `loop.units["crane.angle"]`; before the first scan what memory begins with. An
    input of the plant is as it was written last, after the latency of that scan.
    """

    def __init__(self, wiring: Wiring, run: int = 0) -> None:
        self._wiring, self._number = wiring, run
        self._tape = lower(wiring, run)
        self._run = initial_state(self._tape)
        self._record = empty_record(self._tape)
        self._forced: dict[str, float] = {}

    def scan(self, count: int = 1) -> int:
        """Run so many scans, or what is left of them; return how many were run.

        InputFault where a function of the user's fails; ValueError for a negative
        count. A run that cannot go on stays where it is, and `trace.fault` says why.
        """
        if count < 0:
            raise ValueError(f"{count} scans cannot be run")
        before = self._samples
        proceed(self._tape, self._run, self._record, self._run.scan + count)
        return self._samples - before

    def force(self, name: str, value: float | str) -> None:
        """Give a signal a value that it keeps whatever drives it, until it is released.

        A text is a quantity in any unit that converts. A forced block still
        executes, and what it remembers goes on. An output of the plant is forced as
        the blocks see it; an input of the plant at once, everything else from the
        next scan on. A name that stands for another signal forces that one.
        InputFault where there is no such signal or the unit does not fit; ValueError
        where the value is not finite.
        """
        source, sign = self._source(name)
        number = sign * self._number_of(name, value)
        self._forced[source] = number
        self._run.memory[self._tape.slots[source]] = number
        self._lower()

    def release(self, *names: str) -> None:
        """Let signals be driven again, all of them where none is named.

        InputFault for one that does not exist. An input of the plant follows with the next write.
        """
        for source in [self._source(name)[0] for name in names] or list(self._forced):
            self._forced.pop(source, None)
        self._lower()

    @property
    def forced(self) -> Mapping[str, float]:
        """The signals that are forced, each with its value in its unit."""
        return MappingProxyType(dict(self._forced))

    @property
    def names(self) -> tuple[str, ...]:
        """The names of all signals."""
        return tuple(self._wiring.units)

    @property
    def units(self) -> Mapping[str, str]:
        """The unit of each signal."""
        return MappingProxyType({name: unit.symbol for name, unit in self._wiring.units.items()})

    def __getitem__(self, name: str) -> float:
        """Return the value of a signal; InputFault with the nearest name where there is none."""
        source, sign = self._source(name)
        return sign * float(self._run.memory[self._tape.slots[source]])

    @property
    def values(self) -> Mapping[str, float]:
        """The value of every signal."""
        return MappingProxyType({name: self[name] for name in self.names})

    @property
    def time(self) -> float:
        """Time of the last scan in seconds, NaN before the first."""
        return float(self._tape.starts[self._samples - 1] / 1e9) if self._samples else nan

    @property
    def over(self) -> bool:
        """Whether all scans were run, or the run cannot go on."""
        return self._run.over or self._run.scan >= self._tape.starts.size

    @property
    def trace(self) -> Trace:
        """The samples of all scans that were run."""
        return trace_of(self._tape, self._run, self._record[: self._samples].copy())

    @property
    def state(self) -> SavedLoop:
        """The loop as it stands, which going on leaves alone."""
        return SavedLoop(self._run.copy(), self._record[: self._samples].copy(), dict(self._forced))

    def restore(self, saved: SavedLoop) -> None:
        """Go back to a state of this loop."""
        self._run = saved.run.copy()
        self._record[: len(saved.record)] = saved.record
        self._forced = dict(saved.forced)
        self._lower()

    @property
    def _samples(self) -> int:
        return int(self._run.progress[SAMPLES])

    def _lower(self) -> None:
        """Make the tape anew: a forced signal is a row of it, so that nothing is asked in a loop without."""
        self._tape = lower(self._wiring, self._number, self._forced)

    def _source(self, name: str) -> tuple[str, float]:
        if name not in self._wiring.units:
            near = nearest(name, self.names)
            hint = f"did you mean `{near}`?" if near else f"there are {listed(sorted(self.names))}"
            raise InputFault.at_file("WIR102", "", f"there is no signal called `{name}`", hint)
        alias = self._wiring.sources.get(name)
        return (alias.source, alias.sign) if alias else (name, 1.0)

    def _number_of(self, name: str, value: float | str) -> float:
        unit = self._wiring.units[name]
        try:
            number = parse_quantity(value).to(unit) if isinstance(value, str) else float(value)
        except UnitError as error:
            message = f"`{name}` cannot be forced to {value}: {error}"
            raise InputFault.at_file("WIR201", "", message, error.hint) from error
        if not isfinite(number):
            raise ValueError(f"`{name}` cannot be forced to {value}")
        return number
