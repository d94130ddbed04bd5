"""Where the time of a command went."""

from time import perf_counter

TENTH = 0.05
"""Seconds that are printed as none."""


class Stopwatch:
    """Counts the seconds since it was made, under the names of what was done.

    Where it is told when the command was called, what went before is `starting`.
    """

    def __init__(self, called: float | None = None) -> None:
        self._begun = self._last = perf_counter() if called is None else called
        self._spent: dict[str, float] = {}
        if called is not None:
            self.lap("starting")

    def lap(self, what: str) -> None:
        """Count the time since the last lap as that of `what`."""
        now = perf_counter()
        self._spent[what] = self._spent.get(what, 0.0) + now - self._last
        self._last = now

    def __str__(self) -> str:
        """Return what took time, in its order, and how long it took in all."""
        parts = [f"{what} {seconds:.1f} s" for what, seconds in self._spent.items() if seconds >= TENTH]
        whole = f"{perf_counter() - self._begun:.1f} s"
        return f"{whole}: {', '.join(parts)}" if parts else whole
