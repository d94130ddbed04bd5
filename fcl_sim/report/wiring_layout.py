"""Where the boxes and wires of a wiring stand: columns of boxes, and between them channels of tracks.

Boxes stand in the order of the scan: the plant as it is read, then each block one
column behind the last of its sources, then the plant as it is written. A constant
stands where it is read. A signal has a track of its own in every channel that it
passes. What leaves a column, what enters it and what passes it keep different
places on a grid, so that no two signals ever share a line. All lengths are in mm.
"""

from collections.abc import Container, Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import floor

from fcl_sim.loop.diagram import Node, Wire
from fcl_sim.loop.settings import AnyNode, signals_of, waits_for
from fcl_sim.loop.wiring import Wiring
from fcl_sim.report.constants import told
from fcl_sim.report.lettering import text_width
from fcl_sim.report.style import HINTED, NORMAL, SMALL

GRID = 3.5
ENTRY, PASSING = 0.5 * GRID, (0.25 * GRID, 0.75 * GRID)
"""How far below the grid wires enter a box, and where they may pass a column; they leave a box on it."""
HEAD = 3
"""Lines of a box above its ports."""
PITCH, MARGIN, PAD = 1.8, GRID, 1.4

READ, WRITTEN = "read", "written"


@dataclass(frozen=True, slots=True)
class Port:
    """A place where a signal enters or leaves a box; `signal` is empty where no wire is drawn.

    `late` says that what enters is of the last scan.
    """

    text: str
    signal: str = ""
    late: bool = False


@dataclass(slots=True, kw_only=True)
class Box:
    """A block, the plant's outputs or its inputs; `top` and `left` are its upper left corner."""

    title: str
    text: str
    kind: str
    column: int
    entries: Sequence[Port] = ()
    exits: Sequence[Port] = ()
    left: float = 0.0
    top: float = 0.0

    @property
    def width(self) -> float:
        """Its width, which its texts need."""
        ports = max((text_width(each.text, SMALL) for each in self.entries), default=0.0)
        ports += max((text_width(each.text, SMALL) for each in self.exits), default=0.0) + 2 * PAD
        texts = (text_width(self.title, NORMAL), text_width(self.text, SMALL), ports)
        return max(texts) * HINTED + 2 * PAD

    @property
    def rows(self) -> int:
        """Its height in lines of the grid."""
        return HEAD + max(len(self.entries), len(self.exits), 1)

    @property
    def bottom(self) -> float:
        """Its lower edge."""
        return self.top + self.rows * GRID

    def entry(self, index: int) -> float:
        """Return the height at which an entry stands."""
        return self.top + (HEAD + index - 1) * GRID + ENTRY

    def exit(self, index: int) -> float:
        """Return the height at which an exit stands."""
        return self.top + (HEAD + index) * GRID


@dataclass(frozen=True, slots=True)
class Path:
    """A signal in one channel: where it comes from, its track, where it goes to."""

    signal: str
    left: float
    start: float
    track: float
    right: float
    ends: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class Drawing:
    """A wiring laid out: boxes, wires, lines that pass a column (signal, height, from, to), its size."""

    boxes: Sequence[Box]
    paths: Sequence[Path]
    passing: Sequence[tuple[str, float, float, float]]
    width: float
    height: float

    @property
    def late(self) -> frozenset[str]:
        """The signals that are read of the last scan alone."""
        entries = [port for box in self.boxes for port in box.entries if port.signal]
        prompt = {port.signal for port in entries if not port.late}
        return frozenset(port.signal for port in entries) - prompt


def laid_out(wiring: Wiring) -> Drawing:
    """Return where everything stands."""
    boxes = _boxes(wiring)
    last = boxes[-1].column
    columns = [[each for each in boxes if each.column == number] for number in range(last + 1)]
    through = [_passing(boxes, number) for number in range(last + 1)]
    heights = _stack(columns, through)
    left, lines = MARGIN, []
    paths: list[Path] = []
    for number, column in enumerate(columns):
        width = max((each.width for each in column), default=0.0)
        for box in column:
            box.left = left + (width - box.width) / 2
        lines += [(signal, heights[number, signal], left, left + width) for signal in through[number]]
        edge = left + width
        if number < last:
            signals = _crossing(columns, through, number)
            left = edge + (len(signals) + 1) * PITCH + 2 * PAD
            paths += _channel(columns, heights, number, signals, (edge, left))
        else:
            left = edge
    height = max([each.bottom for each in boxes] + [each + GRID for each in heights.values()]) + MARGIN
    return Drawing(boxes, paths, lines, left + MARGIN, height)


