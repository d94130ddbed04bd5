"""`python -m benchmarks [--write] [SECTION …]`: print what this machine gives, with what it was measured on.

`--write` measures everything and puts it into docs/speed.md as well. `--gate
FILE.toml` measures the sections that the file has bounds for, and leaves with 1
where a ratio to C is beyond its bound.
"""

import sys
from collections.abc import Callable, Iterator
from pathlib import Path

from benchmarks.block import measure_block
from benchmarks.crane_loop import measure_loop
from benchmarks.fixed_loop import measure_fixed
from benchmarks.gate import beyond, bounds
from benchmarks.growth import measure_growth
from benchmarks.many_runs import measure_runs
from benchmarks.page import Section, setting, write
from benchmarks.peers import measure_peers
from benchmarks.proof import measure_proof
from benchmarks.start import measure_start
from benchmarks.yardstick import Line

SECTIONS = {
    "block": ("One evaluation, against C", measure_block),
    "loop": ("In closed loop, against C", measure_loop),
    "lag": ("With a fixed step and little else, against C", measure_fixed),
    "runs": ("Many runs", measure_runs),
    "peers": ("Called from Python, against Python", measure_peers),
    "growth": ("Growth with the number of rules", measure_growth),
    "proof": ("Proving a rule base", measure_proof),
    "start": ("From the start of a process", measure_start),
}


def main(arguments: list[str]) -> str | None:
    """Measure and print; return what was wrong with the arguments, or what has become too slow."""
    if arguments[:1] == ["--gate"]:
        return _gate(Path(arguments[1])) if len(arguments) == 2 else "--gate takes one FILE.toml"
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


def _gate(file: Path) -> str | None:
    asked = bounds(file.read_text("utf-8"), SECTIONS)
    print(setting())
    measured = {name: _printed(*SECTIONS[name]) for name in asked}
    failures = [each for name, limits in asked.items() for each in beyond(limits, measured[name].lines)]
    return "\n".join(failures) or None


def _printed(title: str, measure: Callable[[], Iterator[Line | str]]) -> Section:
    """Print lines as they are measured; return them."""
    print(f"\n{title}")
    lines = []
    for line in map(Line.of, measure()):
        print(f"  {line.what:55} {line.result}", flush=True)
        lines.append(line)
    return Section(title, tuple(lines))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
