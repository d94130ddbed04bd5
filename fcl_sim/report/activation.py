"""Which rules fire when: a row for each rule, dark where it fires, a line where it dominates."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from fcl_sim.loop.diagram import FuzzyNode
from fcl_sim.loop.trace import FuzzyRecord, Values
from fcl_sim.report import lettering, raster, style
from fcl_sim.report.bands import ABOVE, SHORTEST, Missed, as_seen, draw_above
from fcl_sim.report.canvas import Axes, Figure, Image, Line, Text, joined, span
from fcl_sim.report.frame import draw_frame, draw_scale, room_below, room_left, ticks
from fcl_sim.report.pictures import Picture, numbered
from fcl_sim.report.provenance import fuzzy_nodes
from fcl_sim.report.rules_there import is_at_fault, is_timeless, missed_when
from fcl_sim.report.stretches import stretches
from fcl_sim.report.words import counted, number, one_line, with_unit
from fcl_sim.report.words import joined as listed
from fcl_sim.testbench import Run
from fcl_sim.verify.cover import dominant, rule_text

LABELS, BAR, GAP = 62.0, 3.0, 3.0
"""Width of the rules with their labels, of the scale and before it, in mm."""
NUMBER = 12.0
"""Width of a rule's label in mm, at most."""
TOP = 1.5
ROW = 3.2
"""Height in mm of a row whose text takes a line."""
FURTHER = 0.75
"""What each further line of a text adds, in such rows."""
MOST_ROWS = 60.0
"""Height of a figure in such rows; a page takes no more."""
PIXELS = 4
"""To such a row: the least height is drawn whole."""
COLUMNS = 420
"""Stretches of time of a row: each narrower than the line of a dominant rule is wide."""
LEAST_HEIGHT = 16.0
"""Height in mm that the scale needs."""
SHOWN = 5
"""Rules that an alternative text names as those that dominate longest."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Firing:
    """The rules of a block at n samples: labels, texts, degrees (n, rules), dominance (n, rules)."""

    labels: tuple[str, ...]
    texts: tuple[str, ...]
    time: Values
    degrees: Values
    dominant: NDArray[np.bool_]

    @property
    def idle(self) -> NDArray[np.bool_]:
        """The samples (n,) in which no rule fires."""
        found: NDArray[np.bool_] = ~np.any(self.degrees > 0.0, axis=1)
        return found

    def rows(self, chosen: slice) -> "Firing":
        """Return some of the rules alone."""
        return Firing(
            labels=self.labels[chosen],
            texts=self.texts[chosen],
            time=self.time,
            degrees=self.degrees[:, chosen],
            dominant=self.dominant[:, chosen],
        )


def over_time(run: Run) -> list[Picture]:
    """Return for each fuzzy block of a run which of its rules fire when."""
    return [each for node in fuzzy_nodes(run) for each in _pictures(run, node)]


def _pictures(run: Run, node: FuzzyNode) -> list[Picture]:
    record = run.trace.fuzzy[node.name]
    if not len(run.trace.ticks) or not record.rule_labels:
        return []
    firing, missed = firing_of(node, record, run.trace.time), missed_when(run)
    parted = _parted(firing)
    caption = (
        f"Run {one_line(run.variant)}: the rules of {one_line(node.block.name)} over time, darker the more "
        "they fire; a bright line where a rule dominates."
    )
    if firing.idle.any():
        caption += " Hatched: no rule fires."
    if missed:
        caption += " Bars above: when a requirement is violated; the cause may lie before."
        caption += " Open ones are expected." if any(each.is_meant for each in missed) else ""
    timeless = [one_line(each.requirement.id) for each in run.verdicts if is_timeless(each)]
    if timeless:
        caption += f" Missed as a whole, at no time of its own: {listed(timeless)}."
    if run.trace.fault is not None:
        caption += f" The run ended in a FAULT at {with_unit(run.trace.fault.tick / 1e9, 's', 9)}."
    return [
        Picture(
            name=numbered(f"{run.variant}-{node.name}-activation", page, len(parted)),
            caption=caption + (_which(firing.rows(chosen)) if len(parted) > 1 else ""),
            alt=alt(firing.rows(chosen), missed, firing.idle),
            draw=partial(draw, firing.rows(chosen), idle=firing.idle, missed=missed),
        )
        for page, chosen in enumerate(parted)
    ]


def _which(firing: Firing) -> str:
    return f" Here rules {one_line(firing.labels[0])} to {one_line(firing.labels[-1])}."


def _parted(firing: Firing) -> list[slice]:
    """Return the rules of each figure: as many figures as pages are needed, about alike in height."""
    rows = np.diff(_edges(firing))
    fair = float(rows.sum()) / -(-float(rows.sum()) // MOST_ROWS)
    starts, height = [0], 0.0
    for at, each in enumerate(rows):
        if height and (height >= fair or height + each > MOST_ROWS):
            starts.append(at)
            height = 0.0
        height += float(each)
    return [slice(start, end) for start, end in pairwise([*starts, len(rows)])]


def _edges(firing: Firing) -> Values:
    """Return where the rows of rules begin and end (rules + 1,), in rows of one line."""
    lines = np.array([text.count("\n") for text in _wrapped(firing)], dtype=np.float64)
    return np.concatenate([[0.0], np.cumsum(1.0 + FURTHER * lines)])


def _indent(firing: Firing) -> float:
    """Return the width in mm of the rules' labels, as far as they are shown."""
    names = [lettering.cut(one_line(each), NUMBER / style.HINTED, SIZE) for each in firing.labels]
    return 1.5 + style.HINTED * max(lettering.text_width(each, SIZE, bold=True) for each in names)


