"""Bounds on how many times C's time something may take: ratios within one job, never times of a clock."""

import sys
import tomllib
from collections.abc import Collection, Iterator, Mapping, Sequence

from benchmarks.yardstick import Line
from fcl_sim.diagnostics import nearest

Bounds = Mapping[str, float]
"""The largest ratio to C that is allowed, by what is measured."""


def bounds(text: str, sections: Collection[str]) -> dict[str, Bounds]:
    """Return the bounds of a TOML text by section; leave with a message where it makes no sense."""
    try:
        found = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        sys.exit(f"the bounds are not TOML: {error}")
    for section, limits in found.items():
        if section not in sections:
            sys.exit(f"there is no section {section}{_meant(section, sections)}")
        if not isinstance(limits, dict) or not all(_is_ratio(each) for each in limits.values()):
            sys.exit(f'the bounds of {section} are ratios to C, as in "crane, 60 s, 10 ms scan" = 2.0')
    if not any(found.values()):
        sys.exit("there is no bound: a gate of nothing must not be green")
    return found


def beyond(limits: Bounds, lines: Sequence[Line]) -> Iterator[str]:
    """Yield what is slower than it may be, and what was not measured."""
    ratios = {each.what: each.ratio for each in lines if each.ratio is not None}
    for what, limit in limits.items():
        if what not in ratios:
            yield f"{what}: was not measured{_meant(what, ratios)}"
        elif not ratios[what] <= limit:
            yield f"{what}: {ratios[what]:.2f} times C, and {limit:g} is allowed"


def _is_ratio(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and value > 0.0


def _meant(name: str, names: Collection[str]) -> str:
    near = nearest(name, names)
    return f"; did you mean `{near}`?" if near else f"; there is {', '.join(names)}"
