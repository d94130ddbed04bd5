"""Membership functions of every input and output, with the range that runs visited."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from fcl_sim.model import Formula, FunctionBlock, Point, Singleton, Term
from fcl_sim.report import style
from fcl_sim.report.frame import Tick, draw_frame, ticks
from fcl_sim.report.terms import REACH, extent, initials, points_of, settled
from fcl_sim.report.words import bracketed, number, one_line

LEFT, RIGHT = 15.0, 4.0
ACROSS = style.WIDTH - LEFT - RIGHT
HEADING = 4.6
HEIGHT = 17.0
LABEL = 3.1
BAR = 2.9
TICKS = 5.0
GAP = 2.0
TINY = 5.6
DEGREES = (Tick(0.0, "0"), Tick(0.5, "0.5"), Tick(1.0, "1"))
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
    """The axis of one variable: its terms over `low` to `high`."""

    variable: str
    role: str
    unit: str
    terms: Sequence[Term]
    visits: Sequence[Visit]
    low: float
    high: float


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
                terms=[settled(term, start) for term in terms],
                visits=seen,
                low=max(min([low, *(visit.low for visit in seen)]), low - REACH * (high - low)),
                high=min(max([high, *(visit.high for visit in seen)]), high + REACH * (high - low)),
            )
        )
    return result


def membership_plot(shown: Sequence[Panel]) -> Figure:
    """Return the axes of variables one above the other: degree over the variable, terms named above.

    Singletons are stems. A bar below an axis is the range that a run visited.
    """
    with style.styled():
        lanes = [_name_lanes(panel) for panel in shown]
        heights = [
            _height(panel, max(lane.values(), default=0)) for panel, lane in zip(shown, lanes, strict=True)
        ]
        figure = style.blank(sum(heights) + (len(shown) - 1) * GAP)
        top = 0.0
        for panel, lane, height in zip(shown, lanes, heights, strict=True):
            names = LABEL * (max(lane.values(), default=0) + 1)
            axes = style.place(figure, LEFT, top + HEADING + names, ACROSS, HEIGHT)
            _draw_terms(axes, panel, lane)
            _draw_visits(axes, panel)
            _heading(axes, panel, names)
            top += height + GAP
    return figure


def _height(panel: Panel, lane: int) -> float:
    return HEADING + LABEL * (lane + 1) + HEIGHT + TICKS + BAR * len(panel.visits)


def _span(panel: Panel) -> tuple[float, float]:
    margin = MARGIN * (panel.high - panel.low)
    return panel.low - margin, panel.high + margin


def _anchor(term: Term, panel: Panel) -> float:
    """Return where the name of a term stands: the middle of where its degree is largest."""
    if isinstance(term.shape, Singleton):
        return float(term.shape.value)
    points = [(float(point.x), point.degree) for point in points_of(term)]
    peak = max(degree for _, degree in points)
    first = next(index for index, (_, degree) in enumerate(points) if degree == peak)
    last = len(points) - 1 - next(i for i, (_, degree) in enumerate(reversed(points)) if degree == peak)
    low, high = _span(panel)
    left = low if first == 0 else points[first][0]
    right = high if last == len(points) - 1 else points[last][0]
    return (left + right) / 2.0


def _name_lanes(panel: Panel) -> dict[int, int]:
    """Return the lane, from 0 upwards, of each term's name, so that no two names meet."""
    ends: list[float] = []
    lanes: dict[int, int] = {}
    order = sorted(range(len(panel.terms)), key=lambda index: _anchor(panel.terms[index], panel))
    for index in order:
        middle, half = _name_place(panel, index)
        lane = next((lane for lane, end in enumerate(ends) if end < middle - half), len(ends))
        ends[lane : lane + 1] = [middle + half + 2.0]
        lanes[index] = lane
    return lanes


def _name_place(panel: Panel, index: int) -> tuple[float, float]:
    """Return middle and half width of a term's name in mm from the axis' left end, inside its ends."""
    low, high = _span(panel)
    half = style.text_width(_name(panel, index), style.SMALL) / 2.0
    middle = (_anchor(panel.terms[index], panel) - low) / (high - low) * ACROSS
    return min(max(middle, half), ACROSS - half), half