def _wrapped(firing: Firing) -> list[str]:
    """Return the texts of rules, in as many lines as they need."""
    room = (LABELS - _indent(firing) - 1.5) / style.HINTED
    return [lettering.wrapped(brief(text), room, SIZE) for text in firing.texts]


def firing_of(node: FuzzyNode, record: FuzzyRecord, time: Values) -> Firing:
    """Return which rules of a block fire when."""
    block = node.block.function_block
    rules = [rule for each in block.rule_blocks for rule in each.rules]
    return Firing(
        labels=record.rule_labels,
        texts=tuple(rule_text(each) for each in rules),
        time=time,
        degrees=record.degrees,
        dominant=dominant(block, record),
    )


def draw(firing: Firing, idle: NDArray[np.bool_], missed: Sequence[Missed] = ()) -> Figure:
    """Return the rows of some rules; `idle` (n,) is where no rule of the block fires.

    `missed` tells when which requirement is violated.
    """
    rows = _edges(firing)
    height = max(ROW * float(rows[-1]), LEAST_HEIGHT)
    levels = ticks(0.0, 1.0, 4)
    bar = GAP + BAR + room_left(levels, "degree [1]")
    top = TOP + ABOVE * len(missed)
    figure = Figure(top + height + room_below("time [s]"))
    axes = figure.place(LABELS, top, style.WIDTH - LABELS - bar, height, "activation")
    begin, end = float(firing.time[0]), float(firing.time[-1])
    axes.x, axes.y = (begin, end if end > begin else begin + 1.0), (float(rows[-1]), 0.0)
    edges = np.linspace(*axes.x, COLUMNS + 1)
    _draw_degrees(axes, firing, edges, rows)
    _draw_dominant(axes, firing, edges, rows)
    for start, stop in stretches(idle):
        across = (float(firing.time[start]), float(firing.time[min(stop, len(idle) - 1)]))
        axes.add(span(axes, as_seen(axes, across, SHORTEST), style.UNDEFINED, hatched=True, z=1.5))
    draw_above(axes, missed)
    draw_frame(axes, ticks(*axes.x, 9), (), ("time [s]", ""), grid=False)
    _draw_texts(axes, firing, rows)
    scale = figure.place(style.WIDTH - bar + GAP, top, BAR, height, "scale")
    scale.add(Image((0.0, 1.0), (0.0, 1.0), raster.scale((1, raster.SHADES), style.FIRING), z=1))
    draw_scale(scale, levels, "degree [1]")
    return figure


def _draw_degrees(axes: Axes, firing: Firing, edges: Values, rows: Values) -> None:
    """Colour each stretch of a row by the largest degree in it; where a rule does not fire is paper."""
    values = _largest(firing.time, firing.degrees, edges)
    values = np.where(values > 0.0, values, np.nan)[::-1]
    upwards = rows[-1] - rows[::-1]
    size = (len(edges) - 1, round(PIXELS * float(rows[-1])))
    png = raster.cells(edges, upwards, values, (0.0, 1.0), size, style.FIRING)
    axes.add(Image(axes.x, (float(rows[-1]), 0.0), png, z=1))
    lines = [np.array([(0.0, place), (1.0, place)]) for place in 1.0 - rows / rows[-1]]
    axes.add(Line(*joined(lines), style.GRID, 0.4, flat=True, z=2, parts=True))


def _largest(time: Values, values: Values, edges: Values) -> Values:
    """Return the largest of values (n, rows) in each stretch between edges, as (rows, stretches).

    A stretch without a sample has what was last before it, as the scans hold it.
    """
    starts = np.clip(np.searchsorted(time, edges[:-1], side="left"), 0, len(time) - 1)
    found = np.maximum.reduceat(values, starts, axis=0)
    held = np.clip(np.searchsorted(time, edges[:-1], side="right") - 1, 0, len(time) - 1)
    empty = np.concatenate([starts[1:], [len(time)]]) <= starts
    result: Values = np.where(empty[:, None], values[held], np.maximum(found, values[held])).T
    return result


