"""`fuzzy`: a fuzzy function block, called once per scan, in the arithmetic of its node.

Each arithmetic, with areas under norms of the Open Level or without, is
compiled when a tape first needs it, and called through a first-class function.
An instance in REAL has a head in `memory`, of what a trace records, and its
binary32 words behind that, which the kernel sees as `singles`; its constants
stand in `floats` likewise, seen as `constants`.
"""

from collections.abc import Callable
from typing import Any

from numpy.typing import NDArray

from fcl_sim.engine.curved import CURVED, Curved
from fcl_sim.engine.infer import infer, infer_curved
from fcl_sim.engine.program import DEGREES, RULES
from fcl_sim.jit import F4, Entry, F, I, entry, flat, function_type, i8, signature, u, void
from fcl_sim.loop.blocks.declaration import BlockType
from fcl_sim.loop.layout import FIRST_INPUT, INPUTS, PARAMETERS, STATE
from fcl_sim.loop.work import Floats, Ints

Singles = NDArray[Any]
"""Numbers of binary32."""

Fuzzy = Callable[[Ints, Floats, Floats, Singles, Singles, int], None]
"""A function that calls one fuzzy block: tape, memory, tape and memory as binary32, where the row begins."""

_FUZZY = (void, I, F, F, F4, F4, i8)

FUZZY_TYPE = function_type(*_FUZZY)

PROGRAM, INSTANCE, CHECKED, WORDS = range(4)
"""Words of a row behind its inputs: where the program begins; in REAL where the instance begins in `singles`
(LREAL: -1), and the slot that is not finite where an input is beyond REAL."""

FUZZY = BlockType(
    name="fuzzy",
    summary="a fuzzy function block in FCL",
    equation="fuzzify, aggregate, activate, accumulate, defuzzify; outputs begin at their initial values",
    source="IEC 61131-7 clause 5 and A.2.3",
    kernel=None,  # `execute` calls it with the buffers that it needs
)


@flat
def call_long(ints: Ints, floats: Floats, memory: Floats, at: int, curved: Curved) -> None:
    """Call a block in LREAL."""
    inputs = ints[u(at + INPUTS)]
    signs = ints[u(at + PARAMETERS)]
    instance = ints[u(at + STATE)]
    for i in range(inputs):
        memory[u(instance + i)] = floats[u(signs + i)] * memory[u(ints[u(at + FIRST_INPUT + i)])]
    program = ints[u(at + FIRST_INPUT + inputs + PROGRAM)]
    if curved is None:
        infer(ints, floats, program, memory, instance)
    else:
        infer_curved(ints, floats, program, memory, instance)


@flat
def call_real(
    ints: Ints, floats: Floats, memory: Floats, constants: Singles, singles: Singles, at: int, curved: Curved
) -> None:
    """Call a block in REAL: its inputs are rounded, and what it computes is copied to its head."""
    inputs = ints[u(at + INPUTS)]
    signs = ints[u(at + PARAMETERS)]
    head = ints[u(at + STATE)]
    words = at + FIRST_INPUT + inputs
    program, instance = ints[u(words + PROGRAM)], ints[u(words + INSTANCE)]
    unsound = 0.0
    for i in range(inputs):
        singles[u(instance + i)] = floats[u(signs + i)] * memory[u(ints[u(at + FIRST_INPUT + i)])]
        unsound += singles[u(instance + i)] * 0.0
    memory[u(ints[u(words + CHECKED)])] = unsound
    if curved is None:
        infer(ints, constants, program, singles, instance)
    else:
        infer_curved(ints, constants, program, singles, instance)
    for i in range(ints[u(program + DEGREES)] + ints[u(program + RULES)]):
        memory[u(head + i)] = singles[u(instance + i)]


@entry(signature(*_FUZZY), flat=True)
def evaluate_long(
    ints: Ints,
    floats: Floats,
    memory: Floats,
    constants: Singles,  # noqa: ARG001  all take the same
    singles: Singles,  # noqa: ARG001
    at: int,
) -> None:
    """Call a block in LREAL that has no areas under norms of the Open Level."""
    call_long(ints, floats, memory, at, None)


@entry(signature(*_FUZZY), flat=True)
def evaluate_long_curved(
    ints: Ints,
    floats: Floats,
    memory: Floats,
    constants: Singles,  # noqa: ARG001
    singles: Singles,  # noqa: ARG001
    at: int,
) -> None:
    """Call any block in LREAL."""
    call_long(ints, floats, memory, at, CURVED)


@entry(signature(*_FUZZY), flat=True)
def evaluate_real(
    ints: Ints, floats: Floats, memory: Floats, constants: Singles, singles: Singles, at: int
) -> None:
    """Call a block in REAL that has no areas under norms of the Open Level."""
    call_real(ints, floats, memory, constants, singles, at, None)


@entry(signature(*_FUZZY), flat=True)
def evaluate_real_curved(
    ints: Ints, floats: Floats, memory: Floats, constants: Singles, singles: Singles, at: int
) -> None:
    """Call any block in REAL."""
    call_real(ints, floats, memory, constants, singles, at, CURVED)


@entry(signature(*_FUZZY), flat=True)
def evaluate_nothing(
    ints: Ints, floats: Floats, memory: Floats, constants: Singles, singles: Singles, at: int
) -> None:
    """Do nothing, where no block is in this arithmetic."""


def fuzzy_for(kinds: set[tuple[str, bool]]) -> tuple[Entry, Entry]:
    """Return what calls the blocks of a tape in LREAL, and in REAL.

    `kinds` are their arithmetics, each with whether a program there is curved.
    """

    def chosen(arithmetic: str, plain: Entry, curved: Entry) -> Entry:
        if (arithmetic, True) in kinds:
            return curved
        return plain if (arithmetic, False) in kinds else evaluate_nothing

    return (
        chosen("LREAL", evaluate_long, evaluate_long_curved),
        chosen("REAL", evaluate_real, evaluate_real_curved),
    )
