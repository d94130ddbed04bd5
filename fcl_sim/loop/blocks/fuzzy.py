"""`fuzzy`: a fuzzy function block, called once per scan, in the arithmetic of its node.

A block in LREAL that has a table of joint cells is evaluated by the loop itself.
Any other arithmetic and form of program is compiled when a tape first needs it,
and called through a first-class function.
An instance in REAL has a head in `memory`, of what a trace records, and its
binary32 words behind that, which the kernel sees as `singles`; its constants
stand in `floats` likewise, seen as `constants`.
"""

from collections.abc import Callable, Mapping
from collections.abc import Set as AbstractSet
from typing import Any

from numpy.typing import NDArray

from fcl_sim.engine.infer import infer, infer_curved
from fcl_sim.engine.joint import infer_jointly
from fcl_sim.engine.program import DEGREES, RULES
from fcl_sim.jit import F4, Entry, F, I, entry, function_type, i8, inlined, signature, u, void
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


@inlined
def take_long(ints: Ints, floats: Floats, memory: Floats, at: int) -> int:
    """Give a block in LREAL its inputs; return where its program begins."""
    inputs = ints[u(at + INPUTS)]
    signs = ints[u(at + PARAMETERS)]
    instance = ints[u(at + STATE)]
    for i in range(inputs):
        memory[u(instance + i)] = floats[u(signs + i)] * memory[u(ints[u(at + FIRST_INPUT + i)])]
    return int(ints[u(at + FIRST_INPUT + inputs + PROGRAM)])


@inlined
def call_jointly(ints: Ints, floats: Floats, memory: Floats, at: int) -> None:
    """Call a block in LREAL that has a table of joint cells: the loop does so itself, without a call."""
    program = take_long(ints, floats, memory, at)
    infer_jointly(ints, floats, program, memory, ints[u(at + STATE)])


@inlined
def take_real(ints: Ints, floats: Floats, memory: Floats, singles: Singles, at: int) -> tuple[int, int]:
    """Give a block in REAL its inputs, rounded; return where its program begins, and its instance."""
    inputs = ints[u(at + INPUTS)]
    signs = ints[u(at + PARAMETERS)]
    words = at + FIRST_INPUT + inputs
    instance = ints[u(words + INSTANCE)]
    unsound = 0.0
    for i in range(inputs):
        singles[u(instance + i)] = floats[u(signs + i)] * memory[u(ints[u(at + FIRST_INPUT + i)])]
        unsound += singles[u(instance + i)] * 0.0
    memory[u(ints[u(words + CHECKED)])] = unsound
    return int(ints[u(words + PROGRAM)]), int(instance)


@inlined
def give_real(ints: Ints, memory: Floats, singles: Singles, at: int, program: int, instance: int) -> None:
    """Copy what a block in REAL has computed to its head."""
    head = ints[u(at + STATE)]
    for i in range(ints[u(program + DEGREES)] + ints[u(program + RULES)]):
        memory[u(head + i)] = singles[u(instance + i)]


@entry(signature(*_FUZZY), flat=True)
def evaluate_long_jointly(
    ints: Ints, floats: Floats, memory: Floats, constants: Singles, singles: Singles, at: int
) -> None:
    """Call a block in LREAL that has a table of joint cells."""
    call_jointly(ints, floats, memory, at)


@entry(signature(*_FUZZY), flat=True)
def evaluate_long(
    ints: Ints, floats: Floats, memory: Floats, constants: Singles, singles: Singles, at: int
) -> None:
    """Call a block in LREAL that has no areas under norms of the Open Level."""
    program = take_long(ints, floats, memory, at)
    infer(ints, floats, program, memory, ints[u(at + STATE)])


@entry(signature(*_FUZZY), flat=True)
def evaluate_long_curved(
    ints: Ints, floats: Floats, memory: Floats, constants: Singles, singles: Singles, at: int
) -> None:
    """Call any block in LREAL."""
    program = take_long(ints, floats, memory, at)
    infer_curved(ints, floats, program, memory, ints[u(at + STATE)])


@entry(signature(*_FUZZY), flat=True)
def evaluate_real_jointly(
    ints: Ints, floats: Floats, memory: Floats, constants: Singles, singles: Singles, at: int
) -> None:
    """Call a block in REAL that has a table of joint cells."""
    program, instance = take_real(ints, floats, memory, singles, at)
    infer_jointly(ints, constants, program, singles, instance)
    give_real(ints, memory, singles, at, program, instance)


@entry(signature(*_FUZZY), flat=True)
def evaluate_real(
    ints: Ints, floats: Floats, memory: Floats, constants: Singles, singles: Singles, at: int
) -> None:
    """Call a block in REAL that has no areas under norms of the Open Level."""
    program, instance = take_real(ints, floats, memory, singles, at)
    infer(ints, constants, program, singles, instance)
    give_real(ints, memory, singles, at, program, instance)


@entry(signature(*_FUZZY), flat=True)
def evaluate_real_curved(
    ints: Ints, floats: Floats, memory: Floats, constants: Singles, singles: Singles, at: int
) -> None:
    """Call any block in REAL."""
    program, instance = take_real(ints, floats, memory, singles, at)
    infer_curved(ints, constants, program, singles, instance)
    give_real(ints, memory, singles, at, program, instance)


@entry(signature(*_FUZZY), flat=True)
def evaluate_nothing(
    ints: Ints, floats: Floats, memory: Floats, constants: Singles, singles: Singles, at: int
) -> None:
    """Do nothing, where no block is in this arithmetic."""


LONG = {"joint": evaluate_long_jointly, "plain": evaluate_long, "curved": evaluate_long_curved}
REAL = {"joint": evaluate_real_jointly, "plain": evaluate_real, "curved": evaluate_real_curved}


def fuzzy_for(kinds: AbstractSet[tuple[str, str]]) -> tuple[Entry, Entry]:
    """Return what calls the blocks of a tape in LREAL, and in REAL, of `kinds`: arithmetic and form.

    What calls programs of one form calls those of the forms before it too.
    """

    def chosen(arithmetic: str, by_form: Mapping[str, Entry]) -> Entry:
        entries = [by_form[form] for form in by_form if (arithmetic, form) in kinds]
        return entries[-1] if entries else evaluate_nothing

    return chosen("LREAL", LONG), chosen("REAL", REAL)
