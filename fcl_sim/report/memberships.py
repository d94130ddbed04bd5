"""Membership functions of every input and output, with the range that runs visited."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Literal

from fcl_sim.model import Formula, FunctionBlock, Singleton, Term
from fcl_sim.report import lettering, style
from fcl_sim.report.canvas import Across, Axes, Dot, Figure, Line, Text, rectangle
from fcl_sim.report.frame import Tick, draw_frame, ticks
from fcl_sim.report.naming import Name, Placed, arranged, draw_names, height_of
from fcl_sim.report.terms import (
    REACH,
    anchor,
    calculated,
    drawn,
    extent,
    initials,
    line_of,
    points_of,
    standing,
)
from fcl_sim.report.words import bracketed, number, one_line

LEFT, RIGHT = 15.0, 4.0
ACROSS = style.WIDTH - LEFT - RIGHT
HEADING = 4.6
HEIGHT = 17.0
BAR = 2.9
LINE = 3.0
TICKS = 5.0
GAP = 2.0
TINY = style.LEAST
DEGREES = (Tick(0.0, "0"), Tick(0.5, "0.5"), Tick(1.0, "1"))
MOST_PANELS = 6
"""Variables to a figure."""
TOP = 1.04
"""Upper end of the axis of degrees."""
MARGIN = 0.06
"""Room beyond the outermost points, where the degree stays constant, as a share of their span."""


@dataclass(frozen=True, slots=True)
class Visit:
    """The range of a variable over a run, in the variable's unit."""

    label: str
    low: float
    high: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Panel:
    """The axis of one variable: its terms, standing, over `low` to `high`.

    `formulae` are those of the terms that have no place before an evaluation.
    """

    variable: str
    role: str
    unit: str
    terms: Sequence[Term]
    visits: Sequence[Visit]
    low: float
    high: float
    formulae: Sequence[str] = ()

    @property
    def bare(self) -> bool:
        """Whether there is nothing to draw over an axis."""
        return bool(self.formulae) and not self.terms and not self.visits


Units = Mapping[str, str]
Visits = Mapping[str, Sequence[Visit]]


def panels(block: FunctionBlock, units: Units | None = None, visits: Visits | None = None) -> list[Panel]:
    """Return the axes of a block, inputs first; `units` and `visits` by variable, letter case ignored."""
    unit_of = {name.casefold(): unit for name, unit in (units or {}).items()}
    visits_of = {name.casefold(): each for name, each in (visits or {}).items()}
    described = [(each.variable, each.terms, "input") for each in block.fuzzifications]
    described += [(each.variable, each.terms, "output") for each in block.defuzzifications]
    start = initials(block)
    result = []
    for variable, described_terms, role in described:
        terms = [term for term in described_terms if not isinstance(term.shape, Formula)]
        seen = visits_of.get(variable.casefold(), ())
        low, high = extent(terms, start)
        result.append(
            Panel(
                variable=variable,
                role=role,
                unit=unit_of.get(variable.casefold(), ""),
                terms=[standing(term, start) for term in terms],
                formulae=[calculated(term) for term in described_terms if isinstance(term.shape, Formula)],
                visits=seen,
                low=max(min([low, *(visit.low for visit in seen)]), low - REACH * (high - low)),
                high=min(max([high, *(visit.high for visit in seen)]), high + REACH * (high - low)),
            )
        )
    return result


def membership_plot(shown: Sequence[Panel]) -> Figure:
    """Return the axes of variables one above the other: degree over the variable, terms named above.

    Singletons are stems. A bar below an axis is the range that a run visited.
    Terms that are formulae are written below.
    """
    shown = [_as_drawn(panel) for panel in shown]
    named = [arranged(_names(panel), ACROSS) for panel in shown]
    rooms = [_room(panel, names) for panel, names in zip(shown, named, strict=True)]
    heights = [_height(panel, room) for panel, room in zip(shown, rooms, strict=True)]
    figure = Figure(sum(heights) + (len(shown) - 1) * GAP)
    top = 0.0
    for panel, names, room, height in zip(shown, named, rooms, heights, strict=True):
        axes = figure.place(LEFT, top + HEADING + room, ACROSS, HEIGHT, panel.variable)
        if not panel.bare:
            _draw_terms(axes, panel)
            draw_names(axes, names, 1.0 / TOP)
            _draw_visits(axes, panel)
        _heading(axes, panel, room)
        _draw_formulae(axes, panel)
        top += height + GAP
    return figure


def parted(shown: Sequence[Panel]) -> list[list[Panel]]:
    """Part variables into figures that fit a page each."""
    parts: list[list[Panel]] = [[]]
    height = 0.0
    for panel in shown:
        names = arranged(_names(_as_drawn(panel)), ACROSS)
        needed = _height(panel, _room(panel, names)) + GAP
        if parts[-1] and (len(parts[-1]) == MOST_PANELS or height + needed > style.TALLEST):
            parts.append([])
            height = 0.0
        parts[-1].append(panel)
        height += needed
    return [part for part in parts if part]


