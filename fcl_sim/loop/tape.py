"""Wiring → Tape: slots for names, rows for blocks, three buffers for a run (`loop.layout`)."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType

import numpy as np

from fcl_sim.engine.program import Floats as Constants
from fcl_sim.jit import Entry
from fcl_sim.loop import layout
from fcl_sim.loop.blocks import OPCODES
from fcl_sim.loop.blocks.fuzzy import fuzzy_for
from fcl_sim.loop.clock import Schedule, most_under_way, schedule
from fcl_sim.loop.diagram import Diagram, FuzzyNode, Node, PlantNode, Wire
from fcl_sim.loop.execute import JOINT_OPCODE, further_for
from fcl_sim.loop.integer import IntegerBlock
from fcl_sim.loop.node_layout import NodeLayout, Outside, lay_out, outside_of
from fcl_sim.loop.recorded import Recorded, recorded
from fcl_sim.loop.schemes import SCHEMES
from fcl_sim.loop.settings import signals_of
from fcl_sim.loop.wiring import Wiring
from fcl_sim.loop.work import Floats, Ints

NOTHING_FORCED: Mapping[str, float] = MappingProxyType({})

LANES = 4
"""States are padded to a multiple of this, so that the integrator works in constant pieces."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Tape:
    """A wiring as buffers. `ints` and `floats` are read, `memory` and `x` worked in, by a run.

    `slots` says where each signal stands in memory; `recorded` which stretches
    of it make the columns of the record; `instances` where the memory of each
    fuzzy block begins, `own` which stretch is each block's own. `further` executes
    the rows that the loop does not, `fuzzy` the fuzzy blocks in LREAL, and those in
    REAL; `outside` are the blocks in Python, and the fuzzy ones in INT.
    """

    wiring: Wiring
    ints: Ints
    floats: Floats
    memory: Floats
    x: Floats
    p: Floats
    schedule: Schedule
    slots: Mapping[str, int]
    recorded: Recorded
    instances: Mapping[str, int]
    own: Mapping[str, tuple[int, int]]
    further: Entry
    fuzzy: tuple[Entry, Entry]
    outside: Mapping[str, Outside | IntegerBlock]

    @property
    def starts(self) -> Ints:
        """Nanosecond at which each scan reads its inputs, (scans + 1,), the end included."""
        return self.schedule.starts


@dataclass(frozen=True, slots=True)
class _Memory:
    """How memory is shared out: slots of signals, own words of blocks, instances of fuzzy blocks.

    `own` has the first and the number of a block's own words, instances included.
    """

    slots: dict[str, int]
    own: dict[str, tuple[int, int]]
    instances: dict[str, int]
    signals: int
    size: int


def lower(wiring: Wiring, run: int = 0, forced: Mapping[str, float] = NOTHING_FORCED) -> Tape:
    """Return the tape of a wiring; `run` numbers its runs, each with random numbers of its own.

    Signals that are `forced`, not by an alias, keep their value whatever drives
    them; memory is shared out as without. A forced input of the plant keeps what
    stands in its slot.
    """
    diagram, times = wiring.diagram, schedule(wiring.diagram.timing, run)
    layouts = {name: lay_out(wiring, each, run) for name, each in _nodes(wiring).items()}
    memory = _share_out(diagram, wiring.order, layouts)
    ints, floats = _Buffer(layout.HEAD), _Buffer(0)
    head = _plant_words(diagram)
    head |= {layout.SCANS: times.starts.size - 1, layout.MEASURED: int(diagram.timing.measured)}
    head |= _scheme_words(diagram, ints, floats)
    rows = _row_words(wiring, memory, layouts, ints, floats, forced)
    head |= rows.head | _keep_words(layouts, memory, ints, floats)
    head |= _write_words(wiring, memory, ints, floats, forced)
    columns = recorded(wiring, memory.slots, memory.instances, memory.signals)
    head |= {
        layout.SIGNALS: memory.signals,
        layout.SEGMENTS: len(columns.segments),
        layout.SEGMENTS_AT: ints.append([word for segment in columns.segments for word in segment]),
    }
    buffer = ints.integers()
    for word, value in head.items():
        buffer[word] = value
    numbers = floats.numbers()
    for at, singles in rows.singles.items():
        numbers.view(np.float32)[at : at + singles.size] = singles
    return Tape(
        wiring=wiring,
        ints=buffer,
        floats=numbers,
        memory=_initial_memory(diagram, memory, layouts, rows.outside),
        x=_start(diagram.plant),
        p=_parameters(diagram.plant),
        schedule=times,
        slots=memory.slots,
        recorded=columns,
        instances=memory.instances,
        own=memory.own,
        further=further_for(rows.opcodes),
        fuzzy=fuzzy_for(
            {
                (node.arithmetic, node.program.form)
                for node in wiring.order
                if isinstance(node, FuzzyNode) and _fuzzy_opcode(node) != JOINT_OPCODE
            }
        ),
        outside=rows.outside,
    )


