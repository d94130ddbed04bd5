"""One block → what its row holds: inputs, words, numbers, and the initial values of its own memory."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from fcl_sim.diagnostics import Span
from fcl_sim.loop.blocks.declaration import NUMBERS, WORDS, BlockParameter
from fcl_sim.loop.blocks.setting import Setting, Text
from fcl_sim.loop.blocks.user_function import Step, load
from fcl_sim.loop.diagram import Node
from fcl_sim.loop.settings import members_of, ports_of, signals_of, type_of
from fcl_sim.loop.wiring import Wiring


@dataclass(frozen=True, slots=True)
class InputWords:
    """An input of a row: the signal `source` times `sign` or, where that is empty, word `at` of its own."""

    source: str
    sign: float
    at: int = 0

    def slot(self, slots: Mapping[str, int], own: int) -> int:
        """Return its slot in memory, the block's own words beginning at `own`."""
        return slots[self.source] if self.source else own + self.at


@dataclass(frozen=True, slots=True)
class NodeLayout:
    """What stands in a block's row, and in its own words of memory.

    `initial` are its states, then a word for each input that is a constant or
    late. `late` are the signals to be kept there at the end of each scan.
    """

    inputs: Sequence[InputWords]
    words: Sequence[int]
    numbers: Sequence[float]
    initial: Sequence[float]
    late: Sequence[InputWords]


@dataclass(frozen=True, slots=True)
class Outside:
    """A block in Python: where its row begins, its ports and outputs by name, its function."""

    row: int
    ports: tuple[str, ...]
    outputs: tuple[str, ...]
    step: Step
    file: Text
    span: Span | None


def lay_out(wiring: Wiring, node: Node, run: int) -> NodeLayout:
    """Return what stands in the row of a node, in run number `run`."""
    kind = type_of(node)
    setting = replace(wiring.settings[node.name], run=run)
    prepared, late = kind.prepared(setting), kind.late_inputs(setting)
    defaults = {each.name: each.default for each in kind.inputs}
    gains = members_of(node) if kind.group and kind.group.form == "gains" else ()
    inputs, kept, initial = [], [], [*prepared.states]
    for port in ports_of(node):
        at = len(initial)
        if port not in node.inputs:
            value = setting.values[port] if port in setting.values else defaults[port]
            inputs.append(InputWords("", 1.0, at))
            initial.append(float(value or 0.0))
            continue
        wire = wiring.resolve(node.inputs[port])
        sign = wire.sign * node.parameters[port].value if port in gains else wire.sign
        if port in late:
            inputs.append(InputWords("", 1.0, at))
            kept.append(InputWords(wire.source, sign, at))
            initial.append(prepared.late.get(port, 0.0))
        else:
            inputs.append(InputWords(wire.source, sign))
    plain = [each for each in kind.parameters if not each.port]
    return NodeLayout(
        inputs=inputs,
        words=[*(_word(each, setting) for each in plain if each.kind in WORDS), *prepared.words],
        numbers=[*(setting.values[each.name] for each in plain if each.kind in NUMBERS), *prepared.numbers],
        initial=initial,
        late=kept,
    )


def outside_of(node: Node, setting: Setting, row: int) -> Outside:
    """Return a block in Python whose row begins at `row`; its function is loaded anew."""
    file: Text = setting.values["file"]
    step = load(file, setting.values["function"])
    outputs = tuple(name.removeprefix(f"{node.name}.") for name in signals_of(node))
    return Outside(row, ports_of(node), outputs, step, file, node.span)


def _word(parameter: BlockParameter, setting: Setting) -> int:
    value = setting.values[parameter.name]
    return parameter.choices.index(value) if parameter.kind == "choice" else int(value)
