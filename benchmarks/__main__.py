"""`python -m benchmarks [--write] [SECTION …]`: print what this machine gives, with what it was measured on.

`--write` measures everything and puts it into docs/speed.md as well.
"""

import sys
from collections.abc import Callable, Iterator

from benchmarks.block import measure_block
from benchmarks.crane_loop import measure_loop
from benchmarks.fixed_loop import measure_fixed
from benchmarks.growth import measure_growth
from benchmarks.many_runs import measure_runs
from benchmarks.page import Section, setting, write
from benchmarks.peers import measure_peers
from benchmarks.start import measure_start

SECTIONS = {
    "block": ("One evaluation, against C", measure_block),
    "loop": ("In closed loop, against C", measure_loop),
    "lag": ("With a fixed step and little else, against C", measure_fixed),
    "runs": ("Many runs", measure_runs),
    "peers": ("Called from Python, against Python", measure_peers),
    "growth": ("Growth with the number of rules", measure_growth),
    "start": ("From the start of a process", measure_start),
}


def main(arguments: list[str]) -> str | None:
    """Measure and print; return what was wrong with the arguments."""
    chosen = [each for each in arguments if each != "--write"]
    if unknown := [each for each in chosen if each not in SECTIONS]:
        return f"there is no section {unknown[0]}; there is {', '.join(SECTIONS)}"
    if chosen and "--write" in arguments:
        return "--write measures all sections"
    print(setting())
    measured = [_printed(*SECTIONS[name]) for name in chosen or SECTIONS]
    if "--write" in arguments:
        write(measured)
    return None


def _printed(title: str, measure: Callable[[], Iterator[str]]) -> Section:
    """Print lines as they are measured; return them."""
    print(f"\n{title}")
    lines = []
    for line in measure():
        what, _, result = line.partition(": ")
        print(f"  {what:55} {result}", flush=True)
        lines.append((what, result))
    return Section(title, tuple(lines))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
