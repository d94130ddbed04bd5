"""Where the boxes and wires of a row of columns stand: between the columns are channels of tracks.

A signal has a track of its own in every channel that it passes, or shares one with
signals that are done with it above or below. What leaves a column, what enters it and
what passes it keep different places on a grid, so that no two signals ever share a line.
All lengths are in mm.
"""

from collections.abc import Container, Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import floor

from fcl_sim.report.wiring_boxes import GRID, PAD, PASSING, Box, Columns

PITCH, MARGIN = 1.8, GRID
CLEAR = 0.6 * GRID
"""What lies on a track between two signals that share it, at least."""


@dataclass(frozen=True, slots=True)
class End:
    """Where a wire leaves a channel: its height, how far it goes, and whether it enters a box there."""

    height: float
    right: float
    enters: bool
    late: bool


@dataclass(frozen=True, slots=True)
class Path:
    """A signal in one channel: where it comes from, its track, where it goes to."""

    signal: str
    left: float
    start: float
    track: float
    ends: tuple[End, ...]

    @property
    def span(self) -> tuple[float, float]:
        """The heights between which it is on its track."""
        heights = [self.start, *(each.height for each in self.ends)]
        return min(heights), max(heights)


@dataclass(frozen=True, slots=True)
class Drawing:
    """A row laid out: boxes, wires, lines that pass a column (signal, height, from, to), its size."""

    boxes: Sequence[Box]
    paths: Sequence[Path]
    passing: Sequence[tuple[str, float, float, float]]
    late: frozenset[str]
    """The signals that are read of the last scan alone."""
    width: float
    height: float


Heights = Mapping[tuple[int, str], float]
"""Where signals pass columns."""


def laid_out(columns: Columns) -> Drawing:
    """Return where everything stands; what a column reads has to leave a box of a column before it."""
    through = [_passing(columns, number) for number in range(len(columns))]
    heights = _stack(columns, through)
    widths = [max((each.width for each in column), default=0.0) for column in columns]
    late = _late(columns)
    left, lines = MARGIN, []
    paths: list[Path] = []
    for number, column in enumerate(columns):
        edge = left + widths[number]
        for box in column:
            box.left = left + (widths[number] - box.width) / 2
        lines += [(signal, heights[number, signal], left, edge) for signal in through[number]]
        left = edge
        if number + 1 < len(columns):
            courses = _ordered(_courses(columns, through, heights, number))
            tracks = _tracks(courses)
            left = edge + (max(tracks, default=0) + 1) * PITCH + 2 * PAD
            for box in columns[number + 1]:
                box.left = left + (widths[number + 1] - box.width) / 2
            for course, track in zip(courses, tracks, strict=True):
                paths.append(_path(course, (edge, edge + PAD + track * PITCH, left), late))
    boxes = [box for column in columns for box in column]
    height = max([each.bottom for each in boxes] + [each + GRID for each in heights.values()]) + MARGIN
    return Drawing(boxes, paths, lines, late, left + MARGIN, height)


def _passing(columns: Columns, number: int) -> list[str]:
    """Return the signals that pass a column: they come from before and are wanted behind it."""
    behind = [box for column in columns[number + 1 :] for box in column]
    before = {port.signal for column in columns[:number] for box in column for port in box.exits}
    read = dict.fromkeys(port.signal for box in behind for port in box.entries)
    return [signal for signal in read if signal in before]


