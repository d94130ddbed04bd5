"""The closed loop as drawn: a plant, blocks, and wires by name; no slots, no order yet."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from fcl_sim.block import Block
from fcl_sim.concept.function_block import IntegerInstance
from fcl_sim.diagnostics import Span
from fcl_sim.engine.program import Program
from fcl_sim.plant.catalog import PlantModel
from fcl_sim.plant.declaration import Parameter


@dataclass(frozen=True, slots=True)
class Wire:
    """A connection from the signal named `source`, times `sign` (+1 or -1)."""

    source: str
    sign: float = 1.0
    span: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True, kw_only=True)
class Node:
    """A block of `loop.blocks.BLOCKS`, by its type's name.

    `name` is its path (`controller.speed`); its outputs are signals below that
    path, or that path itself where it has one output. `inputs` are wires by
    port; the signals of a list have the ports 1, 2, ... `parameters` are
    quantities, tuples of them for lists, tuples of rows for tables, else what
    `loop.blocks.declaration.KINDS` says. `places` is where they are written.
    """

    name: str
    type: str
    inputs: Mapping[str, Wire] = field(default_factory=dict)
    parameters: Mapping[str, Any] = field(default_factory=dict)
    places: Mapping[str, Span] = field(default_factory=dict, compare=False, repr=False)
    span: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True, kw_only=True)
class FuzzyNode:
    """A fuzzy function block; `units` gives a unit to each of its variables (FCL has none).

    `arithmetic` is what it computes in, LREAL, REAL or INT; in INT `scale` says
    by variable what a count is, factor and offset in the variable's unit, and
    `rounding` is of quotients.
    """

    name: str
    block: Block
    inputs: Mapping[str, Wire]
    units: Mapping[str, str] = field(default_factory=dict)
    arithmetic: str = "LREAL"
    scale: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    rounding: str = "truncate"
    span: Span | None = field(default=None, compare=False, repr=False)

    @property
    def program(self) -> Program:
        """The block's program in its arithmetic; in INT that of LREAL, which says what is recorded."""
        return self.block.program_in("LREAL" if self.in_int else self.arithmetic)

    @property
    def in_real(self) -> bool:
        """Whether it computes in binary32."""
        return self.arithmetic == "REAL"

    @property
    def in_int(self) -> bool:
        """Whether it computes in INT, outside the compiled loop."""
        return self.arithmetic == "INT"

    def integer_instance(self) -> IntegerInstance:
        """Return an instance in INT; InputFault for what INT cannot do (FCL414)."""
        return self.block.instance("INT", scale=self.scale, rounding=self.rounding)


@dataclass(frozen=True, slots=True, kw_only=True)
class PlantNode:
    """A plant with its parameters and start values, each in its declared unit."""

    name: str
    model: PlantModel
    parameters: Mapping[str, float] = field(default_factory=dict)
    start: Mapping[str, float] = field(default_factory=dict)
    inputs: Mapping[str, Wire] = field(default_factory=dict)
    span: Span | None = field(default=None, compare=False, repr=False)

    @property
    def constants(self) -> dict[str, float]:
        """Its parameters by their full names, but for one that is called like a signal."""
        given = self.parameters
        return {name: given.get(each.name, each.default) for name, each in self._constants.items()}

    @property
    def constant_units(self) -> dict[str, str]:
        """The unit of each of its constants, by the constant's name."""
        return {name: each.unit for name, each in self._constants.items()}

    @property
    def _constants(self) -> dict[str, Parameter]:
        taken = set(self.signals)
        named = {f"{self.name}.{each.name}": each for each in self.model.declaration.parameters}
        return {name: each for name, each in named.items() if name not in taken}

    @property
    def signals(self) -> tuple[str, ...]:
        """Full names of its outputs, then of its inputs as written; one left unconnected is none."""
        left_out = self.unconnected
        return tuple(name for name in self.paths if name not in left_out)

    @property
    def paths(self) -> tuple[str, ...]:
        """Full names of all its outputs, then of all its inputs."""
        plant = self.model.declaration
        names = [each.name for each in plant.outputs] + [each.name for each in plant.inputs]
        return tuple(f"{self.name}.{name}" for name in names)

    @property
    def unconnected(self) -> tuple[str, ...]:
        """Full names of the optional inputs that nothing drives."""
        inputs = self.model.declaration.inputs
        names = [each.name for each in inputs if each.optional and each.name not in self.inputs]
        return tuple(f"{self.name}.{name}" for name in names)


SKIP, LATE = "skip", "late"
POLICIES = (SKIP, LATE)
"""What becomes of scans that fall due while one is still running: left out, or the last of them run late."""

WARM, COLD = "warm", "cold"
RESTARTS = (WARM, COLD)
"""What the blocks of the PLC remember after a restart: everything, or nothing."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Overruns:
    """Scans that take longer than the scan time, and what becomes of those that fall due meanwhile.

    `listed` has the number of a scan, as multiple of the scan time, and the
    nanoseconds it takes; besides, each takes up to `longest` with probability
    `chance`, drawn from the seed.
    """

    policy: str = SKIP
    listed: tuple[tuple[int, int], ...] = ()
    chance: float = 0.0
    longest: int = 0


@dataclass(frozen=True, slots=True, kw_only=True)
class Restart:
    """A restart of the PLC `at` a time, without scans while it `lasts`, in nanoseconds."""

    at: int
    kind: str = WARM
    lasts: int = 0


@dataclass(frozen=True, slots=True, kw_only=True)
class Timing:
    """Scan times, in integer nanoseconds.

    `latency` (0 to `scan`) passes between the reading of the inputs and the
    writing of the outputs; each scan's start is late by up to `jitter`, drawn
    from `seed`. Blocks that integrate or differentiate take the nominal cycle
    time, or with `measured` the time since the last scan. `loop.clock` says what
    `overruns` and `restarts` do.
    """

    scan: int
    duration: int
    latency: int = 0
    jitter: int = 0
    seed: int = 0
    measured: bool = False
    overruns: Overruns = field(default_factory=Overruns)
    restarts: tuple[Restart, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Integration:
    """How the plant is integrated between writes.

    `scheme` is a name of `loop.schemes.SCHEMES`; `rtol` bounds the local error
    of a scheme with step control, relative to |x| + scale of each state;
    `step` is the step of a scheme without, in seconds.
    """

    scheme: str = "dormand_prince"
    rtol: float = 1e-8
    step: float = 0.001


@dataclass(frozen=True, slots=True, kw_only=True)
class Diagram:
    """A closed loop: everything that a run needs, still by name.

    `aliases` gives further names to signals: the inputs and outputs of the
    controller (`controller.distance` for the wire `crane.distance`). The names of
    the blocks in the PLC begin with `plc`; it is they that a restart reaches, but
    for those that stand for devices.
    """

    plant: PlantNode
    nodes: tuple[Node | FuzzyNode, ...]
    aliases: Mapping[str, Wire] = field(default_factory=dict)
    timing: Timing
    integration: Integration = field(default_factory=Integration)
    plc: str = ""

    @property
    def exact(self) -> bool:
        """Whether the plant is linear and moved exactly, whatever `integration` says."""
        return self.plant.model.delay is not None