def _draw_dominant(axes: Axes, firing: Firing, edges: Values, rows: Values) -> None:
    """Draw a line in the row of a rule over the stretches in which it dominates at any scan."""
    flags = _largest(firing.time, firing.dominant.astype(np.float64), edges) > 0.0
    pieces = [
        np.array([(edges[start], middle), (edges[stop], middle)])
        for middle, own in zip((rows[:-1] + rows[1:]) / 2.0, flags, strict=True)
        for start, stop in stretches(own)
    ]
    if pieces:
        x, y = joined(pieces)
        axes.add(Line(x, y, style.INK, 2.4, flat=True, z=4))
        axes.add(Line(x, y, style.LEADS, 1.2, flat=True, z=4.1, label="dominant"))


def _draw_texts(axes: Axes, firing: Firing, rows: Values) -> None:
    indent, left = _indent(firing), -LABELS / axes.width
    for row, (name, text) in enumerate(zip(firing.labels, _wrapped(firing), strict=True)):
        fired = bool((firing.degrees[:, row] > 0.0).any())
        colour = style.INK if fired else style.FAINT
        y = 1.0 - float(rows[row] + rows[row + 1]) / 2.0 / float(rows[-1])
        label = lettering.cut(one_line(name), NUMBER / style.HINTED, SIZE)
        axes.add(Text(left, y, label, SIZE, colour, up="center", parts=True, bold=fired))
        axes.add(Text(left + indent / axes.width, y, text, SIZE, colour, up="center", parts=True))


SIZE = style.LEAST
"""Of the rules' texts in points; a row is no higher."""


def brief(text: str) -> str:
    """Return a rule without the words that every rule has: `distance far, angle zero: power pos_high`."""
    short = one_line(text).removeprefix("IF ").replace(" IS ", " ").replace(" THEN ", ": ")
    if " OR " in short or "(" in short:  # beside these a comma would seem to bind less than AND
        return short
    return short.replace(" AND ", ", ")


def alt(firing: Firing, missed: Sequence[Missed] = (), idle: NDArray[np.bool_] | None = None) -> str:
    """Return how long the rules fire and dominate, and when requirements are violated, in words.

    `idle` (n,) is where no rule of the block fires, of which these may be some.
    """
    count = len(firing.time)
    fired = (firing.degrees > 0.0).sum(axis=0)
    led = firing.dominant.sum(axis=0)
    order = sorted(range(len(firing.labels)), key=lambda rule: -int(led[rule]))
    told = [_share(firing.labels[rule], int(led[rule]), count) for rule in order[:SHOWN] if led[rule]]
    never = [one_line(firing.labels[rule]) for rule in range(len(firing.labels)) if not fired[rule]]
    begin, end = (number(float(firing.time[at])) for at in (0, -1))
    rules, samples = counted(len(firing.labels), "rule"), counted(count, "sample")
    parts = [f"Degrees of {rules} from {begin} s to {end} s, in {samples}."]
    if told:
        parts.append(f"Longest dominant: {listed(told)}.")
    if never:
        parts.append(f"Rules that never fire: {listed(never)}.")
    none = int((firing.idle if idle is None else idle).sum())
    parts.append(f"No rule fires in {number(100.0 * none / count, 3)} % of the samples." if none else "")
    for each in missed:
        spans = [f"from {number(start)} s to {number(end)} s" for start, end in each.stretches[:SHOWN]]
        more = len(each.stretches) - SHOWN
        rest = [f"{more} times more"] if more > 0 else []
        expected = ", as expected" if each.is_meant else ""
        parts.append(f"{each.label} is violated {listed([*spans, *rest])}{expected}.")
    return " ".join(each for each in parts if each)


def _share(label: str, led: int, count: int) -> str:
    return f"rule {one_line(label)} in {number(100.0 * led / count, 3)} % of the samples"


def telling_runs(runs: Sequence[Run]) -> list[Run]:
    """Return the first run of each rule base, and all that miss a requirement that they are to meet."""
    users = first_users(runs)
    return [run for run in runs if any(run is each for each in users) or is_at_fault(run)]


def first_users(runs: Sequence[Run]) -> list[Run]:
    """Return of each rule base the first run that uses it."""
    found: dict[tuple[str, int], Run] = {}
    for run in runs:
        for node in fuzzy_nodes(run):
            found.setdefault((node.name, hash(node.block.function_block)), run)
    return list({id(run): run for run in found.values()}.values())
