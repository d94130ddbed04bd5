"""`python -m benchmarks`: print what this machine gives, with what it was measured on."""

import platform
import sys

import numba
import numpy as np

from benchmarks.block import measure_block
from benchmarks.crane_loop import measure_loop
from benchmarks.start import measure_start


def main() -> None:
    """Measure and print."""
    versions = f"Python {platform.python_version()}, numpy {np.__version__}, numba {numba.__version__}"
    print(f"{platform.machine()}, {versions}")
    for line in (*measure_block(), *measure_loop(), *measure_start()):
        print(line, flush=True)


if __name__ == "__main__":
    sys.exit(main())
