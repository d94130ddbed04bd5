"""`python -m tests.kernels`: compile the large kernels that tests share, each once.

In a process that has compiled a kernel, another that calls the same ones is
ready in a tenth of the time. So all that computes in one arithmetic is compiled
by one process, before several of them run the tests.
"""

import sys
from concurrent.futures import ProcessPoolExecutor

from fcl_sim.engine.entries import entries_in
from fcl_sim.jit import Entry
from fcl_sim.loop.blocks.fuzzy import LONG, REAL
from fcl_sim.loop.simulate import simulate

SHARES: dict[str, list[Entry]] = {
    "LREAL": [*entries_in("LREAL"), *LONG.values()],
    "REAL": [*entries_in("REAL"), *REAL.values(), simulate],
}
"""What one process compiles. The loop is as much as the arrays of LREAL are more than those of REAL."""


def compile_share(name: str) -> None:
    """Compile one share, or read it where it is kept."""
    for each in SHARES[name]:
        each.compile()


def main() -> int:
    """Compile all shares."""
    with ProcessPoolExecutor(len(SHARES)) as pool:
        list(pool.map(compile_share, SHARES))
    return 0


if __name__ == "__main__":
    sys.exit(main())