def _as_drawn(panel: Panel) -> Panel:
    return replace(panel, terms=[drawn(term, _span(panel)) for term in panel.terms])


def _room(panel: Panel, names: Sequence[Placed]) -> float:
    """Return the height of the names above an axis in mm; a bare one has none."""
    return 0.0 if panel.bare else height_of(names)


def _height(panel: Panel, names: float) -> float:
    return HEADING + names + _body(panel) + LINE * len(_formulae(panel))


def _body(panel: Panel) -> float:
    """Return the height of an axis with what stands below it, from its upper end; a bare one has none."""
    return 0.0 if panel.bare else HEIGHT + TICKS + BAR * len(panel.visits)


def _formulae(panel: Panel) -> list[str]:
    """Return the lines that tell the terms which are formulae."""
    if not panel.formulae:
        return []
    text = f"Calculated at each evaluation: {'; '.join(panel.formulae)}."
    return lettering.wrapped(text, ACROSS / style.HINTED, style.SMALL).split("\n")


def _draw_formulae(axes: Axes, panel: Panel) -> None:
    for row, line in enumerate(_formulae(panel)):
        y = 1.0 - (_body(panel) + (row + 1) * LINE) / HEIGHT
        axes.add(Text(0.0, y, line, style.SMALL, up="bottom", parts=True))


def _span(panel: Panel) -> tuple[float, float]:
    margin = MARGIN * (panel.high - panel.low)
    return panel.low - margin, panel.high + margin


def _names(panel: Panel) -> list[Name]:
    low, high = _span(panel)
    return [
        Name(one_line(term.name), (anchor(term, low, high) - low) / (high - low), style.stroke(index)[0])
        for index, term in enumerate(panel.terms)
    ]


def _draw_terms(axes: Axes, panel: Panel) -> None:
    low, high = axes.x = _span(panel)
    axes.y = (0.0, TOP)
    draw_frame(axes, ticks(low, high, 11), DEGREES, ("", "degree [1]"))
    for index, term in enumerate(panel.terms):
        colour, dashes = style.stroke(index)
        if isinstance(term.shape, Singleton):
            at = float(term.shape.value)
            axes.add(Line([at, at], [0.0, 1.0], colour, 1.1, z=3, label="stem"))
            axes.add(Dot(at, 1.0, "circle", colour, 4.6, z=4, label="stem"))
        else:
            xs, degrees = line_of(points_of(term), low, high)
            axes.add(Line(xs, degrees, colour, 1.1, dashes, z=3, free=True, label="term"))


def _draw_visits(axes: Axes, panel: Panel) -> None:
    """Draw a bar for each visit below the axis; its label stands in it, or beside it where there is room."""
    low, high = _span(panel)
    for row, visit in enumerate(panel.visits):
        y = -(TICKS + (row + 0.5) * BAR) / HEIGHT
        left, right = (min(max((x - low) / (high - low), 0.0), 1.0) for x in (visit.low, visit.high))
        half = 0.85 * BAR / HEIGHT / 2.0
        ends = (left, max(right, left + 0.003))
        axes.add(rectangle(ends, (y - half, y + half), style.FAINT, parts=True, free=True))
        for end, is_beyond, kind in _ends(visit, low, high):
            if is_beyond:
                axes.add(Dot(end, y, kind, style.FAINT, 5.0, parts=True, free=True, label="beyond"))
        label = lettering.cut(one_line(visit.label), 0.3 * ACROSS, TINY)
        text = f"{label}: {number(visit.low, 3)} … {number(visit.high, 3)}"
        width = (lettering.text_width(text, TINY) + 2.0) / ACROSS
        across: Across
        x, across, colour = (left + right) / 2.0, "center", style.PAPER
        if width > right - left:
            beside = right + width < 1.0
            x, across, colour = (
                (right + 0.006, "left", style.INK) if beside else (left - 0.006, "right", style.INK)
            )
        axes.add(Text(x, y, text, TINY, colour, across=across, up="middle", parts=True, z=3))


def _ends(visit: Visit, low: float, high: float) -> Iterator[tuple[float, bool, Literal["left", "right"]]]:
    """Yield both ends of an axis from `low` to `high`, and whether a visit goes beyond it."""
    yield 0.0, visit.low < low, "left"
    yield 1.0, visit.high > high, "right"


def _heading(axes: Axes, panel: Panel, names: float) -> None:
    y = 1.0 + (names + 1.4) / HEIGHT
    text = bracketed(panel.variable, panel.unit)
    x = (lettering.text_width(text) + 3.0) / ACROSS
    axes.add(Text(0.0, y, text, parts=True), Text(x, y, panel.role, style.SMALL, style.FAINT, parts=True))