def with_plant(tape: Tape, plant: PlantNode) -> Tape:
    """Return a tape with other parameters and start values of its plant; what else it has is shared.

    It is the tape that lowering the whole anew would give.
    """
    diagram = replace(tape.wiring.diagram, plant=plant)
    wiring = replace(tape.wiring, diagram=diagram)
    return replace(tape, wiring=wiring, x=_start(plant), p=_parameters(plant))


def _start(plant: PlantNode) -> Floats:
    return _padded([plant.start.get(each.name, each.start) for each in plant.model.declaration.states], 0.0)


def _parameters(plant: PlantNode) -> Floats:
    declared = plant.model.declaration.parameters
    given = (plant.parameters.get(each.name, each.default) for each in declared)
    return np.array([*plant.model.constants, *given], dtype=np.float64)


class _Buffer:
    """A buffer under construction."""

    def __init__(self, reserved: int) -> None:
        self._words: list[float] = [0] * reserved

    def append(self, words: Iterable[float]) -> int:
        """Append words; return where they begin."""
        at = len(self._words)
        self._words.extend(words)
        return at

    def __len__(self) -> int:
        return len(self._words)

    def integers(self) -> Ints:
        return np.array(self._words, dtype=np.int64)

    def numbers(self) -> Floats:
        return np.array(self._words, dtype=np.float64)


@dataclass(frozen=True, slots=True)
class _Rows:
    """What the rows add to the head, the opcodes in them, the blocks outside, the constants in binary32."""

    head: dict[int, int]
    opcodes: list[int]
    outside: dict[str, Outside | IntegerBlock]
    singles: dict[int, Constants]


def _nodes(wiring: Wiring) -> dict[str, Node]:
    return {node.name: node for node in wiring.order if isinstance(node, Node)}


