"""A wiring and a tape in print: what `fcl-sim show wiring` and `show tape` give."""

from collections.abc import Iterator, Mapping

from fcl_sim.loop import layout
from fcl_sim.loop.blocks import BLOCKS, OPCODES
from fcl_sim.loop.diagram import FuzzyNode, Node, Wire
from fcl_sim.loop.execute import JOINT_OPCODE
from fcl_sim.loop.settings import signals_of
from fcl_sim.loop.tape import Tape
from fcl_sim.loop.wiring import Wiring


def wiring_text(wiring: Wiring) -> str:
    """Return a wiring in print: the blocks in their order of execution, the plant, every signal."""
    return "\n".join([*_order(wiring), "", *_plant(wiring), "", *_signals(wiring)])


def _order(wiring: Wiring) -> Iterator[str]:
    yield "blocks, in their order of execution"
    for number, node in enumerate(wiring.order, start=1):
        if isinstance(node, FuzzyNode):
            yield f"  {number}  {', '.join(signals_of(node))} <- fuzzy {node.block.name}"
        else:
            yield f"  {number}  {node.name} <- {node.type}"
        yield from (f"       {each}" for each in _settings(wiring, node))


def _settings(wiring: Wiring, node: Node | FuzzyNode) -> Iterator[str]:
    """Yield what a block reads, and its parameters; of a block with terms, each term with its gain."""
    parameters = node.parameters if isinstance(node, Node) else {}
    group = BLOCKS[node.type].group if isinstance(node, Node) else None
    with_gains = group is not None and group.form == "gains"
    for port, each in node.inputs.items():
        gain = f"{parameters[port]} * " if with_gains else ""
        yield f"{port} = {gain}{_source(wiring, each)}"
    if not with_gains:
        yield from (f"{name} = {value}" for name, value in parameters.items())


def _source(wiring: Wiring, wire: Wire) -> str:
    """Return what a wire reads, with the signal behind it where it reads an alias."""
    resolved = wiring.resolve(wire)
    shown = _signed(wire)
    return shown if resolved.source == wire.source else f"{shown} (that is {_signed(resolved)})"


def _signed(wire: Wire) -> str:
    return ("-" if wire.sign < 0 else "") + wire.source


def _plant(wiring: Wiring) -> Iterator[str]:
    plant, timing = wiring.diagram.plant, wiring.diagram.timing
    yield f"plant {plant.name}: {plant.model.declaration.title}"
    for each in plant.model.declaration.inputs:
        if each.name in plant.inputs:
            yield f"  {each.name} = {_source(wiring, plant.inputs[each.name])}, held between writes"
        else:
            yield f"  {each.name} stays at {each.start:g} {each.unit}".rstrip()
    scheme = "exactly" if wiring.diagram.exact else f"by {wiring.diagram.integration.scheme}"
    yield f"  integrated {scheme}, one scan every {timing.scan / 1e9:g} s"


def _signals(wiring: Wiring) -> Iterator[str]:
    yield "signals"
    names = [*wiring.units]
    width = max((len(name) for name in names), default=0)
    for name, unit in wiring.units.items():
        alias = wiring.sources.get(name)
        yield f"  {name:{width}}  [{unit.symbol or '1'}]{f' = {_signed(alias)}' if alias else ''}"


def tape_text(tape: Tape) -> str:
    """Return a tape in print: its memory, its rows, what is recorded, where everything begins."""
    return "\n".join([*_sizes(tape), "", *_memory(tape), "", *_rows(tape), "", *_head(tape)])


def _sizes(tape: Tape) -> Iterator[str]:
    yield f"tape: {tape.ints.size} integers, {tape.floats.size} floats, {tape.memory.size} words of memory"
    yield f"{tape.starts.size} samples of {tape.recorded.width} columns"


def _memory(tape: Tape) -> Iterator[str]:
    yield "memory"
    lines = {at: f"here begins the memory of {name}" for name, at in tape.instances.items()}
    lines |= {at: f"{name}, recorded in column {tape.recorded.column(at)}" for name, at in tape.slots.items()}
    yield from (f"  m{at:<4} {line}" for at, line in sorted(lines.items()))


def _rows(tape: Tape) -> Iterator[str]:
    yield "rows"
    names = {slot: name for name, slot in tape.slots.items()}
    at = int(tape.ints[layout.ROWS_AT])
    for _ in range(int(tape.ints[layout.ROWS])):
        row = tape.ints[at:].tolist()
        yield f"  i{at:<4} {_row(row, names)}, parameters at f{row[layout.PARAMETERS]}"
        at += row[layout.ROW_LENGTH]


def _row(row: list[int], names: Mapping[int, str]) -> str:
    inputs = row[layout.FIRST_INPUT : layout.FIRST_INPUT + row[layout.INPUTS]]
    words = ", ".join(names.get(slot, f"m{slot}") for slot in inputs)
    kinds = {opcode: name for name, opcode in OPCODES.items()} | {JOINT_OPCODE: "fuzzy"}
    return f"{names[row[layout.OUTPUT]]} <- {kinds[row[layout.OPCODE]]}({words})"


def _head(tape: Tape) -> Iterator[str]:
    yield "head"
    names = [name for name in vars(layout) if name.isupper()]
    for word, name in enumerate(names[: layout.HEAD]):
        yield f"  i{word:<4} {tape.ints[word]:>12} {name}"