def _stack(columns: Columns, through: Sequence[Sequence[str]]) -> dict[tuple[int, str], float]:
    """Put boxes and passing signals of each column below one another, near what they come from.

    None reaches further down than the fullest column needs. Return the height of each passing signal,
    by column.
    """
    heights: dict[tuple[int, str], float] = {}
    come: dict[str, float] = {}
    stacks: list[list[Box | str]] = [
        [*column, *passing] for column, passing in zip(columns, through, strict=True)
    ]
    filled = [sum(map(_rows, stack)) for stack in stacks]
    for number, column in enumerate(columns):
        items: list[tuple[float, Box | str]] = [(_middle(box, come), box) for box in column]
        items += [(come[signal], signal) for signal in through[number]]
        line, left = 0, filled[number]
        for wish, item in sorted(items, key=lambda each: each[0]):
            rows = _rows(item)
            line = max(line, min(floor((wish - MARGIN) / GRID) - rows // 2, max(filled) - left))
            top = MARGIN + line * GRID
            if isinstance(item, Box):
                item.top = top
                come |= {port.signal: item.exit(index) for index, port in enumerate(item.exits)}
            else:
                taken = {
                    each for (where, name), each in heights.items() if where == number - 1 and name != item
                }
                free = [top + each for each in PASSING if top + each not in taken]
                heights[number, item] = come[item] = come[item] if come[item] in free else free[0]
            line, left = line + rows, left - rows
    return heights


def _rows(item: Box | str) -> int:
    """Return the lines of the grid that a box with its distance, or a passing signal, takes."""
    return item.rows + 1 if isinstance(item, Box) else 1


def _middle(box: Box, come: Mapping[str, float]) -> float:
    places = [come[port.signal] for port in box.entries if port.signal in come]
    return sum(places) / len(places) if places else 0.0


@dataclass(frozen=True, slots=True)
class Course:
    """What a signal has to do in a channel: from which height and, where it leaves one, box, to which."""

    signal: str
    box: Box | None
    start: float
    entered: Sequence[tuple[Box, int]]
    onward: Sequence[float]

    @property
    def ends(self) -> list[float]:
        """The heights that it goes to."""
        return [*(box.entry(index) for box, index in self.entered), *self.onward]


def _courses(
    columns: Columns, through: Sequence[Sequence[str]], heights: Heights, number: int
) -> Iterator[Course]:
    """Yield what the signals of the channel behind a column have to do there."""
    entered: dict[str, list[tuple[Box, int]]] = {}
    for reader in columns[number + 1]:
        for index, port in enumerate(reader.entries):
            entered.setdefault(port.signal, []).append((reader, index))
    given = [
        (port.signal, box, box.exit(index)) for box in columns[number] for index, port in enumerate(box.exits)
    ]
    passing = [(each, None, heights[number, each]) for each in through[number]]
    sources: list[tuple[str, Box | None, float]] = [*given, *passing]
    for signal, box, start in sources:
        onward = [heights[number + 1, signal]] if (number + 1, signal) in heights else []
        if signal and (signal in entered or onward):
            yield Course(signal, box, start, entered.get(signal, []), onward)


def _ordered(courses: Iterator[Course]) -> list[Course]:
    """Return signals in the order of their tracks: those from below turn first where they fall."""
    return sorted(courses, key=lambda each: -each.start if _falls(each) else each.start)


def _falls(course: Course) -> bool:
    ends = [box.entry(index) for box, index in course.entered]
    return not ends or sum(ends) / len(ends) >= course.start


def _tracks(courses: Sequence[Course]) -> list[int]:
    """Return the number of the track of each signal, from 1: behind all before it that it would meet."""
    spans = [(min(each.start, *each.ends), max(each.start, *each.ends)) for each in courses]
    tracks: list[int] = []
    for low, high in spans:
        met = [
            track
            for (lower, higher), track in zip(spans, tracks, strict=False)
            if low < higher + CLEAR and lower < high + CLEAR
        ]
        tracks.append(1 + max(met, default=0))
    return tracks


def _path(course: Course, places: tuple[float, float, float], late: Container[str]) -> Path:
    """Return the wire of a signal; `places` are the channel's left edge, its track and the right edge."""
    left, track, right = places
    ends = [End(box.entry(i), box.left, enters=True, late=box.entries[i].late) for box, i in course.entered]
    ends += [End(each, right, enters=False, late=course.signal in late) for each in course.onward]
    from_ = left if course.box is None else course.box.left + course.box.width
    return Path(course.signal, from_, course.start, track, tuple(ends))


def _late(columns: Columns) -> frozenset[str]:
    ports = [port for column in columns for box in column for port in box.entries if port.signal]
    return frozenset(each.signal for each in ports) - {each.signal for each in ports if not each.late}