def _share_out(
    diagram: Diagram, order: Sequence[Node | FuzzyNode], layouts: Mapping[str, NodeLayout]
) -> _Memory:
    names = list(diagram.plant.paths)
    names += [name for node in order if isinstance(node, Node) for name in signals_of(node)]
    names += [node.name for node in order if isinstance(node, FuzzyNode) and (node.in_real or node.in_int)]
    slots = {name: slot for slot, name in enumerate(names)}
    signals = size = len(names)
    own: dict[str, tuple[int, int]] = {}
    instances: dict[str, int] = {}
    for node in order:
        if isinstance(node, FuzzyNode):
            program = node.program
            instances[node.name] = size
            for index, name in enumerate(signals_of(node)):
                slots[name] = size + program.outputs_at + index
            in_memory = program.recorded + -(-program.size // 2) if node.in_real else program.size
            own[node.name] = size, in_memory
        else:
            own[node.name] = size, len(layouts[node.name].initial)
        size += own[node.name][1]
    return _Memory(slots, own, instances, signals, size)


def _plant_words(diagram: Diagram) -> dict[int, int]:
    plant = diagram.plant.model
    declaration = plant.declaration
    return {
        layout.STATES: -(-max(1, len(declaration.states)) // LANES) * LANES,
        layout.TRUE_STATES: len(declaration.states),
        layout.PLANT_INPUTS: len(declaration.inputs),
        layout.PLANT_OUTPUTS: len(declaration.outputs),
        layout.PLANT_INPUTS_AT: len(declaration.outputs),
        layout.EVENTS: len(declaration.events),
        layout.SAMPLED: int(plant.samples),
        layout.DELAY: plant.delay or 0,
        layout.UNDER_WAY: 0 if plant.delay is None else most_under_way(diagram.timing, plant.delay),
    }


def _scheme_words(diagram: Diagram, ints: _Buffer, floats: _Buffer) -> dict[int, int]:
    scheme = SCHEMES[diagram.integration.scheme]
    declaration = diagram.plant.model.declaration
    integration = diagram.integration
    steps = [integration.rtol, integration.step, diagram.timing.scan / 1e9, -1.0 / scheme.order]
    return {
        layout.STAGES: scheme.stages,
        layout.ADAPTIVE: int(bool(scheme.error)),
        layout.DIRECTIONS_AT: ints.append([int(each.direction) for each in declaration.events]),
        layout.SCHEME_AT: floats.append(scheme.table()),
        layout.SCALES_AT: floats.append(_padded([each.scale for each in declaration.states], 1.0)),
        layout.STEP_AT: floats.append(steps),
    }


def _programs(wiring: Wiring, ints: _Buffer, floats: _Buffer) -> tuple[dict[int, int], dict[int, Constants]]:
    """Put the programs of the fuzzy blocks that the loop calls; return by identity where each begins.

    And by their place in binary32 the constants of those in REAL.
    """
    programs: dict[int, int] = {}
    singles: dict[int, Constants] = {}
    for node in wiring.order:
        if isinstance(node, FuzzyNode) and not node.in_int and id(node.program) not in programs:
            program = node.program
            if node.in_real:
                at = floats.append([0.0] * -(-program.floats.size // 2))
                singles[2 * at] = program.floats
                programs[id(program)] = ints.append(program.placed(2 * at))
            else:
                programs[id(program)] = ints.append(program.placed(floats.append(program.floats)))
    return programs, singles


def _row_words(
    wiring: Wiring,
    memory: _Memory,
    layouts: Mapping[str, NodeLayout],
    ints: _Buffer,
    floats: _Buffer,
    forced: Mapping[str, float],
) -> _Rows:
    programs, singles = _programs(wiring, ints, floats)
    rows_at = len(ints)
    opcodes: list[int] = []
    outside: dict[str, Outside | IntegerBlock] = {}
    opcodes += _forcing_rows(_outputs(wiring.diagram.plant), forced, memory, ints, floats)
    for node in wiring.order:
        if isinstance(node, FuzzyNode):
            opcode, state = _fuzzy_opcode(node), memory.instances[node.name]
            wires = [wiring.resolve(node.inputs[port]) for port in node.block.program.input_names]
            inputs = [memory.slots[each.source] for each in wires]
            words: Sequence[int] = [programs.get(id(node.program), -1), -1, -1]
            if node.in_real:
                words = [words[0], 2 * (state + node.program.recorded), memory.slots[node.name]]
            elif node.in_int:
                opcode, check = OPCODES["python"], memory.slots[node.name]
                outside[node.name] = IntegerBlock(len(ints), node, state, check, node.integer_instance())
            numbers: Sequence[float] = [each.sign for each in wires]
        else:
            laid, opcode, state = layouts[node.name], OPCODES[node.type], memory.own[node.name][0]
            inputs = [each.slot(memory.slots, state) for each in laid.inputs]
            words, numbers = laid.words, [*(each.sign for each in laid.inputs), *laid.numbers]
            if node.type == "python":
                outside[node.name] = outside_of(node, wiring.settings[node.name], len(ints))
        output = memory.slots[signals_of(node)[0]]
        length = layout.FIRST_INPUT + len(inputs) + len(words)
        row = [opcode, length, output, state, floats.append(numbers), len(inputs)]
        ints.append([*row, *inputs, *words])
        opcodes.append(opcode)
        opcodes += _forcing_rows(signals_of(node), forced, memory, ints, floats)
    head = {layout.ROWS: len(opcodes), layout.ROWS_AT: rows_at, layout.ROWS_END: len(ints)}
    return _Rows(head, opcodes, outside, singles)


def _fuzzy_opcode(node: FuzzyNode) -> int:
    by_itself = node.program.form == "joint" and not node.in_real and not node.in_int
    return JOINT_OPCODE if by_itself else OPCODES["fuzzy"]


def _forcing_rows(
    names: Iterable[str], forced: Mapping[str, float], memory: _Memory, ints: _Buffer, floats: _Buffer
) -> list[int]:
    """Append a row for each signal that is forced, which gives it its constant; return their opcodes."""
    wanted = [name for name in names if name in forced]
    for name in wanted:
        slot, number = memory.slots[name], floats.append([forced[name]])
        ints.append([OPCODES["constant"], layout.FIRST_INPUT, slot, slot, number, 0])
    return [OPCODES["constant"]] * len(wanted)


def _outputs(plant: PlantNode) -> list[str]:
    return [f"{plant.name}.{each.name}" for each in plant.model.declaration.outputs]


def _keep_words(
    layouts: Mapping[str, NodeLayout], memory: _Memory, ints: _Buffer, floats: _Buffer
) -> dict[int, int]:
    words = []
    for name, laid in layouts.items():
        for each in laid.late:
            sign = floats.append([each.sign])
            words += [memory.slots[each.source], sign, memory.own[name][0] + each.at]
    return {layout.KEEPS: len(words) // 3, layout.KEEPS_AT: ints.append(words)}


def _write_words(
    wiring: Wiring, memory: _Memory, ints: _Buffer, floats: _Buffer, forced: Mapping[str, float]
) -> dict[int, int]:
    plant = wiring.diagram.plant
    paths = {each.name: f"{plant.name}.{each.name}" for each in plant.model.declaration.inputs}
    wires = [
        wiring.resolve(plant.inputs[name])
        if name in plant.inputs and path not in forced
        else Wire(path)  # what stands in the signal is written to it again
        for name, path in paths.items()
    ]
    return {
        layout.WRITES_AT: ints.append([memory.slots[each.source] for each in wires]),
        layout.WRITE_SIGNS_AT: floats.append([each.sign for each in wires]),
    }


def _initial_memory(
    diagram: Diagram,
    memory: _Memory,
    layouts: Mapping[str, NodeLayout],
    outside: Mapping[str, Outside | IntegerBlock],
) -> Floats:
    initial = np.zeros(memory.size)
    plant = diagram.plant
    for each in plant.model.declaration.inputs:
        initial[memory.slots[f"{plant.name}.{each.name}"]] = each.start
    for node in diagram.nodes:
        block = outside.get(node.name)
        if isinstance(block, IntegerBlock):
            block.record(block.instance, initial)
        elif isinstance(node, FuzzyNode):
            at, program = memory.instances[node.name], node.program
            if node.in_real:
                initial[at : at + program.recorded] = program.initial[: program.recorded]
                at += program.recorded
                initial.view(np.float32)[2 * at : 2 * at + program.size] = program.initial
            else:
                initial[at : at + program.size] = program.initial
        else:
            at, own = memory.own[node.name][0], layouts[node.name].initial
            initial[at : at + len(own)] = own
    return initial


def _padded(values: Sequence[float], filling: float) -> Floats:
    size = -(-max(1, len(values)) // LANES) * LANES
    return np.array([*values, *[filling] * (size - len(values))], dtype=np.float64)
