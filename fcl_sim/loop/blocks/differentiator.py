"""`differentiator`: first-order filtered difference."""

from fcl_sim.jit import inlined
from fcl_sim.loop.blocks.declaration import BlockInput, BlockOutput, BlockParameter, BlockType, Like
from fcl_sim.loop.row import Row, keep, last, number, read, recall, write

PREVIOUS, BEGUN = 0, 1


@inlined
def differentiate(row: Row) -> None:
    """Kernel of `differentiator`; number 0 is Tf."""
    now = read(row, 0)
    if recall(row, BEGUN) == 0.0:
        keep(row, BEGUN, 1.0)
        write(row, 0, 0.0)
    else:
        before = last(row, 0)
        rate = (now - recall(row, PREVIOUS)) / row.cycle
        write(row, 0, before + row.cycle / (number(row, 0) + row.cycle) * (rate - before))
    keep(row, PREVIOUS, now)


DIFFERENTIATOR = BlockType(
    name="differentiator",
    summary="rate of change of a signal, filtered by a first-order lag",
    equation="y_k = y_{k-1} + T/(Tf + T) * ((u_k - u_{k-1})/T - y_{k-1}); y_0 = 0",
    source="IEC 61131-7 A.3, differentiating element; backward difference of s/(1 + s Tf)",
    kernel=differentiate,
    inputs=(BlockInput(name="input", meaning="u"),),
    parameters=(
        BlockParameter(name="filter", unit="s", meaning="Tf, time constant of the lag", default="0 s"),
    ),
    outputs=(BlockOutput(unit=Like("input", "1/s")),),
    states=2,
)
