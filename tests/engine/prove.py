"""`python -m tests.engine.prove [BASES] [FIRST SEED] [ARITHMETIC]`: random rule bases against the oracle.

On all cores. Prints the worst errors, and every base that exceeds what it may.
"""

import sys
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from itertools import count, islice
from os import cpu_count

from fcl_sim.engine.precision import PRECISIONS
from tests.engine.agreement import errors
from tests.engine.random_bases import random_base, random_values

SIZES = (0, 1, 2, 3, 4, 5, 7, 9, 12, 15, 20, 33)
CHUNK = 200

Worst = dict[str, tuple[float, int]]


def prove(first: int, arithmetic: str = "LREAL") -> tuple[int, Worst, list[str]]:
    """Compare one chunk of bases; return how many, the worst error of each kind, and what went wrong."""
    worst: Worst = {}
    wrong = []
    for seed in range(first, first + CHUNK):
        base = random_base(seed, SIZES[seed % len(SIZES)])
        for what, error, bound in errors(base, random_values(seed, base), PRECISIONS[arithmetic]):
            kind = what.split(" by ")[-1] if " by " in what else ""
            part = error / bound if bound > 0.0 else float(error > 0.0)
            if kind:
                worst[kind] = max(worst.get(kind, (0.0, seed)), (part, seed))
            if error > bound:
                wrong.append(f"seed {seed}: {what} is off by {error:.3g}, more than {bound:.3g}")
    return CHUNK, worst, wrong


def main(bases: int | str = 100_000, first: int | str = 0, arithmetic: str = "LREAL") -> int:
    """Compare many bases; return 1 where one exceeds its bound."""
    starts = islice(count(int(first), CHUNK), max(1, int(bases) // CHUNK))
    done, worst, failed = 0, Worst(), False
    with ProcessPoolExecutor(cpu_count()) as pool:
        for number, own, wrong in pool.map(partial(prove, arithmetic=arithmetic), starts):
            done += number
            worst = {kind: max(own.get(kind, (0.0, 0)), worst.get(kind, (0.0, 0))) for kind in {*own, *worst}}
            failed = failed or bool(wrong)
            for line in wrong:
                print(line, flush=True)  # noqa: T201  it is a program
    lines = [f"{done} rule bases in {arithmetic}; largest errors, in parts of what they may be:"]
    lines += [f"  {kind:8} {part:.2g}  (seed {seed})" for kind, (part, seed) in sorted(worst.items())]
    print("\n".join(lines))  # noqa: T201
    return int(failed)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
