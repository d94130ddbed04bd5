"""The boxes of a wiring, with what enters and what leaves them, in columns.

Boxes stand in the order of the scan: the plant as it is read, then each block one
column behind the last of its sources, then the plant as it is written. A block that
nothing of the plant leads to stands right before what reads it. A constant stands
where it is read.
"""

from collections.abc import Container, Iterator, Mapping, Sequence
from dataclasses import dataclass

from fcl_sim.loop.diagram import Node, Wire
from fcl_sim.loop.settings import AnyNode, signals_of, waits_for
from fcl_sim.loop.wiring import Wiring
from fcl_sim.report.constants import told
from fcl_sim.report.lettering import cut, text_width
from fcl_sim.report.style import HINTED, NORMAL, SMALL

GRID = 3.5
ENTRY, PASSING = 0.5 * GRID, (0.25 * GRID, 0.75 * GRID)
"""How far below the grid wires enter a box, and where they may pass a column; they leave a box on it."""
HEAD = 3
"""Lines of a box above its ports."""
PAD = 1.4
WIDEST, ENTERING, LEAVING = 74.0, 42.0, 30.0
"""Most mm of a title, of the name of what enters a box and of what leaves it."""

READ, WRITTEN, CONTINUED = "read", "written", "continued"

GOES_ON = " ↓"
"""Behind the name of a signal that is read in a row below, too."""


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


Columns = Sequence[Sequence[Box]]


def in_columns(wiring: Wiring) -> list[list[Box]]:
    """Return every box of a wiring in its column, in the order of execution there."""
    plant = wiring.diagram.plant
    names = [f"{plant.name}.{each.name}" for each in plant.model.declaration.outputs]
    read = {wiring.resolve(each).source for node in wiring.order for each in node.inputs.values()}
    names += [name for name in plant.signals if name in read and name not in names]
    constants = _constants(wiring)
    columns = _columns(wiring, (*names, *constants))
    exits = [_exit(wiring, name, name.removeprefix(f"{plant.name}.")) for name in names]
    last = 1 + max((columns[each] for node in wiring.order for each in signals_of(node)), default=0)
    made: list[list[Box]] = [[] for _ in range(last + 1)]
    made[0].append(Box(title=_titled(plant.name), text="read", kind=READ, exits=exits))
    for number, node in enumerate(wiring.order, start=1):
        if node.name not in constants:
            column = columns[signals_of(node)[0]]
            before = {signal for signal, other in columns.items() if other < column}
            made[column].append(_block(wiring, number, node, before))
    taken = [_entry(wiring, port, each) for port, each in plant.inputs.items()]
    late = wiring.diagram.timing.latency
    text = f"written {late / 1e6:g} ms later" if late else "written"
    made[last].append(Box(title=_titled(plant.name), text=text, kind=WRITTEN, entries=taken))
    for box in (each for column in made for each in column):
        box.entries = [_told(each, constants) for each in box.entries]
    return made


def continued(wiring: Wiring, signals: Sequence[str]) -> Box:
    """Return what a row begins with: signals that come from rows above it."""
    exits = [_exit(wiring, each, each, ENTERING) for each in signals]
    return Box(title="from above", text="", kind=CONTINUED, exits=exits)


def _columns(wiring: Wiring, first: Sequence[str]) -> dict[str, int]:
    """Return the column of every signal, those of the plant and of constants in the first."""
    columns = dict.fromkeys(first, 0)
    led = {each for each in first if each.startswith(f"{wiring.diagram.plant.name}.")}
    sources = {}
    for node in wiring.order:
        if all(each in columns for each in signals_of(node)):
            continue
        prompt = waits_for(node, wiring.diagram.timing)
        sources[node.name] = [wiring.resolve(each).source for each in prompt]
        column = 1 + max((columns[each] for each in sources[node.name]), default=0)
        columns |= dict.fromkeys(signals_of(node), column)
        if not led.isdisjoint(sources[node.name]):
            led.update(signals_of(node))
    last = 1 + max(columns.values())
    readers = {wiring.resolve(each).source: last for each in wiring.diagram.plant.inputs.values()}
    for node in reversed(wiring.order):
        if node.name not in sources:
            continue
        mine = signals_of(node)
        if led.isdisjoint(mine):
            read = [readers[each] for each in mine if each in readers]
            columns |= dict.fromkeys(mine, min(read) - 1 if read else columns[mine[0]])
        for each in sources[node.name]:
            readers[each] = min(readers.get(each, last), columns[mine[0]])
    return columns


def _block(wiring: Wiring, number: int, node: AnyNode, before: Container[str]) -> Box:
    """Return a block; `before` are the signals that stand in columns before its own."""
    kind = getattr(node, "type", "fuzzy")
    prompt = waits_for(node, wiring.diagram.timing)
    signals = signals_of(node)
    exits = [_exit(wiring, each, each.removeprefix(node.name).removeprefix(".")) for each in signals]
    entries = [
        _entry(wiring, port, each)
        if any(each is other for other in prompt)
        else _late_entry(wiring, port, each, before)
        for port, each in node.inputs.items()
    ]
    place = "inside" if node.name.startswith(wiring.diagram.plc) else "beside"
    return Box(title=_titled(f"{number}  {node.name}"), text=kind, kind=place, entries=entries, exits=exits)


def _titled(text: str) -> str:
    return cut(text, WIDEST, NORMAL)


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
    return Port(cut(f"{port.text}{between} = {constants[port.signal]}", ENTERING, SMALL))


def _exit(wiring: Wiring, signal: str, name: str, most: float = LEAVING) -> Port:
    return Port(cut(f"{name} [{wiring.units[signal].symbol or '1'}]".strip(), most, SMALL), signal)


def _entry(wiring: Wiring, port: str, wire: Wire) -> Port:
    resolved = wiring.resolve(wire)
    return Port(cut(f"{'−' if resolved.sign < 0 else ''}{port}", ENTERING, SMALL), resolved.source)


def _late_entry(wiring: Wiring, port: str, wire: Wire, before: Container[str]) -> Port:
    """Return an entry for a signal of the last scan, which is named where its wire would run back."""
    prompt = _entry(wiring, port, wire)
    if prompt.signal in before:
        return Port(cut(f"{prompt.text} (last)", ENTERING, SMALL), prompt.signal, late=True)
    return Port(cut(f"{prompt.text} ← last {prompt.signal}", ENTERING, SMALL), late=True)


def wanted(columns: Columns) -> Iterator[str]:
    """Yield the signals that wires bring into boxes, once each."""
    yield from dict.fromkeys(
        port.signal for column in columns for box in column for port in box.entries if port.signal
    )