def _boxes(wiring: Wiring) -> list[Box]:
    plant = wiring.diagram.plant
    names = [f"{plant.name}.{each.name}" for each in plant.model.declaration.outputs]
    read = {wiring.resolve(each).source for node in wiring.order for each in node.inputs.values()}
    names += [name for name in plant.signals if name in read and name not in names]
    constants = _constants(wiring)
    columns = dict.fromkeys((*names, *constants), 0)
    written = wiring.diagram.timing.latency
    exits = [_exit(wiring, name, name.removeprefix(f"{plant.name}.")) for name in names]
    boxes = [Box(title=plant.name, text="read", kind=READ, column=0, exits=exits)]
    for number, node in enumerate(wiring.order, start=1):
        if node.name in constants:
            continue
        prompt = waits_for(node, wiring.diagram.timing)
        sources = [wiring.resolve(each).source for each in prompt]
        column = 1 + max((columns[each] for each in sources), default=0)
        columns |= dict.fromkeys(signals_of(node), column)
        before = {signal for signal, other in columns.items() if other < column}
        boxes.append(_block(wiring, number, node, column, prompt, before))
    taken = [_entry(wiring, port, each) for port, each in plant.inputs.items()]
    for box in boxes:
        box.entries = [_told(each, constants) for each in box.entries]
    taken = [_told(each, constants) for each in taken]
    told = f"written {written / 1e6:g} ms later" if written else "written"
    last = 1 + max(each.column for each in boxes)
    return [*boxes, Box(title=plant.name, text=told, kind=WRITTEN, column=last, entries=taken)]


def _block(
    wiring: Wiring, number: int, node: AnyNode, column: int, prompt: Sequence[Wire], before: Container[str]
) -> Box:
    """Return a block; `prompt` are its wires of this scan, `before` the signals that stand before it."""
    kind = getattr(node, "type", "fuzzy")
    signals = signals_of(node)
    exits = [_exit(wiring, each, each.removeprefix(node.name).removeprefix(".")) for each in signals]
    entries = [
        _entry(wiring, port, each)
        if any(each is other for other in prompt)
        else _late_entry(wiring, port, each, before)
        for port, each in node.inputs.items()
    ]
    place = "inside" if node.name.startswith(wiring.diagram.plc) else "beside"
    return Box(
        title=f"{number}  {node.name}", text=kind, kind=place, column=column, entries=entries, exits=exits
    )


def _constants(wiring: Wiring) -> dict[str, str]:
    """Return the constants that anything reads, each with its value."""
    wires = [each for node in wiring.order for each in node.inputs.values()]
    wires += wiring.diagram.plant.inputs.values()
    read = {wiring.resolve(each).source for each in wires}
    return {
        node.name: told(node.parameters["value"])
        for node in wiring.order
        if isinstance(node, Node) and node.type == "constant" and node.name in read
    }


def _told(port: Port, constants: Mapping[str, str]) -> Port:
    """Return a port, with what it reads where that is a constant."""
    if port.signal not in constants:
        return port
    name = port.signal.rpartition(".")[2]
    between = "" if port.text == name else f" ← {name}"
    return Port(f"{port.text}{between} = {constants[port.signal]}")


def _exit(wiring: Wiring, signal: str, name: str) -> Port:
    return Port(f"{name} [{wiring.units[signal].symbol or '1'}]".strip(), signal)


def _entry(wiring: Wiring, port: str, wire: Wire) -> Port:
    resolved = wiring.resolve(wire)
    return Port(f"{'−' if resolved.sign < 0 else ''}{port}", resolved.source)


