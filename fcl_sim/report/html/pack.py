"""Numbers → text that stands in a page: of each signal what the eye sees, in 16 bits, deflated, in base64.

A pack is, deflated: the length of the document in bytes (4, the lowest first),
the document as JSON, the numbers. `data.js` reads it. A series of numbers is
there as the differences of its 16-bit steps, folded to be positive, first
the lower bytes of all, then the upper ones; before them, where samples are left
out, the distances of those that are kept, in the same way. Times are whole
nanoseconds, exactly: what is judged at an instant is looked at there.
"""

import base64
import json
import zlib
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fcl_sim.loop.trace import Values
from fcl_sim.report.time_plots import thinned

Json = dict[str, Any]

STEPS = 0xFFFE
"""Steps from the least to the largest number of a series."""

LEVEL = 6
"""How hard the numbers are deflated: more takes three times as long for a hundredth."""

NONE = 0xFFFF
"""Stands for what is not finite."""


class Pack:
    """Collects numbers, each series once.

    A series longer than three times `stretches` is kept as its first, least
    and largest sample in each of so many stretches of time.
    """

    def __init__(self, stretches: int) -> None:
        self.stretches = stretches
        self._body = bytearray()
        self._series: list[Json] = []
        self._known: dict[tuple[bytes, bool], int] = {}
        self._clocks: dict[bytes, Json] = {}

    def series(self, values: Values, *, whole: bool = False) -> int:
        """Take a series (n,); return its number. A `whole` one is kept as it is."""
        key = (np.ascontiguousarray(values).tobytes(), whole)
        if key not in self._known:
            self._known[key] = len(self._series)
            self._series.append(self._packed(values, len(values) if whole else self.stretches))
        return self._known[key]

    def times(self, ticks: NDArray[np.int64]) -> Json:
        """Take the times (n,) of samples in nanoseconds, which rise; return how to have them again, exactly.

        They begin at `begin` and go on by `step`. Where steps differ, as by jitter or a
        restart, `folded` says in as many bytes as are needed how much longer or
        shorter than `step` each is, in parts of `grain`.
        """
        begin = int(ticks[0]) if len(ticks) else 0
        steps = np.diff(ticks)
        made = {"begin": begin, "step": int(np.sort(steps)[len(steps) // 2]) if len(steps) else 0}
        more = steps - made["step"]
        if more.any():
            key = steps.tobytes()
            if key not in self._clocks:
                self._clocks[key] = self._folded_steps(more)
            made |= self._clocks[key]
        return made | {"count": len(ticks)}

    def _folded_steps(self, more: NDArray[np.int64]) -> Json:
        grain = int(np.gcd.reduce(more))
        own = more // grain
        folded = (own << 1) ^ (own >> 63)
        size = (int(folded.max()).bit_length() + 7) // 8
        planes = folded.astype("<i8").view(np.uint8).reshape(-1, 8)[:, :size].T
        return {"grain": grain, "folded": self.plain(np.ascontiguousarray(planes))}

    def plain(self, values: NDArray[np.uint8]) -> list[int]:
        """Take bytes as they are; return where they begin and how many they are."""
        begin = len(self._body)
        self._body += values.tobytes()
        return [begin, values.size]

    def _packed(self, values: Values, stretches: int) -> Json:
        if values.size and (values == values[0]).all() and np.isfinite(values[0]):
            return {"constant": float(values[0])}
        kept, seen = thinned(np.arange(len(values), dtype=np.float64), values, stretches)
        finite = np.isfinite(seen)
        low, high = (float(seen[finite].min()), float(seen[finite].max())) if finite.any() else (0.0, 0.0)
        with np.errstate(all="ignore"):  # a span of almost nothing, or of more than a number holds
            share = (np.where(finite, seen, low) / 2.0 - low / 2.0) / (high / 2.0 - low / 2.0)
        steps = np.where(finite, np.nan_to_num(share) * STEPS + 0.5, NONE).astype(np.int64)
        made = {"begin": len(self._body), "count": len(seen), "low": low, "high": high}
        if len(seen) < len(values):
            made["thinned"] = True
            self._body += _folded(kept.astype(np.int64))
        self._body += _folded(steps)
        return made

    def text(self, document: Json) -> str:
        """Return a document with the numbers that it names."""
        whole = json.dumps(document | {"series": self._series}, ensure_ascii=False, allow_nan=False)
        head = whole.encode("utf-8")
        packed = zlib.compress(len(head).to_bytes(4, "little") + head + self._body, LEVEL)
        return base64.b64encode(packed).decode("ascii")


def _folded(values: NDArray[np.int64]) -> bytes:
    """Return the differences modulo 2**16: 0, −1, 1, −2 ... as 0, 1, 2, 3 ..., lower bytes first."""
    steps = np.diff(values, prepend=0).astype(np.int16)
    positive = ((steps << 1) ^ (steps >> 15)).astype("<u2")
    return positive.view(np.uint8).reshape(-1, 2).T.tobytes()
