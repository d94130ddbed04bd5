"""`python -m tests.engine.prove [BASES] [FIRST SEED] [PROCESSES]`: random rule bases against the oracle.

Each base is evaluated in LREAL and, with other inputs, in REAL, a few times each; every fourth is
one of operators of the Open Level. Besides, areas under norms of the Open Level
against their formulae, a tenth as many. Prints how far it is every now and
then, every comparison that exceeds what it may, and at last the largest errors
and what the bases made use of.
"""

import sys
from collections import Counter
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, field
from itertools import count, islice
from os import cpu_count
from time import monotonic

from fcl_sim.engine.precision import PRECISIONS
from tests.engine.agreement import errors
from tests.engine.area_norms import TOLERANCE, random_area_errors
from tests.engine.features import features
from tests.engine.random_bases import random_base, random_values

SIZES = (0, 1, 2, 3, 4, 5, 7, 9, 12, 15, 20, 33)
CHUNK = 200
POINTS = 2
"""Evaluations of each base in each arithmetic."""
ROUNDED = 1.1
"""The polyline's tolerance holds for exact numbers; degrees near a jump are rounded."""


@dataclass
class Findings:
    """What was compared, the largest error of each kind in parts of what it may be, and what went wrong."""

    bases: int = 0
    compared: int = 0
    worst: dict[str, tuple[float, float, int]] = field(default_factory=dict)
    used: Counter[str] = field(default_factory=Counter)
    wrong: list[str] = field(default_factory=list)

    def add(self, kind: str, seed: int, what: str, error: float, bound: float) -> None:
        """Take one comparison in."""
        self.compared += 1
        part = error / bound if bound > 0.0 else float(error > 0.0)
        self.worst[kind] = max(self.worst.get(kind, (0.0, 0.0, seed)), (part, error, seed))
        if not error <= bound:
            self.wrong.append(f"seed {seed}: {what} is off by {error:.3g}, more than {bound:.3g} ({kind})")

    def join(self, other: "Findings") -> None:
        """Take what another process found in."""
        self.bases += other.bases
        self.compared += other.compared
        self.used += other.used
        self.wrong += other.wrong
        for kind, each in other.worst.items():
            self.worst[kind] = max(self.worst.get(kind, each), each)


def prove(first: int) -> Findings:
    """Compare one chunk of bases."""
    found = Findings()
    for seed in range(first, first + CHUNK):
        norms = seed % 4 == 3
        base = random_base(seed, SIZES[seed % len(SIZES)], norms=norms)
        found.bases += 1
        found.used.update(features(base))
        for number, (name, precision) in enumerate(PRECISIONS.items()):
            points = [random_values(seed + (POINTS * number + each) * 10**9, base) for each in range(POINTS)]
            for what, error, bound in errors(base, points, precision):
                family = what.split(" by ")[-1] if " by " in what else what.split(" ")[0]
                family = "term" if " IS " in what else "flag" if what.endswith("active") else family
                found.add(f"{name} {'norms ' if norms else ''}{family}", seed, what, error, bound)
        if seed % 10 == 0:
            what, distances = random_area_errors(seed)
            found.used[f"area {what}"] += 1
            found.add("LREAL area under norms", seed, what, distances.max(initial=0.0), ROUNDED * TOLERANCE)
    return found


def main(bases: int | str = 100_000, first: int | str = 0, processes: int | str = 0) -> int:
    """Compare many bases; return 1 where a comparison exceeds its bound."""
    wanted, began = max(1, int(bases) // CHUNK), monotonic()
    found = Findings()
    with ProcessPoolExecutor(int(processes) or cpu_count()) as pool:
        for own in pool.map(prove, islice(count(int(first), CHUNK), wanted)):
            found.join(own)
            print(*own.wrong, sep="\n", end="\n" if own.wrong else "", flush=True)  # noqa: T201  it is a program
            if found.bases % 1000 < CHUNK:
                told = f"{found.bases} rule bases, {found.compared} comparisons, {len(found.wrong)} wrong"
                print(f"{told}, {monotonic() - began:.0f} s", flush=True)  # noqa: T201
    print("\n".join(report(found)))  # noqa: T201
    return int(bool(found.wrong))


def report(found: Findings) -> list[str]:
    """Return the lines at the end."""
    lines = ["what they made use of:"]
    lines += [f"  {what}: {number}" for what, number in sorted(found.used.items())]
    lines.append("largest errors, in parts of what they may be:")
    lines += [
        f"  {kind}: {part:.2g}, that is {error:.2g} (seed {seed})"
        for kind, (part, error, seed) in sorted(found.worst.items())
    ]
    told = f"{found.compared} comparisons, {len(found.wrong)} wrong"
    return [*lines, f"{found.bases} rule bases in LREAL and in REAL: {told}"]


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