def _name(panel: Panel, index: int) -> str:
    return style.cut(one_line(panel.terms[index].name), ACROSS, style.SMALL)


def _draw_terms(axes: Axes, panel: Panel, lanes: Mapping[int, int]) -> None:
    low, high = _span(panel)
    axes.set_xlim(low, high)
    axes.set_ylim(0.0, 1.04)
    draw_frame(axes, ticks(low, high, 11), DEGREES, ("", "degree [1]"))
    for index, term in enumerate(panel.terms):
        colour, dashes = style.stroke(index)
        if isinstance(term.shape, Singleton):
            at = float(term.shape.value)
            axes.plot([at, at], [0.0, 1.0], color=colour, linewidth=1.1, zorder=3)
            axes.plot([at], [1.0], "o", color=colour, markersize=3.6, clip_on=False, zorder=4)
        else:
            xs, degrees = _line(points_of(term), low, high)
            axes.plot(xs, degrees, color=colour, linestyle=dashes, linewidth=1.1, clip_on=False, zorder=3)
        _draw_name(axes, panel, index, lanes[index], colour)


def _line(points: tuple[Point, ...], low: float, high: float) -> tuple[list[float], list[float]]:
    """Return a membership function from `low` to `high`, without the zeros at its ends."""
    first, last = points[0], points[-1]
    line = [
        (low, first.degree),
        *((float(point.x), point.degree) for point in points),
        (high, last.degree),
    ]
    while len(line) > 2 and line[0][1] == line[1][1] == 0.0:
        del line[0]
    while len(line) > 2 and line[-1][1] == line[-2][1] == 0.0:
        del line[-1]
    return [x for x, _ in line], [degree for _, degree in line]


def _draw_name(axes: Axes, panel: Panel, index: int, lane: int, colour: str) -> None:
    """Write a term's name above the axis, with a leader where the name stands higher or aside."""
    middle, _ = _name_place(panel, index)
    low, high = _span(panel)
    anchor = (_anchor(panel.terms[index], panel) - low) / (high - low)
    foot = 1.0 + (0.9 + LABEL * lane) / HEIGHT
    axes.text(
        middle / ACROSS,
        foot,
        _name(panel, index),
        transform=axes.transAxes,
        ha="center",
        va="bottom",
        fontsize=style.SMALL,
        color=colour,
    )
    if lane:
        axes.plot(
            [anchor, anchor],
            [1.0 / 1.04, foot],
            transform=axes.transAxes,
            color=colour,
            linewidth=0.4,
            clip_on=False,
            zorder=2,
        )


def _draw_visits(axes: Axes, panel: Panel) -> None:
    """Draw a bar for each visit below the axis; its label stands in it, or beside it where there is room."""
    low, high = _span(panel)
    for row, visit in enumerate(panel.visits):
        y = -(TICKS + (row + 0.5) * BAR) / HEIGHT
        left, right = (min(max((x - low) / (high - low), 0.0), 1.0) for x in (visit.low, visit.high))
        axes.plot(
            [left, max(right, left + 0.003)],
            [y, y],
            transform=axes.transAxes,
            color=style.FAINT,
            linewidth=0.85 * BAR / 25.4 * 72.0,
            solid_capstyle="butt",
            clip_on=False,
        )
        label = style.cut(one_line(visit.label), 0.3 * ACROSS, TINY)
        text = f"{label}: {number(visit.low, 3)} … {number(visit.high, 3)}"
        width = (style.text_width(text, TINY) + 2.0) / ACROSS
        x, align, colour = (left + right) / 2.0, "center", style.PAPER
        if width > right - left:
            beside = right + width < 1.0
            x, align, colour = (
                (right + 0.006, "left", style.INK) if beside else (left - 0.006, "right", style.INK)
            )
        axes.text(
            x, y, text, transform=axes.transAxes, fontsize=TINY, ha=align, va="center_baseline", color=colour
        )


def _heading(axes: Axes, panel: Panel, names: float) -> None:
    y = 1.0 + (names + 1.4) / HEIGHT
    text = bracketed(panel.variable, panel.unit)
    axes.text(0.0, y, text, transform=axes.transAxes)
    x = (style.text_width(text) + 3.0) / ACROSS
    axes.text(x, y, panel.role, transform=axes.transAxes, color=style.FAINT, fontsize=style.SMALL)