def _late_entry(wiring: Wiring, port: str, wire: Wire, before: Container[str]) -> Port:
    """Return an entry for a signal of the last scan, which is named where its wire would run back."""
    prompt = _entry(wiring, port, wire)
    if prompt.signal in before:
        return Port(f"{prompt.text} (last)", prompt.signal, late=True)
    return Port(f"{prompt.text} ← last {prompt.signal}", late=True)


def _source(boxes: Sequence[Box]) -> Mapping[str, Box]:
    return {port.signal: box for box in boxes for port in box.exits}


def _passing(boxes: Sequence[Box], number: int) -> list[str]:
    """Return the signals that pass a column: they come from before and are wanted behind it."""
    wanted = {port.signal: 0 for box in boxes for port in box.entries if port.signal and box.column > number}
    sources = _source(boxes)
    return [signal for signal in wanted if sources[signal].column < number]


def _crossing(columns: Sequence[Sequence[Box]], through: Sequence[Sequence[str]], number: int) -> list[str]:
    """Return the signals of the channel behind a column."""
    wanted = {port.signal for box in columns[number + 1] for port in box.entries} | {*through[number + 1]}
    given = [port.signal for box in columns[number] for port in box.exits]
    return [each for each in (*given, *through[number]) if each in wanted]


def _stack(
    columns: Sequence[Sequence[Box]], through: Sequence[Sequence[str]]
) -> dict[tuple[int, str], float]:
    """Put boxes and passing signals of each column below one another, near what they come from.

    Return the height of each passing signal, by column.
    """
    heights: dict[tuple[int, str], float] = {}
    come: dict[str, float] = {}
    for number, column in enumerate(columns):
        items: list[tuple[float, Box | str]] = [(_middle(box, come), box) for box in column]
        items += [(come[signal], signal) for signal in through[number]]
        line = 0
        for wish, item in sorted(items, key=lambda each: each[0]):
            rows = item.rows + 1 if isinstance(item, Box) else 1
            line = max(line, floor((wish - MARGIN) / GRID) - rows // 2)
            top = MARGIN + line * GRID
            if isinstance(item, Box):
                item.top = top
                come |= {port.signal: item.exit(index) for index, port in enumerate(item.exits)}
            else:
                taken = {
                    each for (column, name), each in heights.items() if column == number - 1 and name != item
                }
                free = [top + each for each in PASSING if top + each not in taken]
                heights[number, item] = come[item] = come[item] if come[item] in free else free[0]
            line += rows
    return heights


def _middle(box: Box, come: Mapping[str, float]) -> float:
    places = [come[port.signal] for port in box.entries if port.signal in come]
    return sum(places) / len(places) if places else 0.0


def _channel(
    columns: Sequence[Sequence[Box]],
    heights: Mapping[tuple[int, str], float],
    number: int,
    signals: Sequence[str],
    edges: tuple[float, float],
) -> Iterator[Path]:
    """Yield the signals of the channel behind a column; those from below turn first where they rise."""
    found = []
    for signal in signals:
        passing = heights.get((number, signal))
        box, index = next(
            (
                (box, i)
                for box in columns[number]
                for i, port in enumerate(box.exits)
                if port.signal == signal
            ),
            (None, 0),
        )
        start = box.exit(index) if box is not None else passing
        ends = [
            (each.entry(i), each.left)
            for each in columns[number + 1]
            for i, port in enumerate(each.entries)
            if port.signal == signal
        ]
        found.append((signal, box, start or 0.0, ends))
    falls = sorted(found, key=lambda each: -each[2] if _falls(each[2], each[3]) else each[2])
    for place, (signal, box, start, ends) in enumerate(falls, start=1):
        onward = [heights[number + 1, signal]] if (number + 1, signal) in heights else []
        left = box.left + box.width if box is not None else edges[0]
        track = edges[0] + PAD + place * PITCH
        yield Path(signal, left, start, track, edges[1], (*(each for each, _ in ends), *onward))


def _falls(start: float, ends: Sequence[tuple[float, float]]) -> bool:
    return not ends or sum(each for each, _ in ends) / len(ends) >= start
