"""Many evaluations over arrays, and the checks of what goes in (S37)."""

from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from dataclasses import dataclass
from math import prod
from os import cpu_count

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fcl_sim.diagnostics import nearest
from fcl_sim.diagnostics.spelling import listed
from fcl_sim.engine.batch import EACH, ONE_OF_ALL, UNDOUBTED
from fcl_sim.engine.entries import many_for
from fcl_sim.engine.precision import PRECISIONS
from fcl_sim.engine.program import Program
from fcl_sim.jit import address

Values = NDArray[np.float64]

FOR_A_THREAD = 20_000
"""Points that are worth a thread of their own: some hundred microseconds at least."""


@dataclass(frozen=True, slots=True)
class Evaluation:
    """Outputs by name, and for each whether any rule was active; all of the inputs' common shape."""

    outputs: Mapping[str, Values]
    active: Mapping[str, NDArray[np.bool_]]


def evaluate(
    program: Program,
    values: Mapping[str, ArrayLike],
    previous: Mapping[str, ArrayLike] | None = None,
    optional: frozenset[str] = frozenset(),
) -> Evaluation:
    """Evaluate at every point of the broadcast `values`, each without the memory of another.

    `previous` gives outputs the values that NC keeps, else the initial ones.
    Inputs named in `optional` may be missing: they keep their initial value.
    Raises TypeError for a missing or unknown variable, ValueError for a value
    that is not finite, with its first index.
    """
    inputs = checked_names(program, values, optional)
    given = {**inputs, **by_declared_name(previous or {}, program.output_names, "output")}
    names = (*program.input_names, *program.output_names)
    columns = [np.asarray(given.get(name, program.initial[i]), np.float64) for i, name in enumerate(names)]
    kinds = [_kind(column, known=name in given) for name, column in zip(names, columns, strict=True)]
    shape = np.broadcast_shapes(*(column.shape for column in columns))
    outputs = np.empty((len(program.output_names), *shape))
    active = np.empty(outputs.shape, np.bool_)
    taken = [
        np.ascontiguousarray(each if each.size == 1 else np.broadcast_to(each, shape)) for each in columns
    ]
    if not _in_threads(program, list(zip(taken, kinds, strict=True)), outputs, active):
        for name in names:
            _refuse_unfit(name, given.get(name, 0.0), program.arithmetic)
    return Evaluation(
        {name: outputs[i, ...] for i, name in enumerate(program.output_names)},
        {name: active[i, ...] for i, name in enumerate(program.output_names)},
    )


def _kind(column: Values, *, known: bool) -> int:
    """Return what `evaluate_many` takes a column for; a value that nobody gave is the program's own."""
    return (EACH if column.size != 1 else ONE_OF_ALL) if known else UNDOUBTED


def checked_names(
    program: Program, values: Mapping[str, ArrayLike], optional: frozenset[str]
) -> dict[str, ArrayLike]:
    """Return `values` by declared names; TypeError for one that is missing or unknown."""
    inputs = by_declared_name(values, program.input_names, "input")
    for name in program.input_names:
        if name not in inputs and name not in optional:
            raise TypeError(f"{program.name} needs a value for {name}")
    return inputs


def _in_threads(
    program: Program, columns: Sequence[tuple[Values, int]], outputs: Values, active: NDArray[np.bool_]
) -> bool:
    """Evaluate all points, many of them on all processors: the kernel holds no lock of the interpreter.

    Return whether the arithmetic can hold all that is in the columns.
    """
    run, size = many_for(program).compile(), prod(outputs.shape[1:])
    taken = [number for column, kind in columns for number in (address(column), kind)]
    given = [address(each[i, ...]) for i in range(len(outputs)) for each in (outputs, active)]
    places, largest = np.array(taken + given, np.int64), PRECISIONS[program.arithmetic].largest

    starts = list(range(0, size, FOR_A_THREAD // 2))

    def work() -> bool:
        memory = program.initial.copy()
        unfit = -1
        with suppress(IndexError):  # of no start being left
            while unfit < 0:
                start = starts.pop()
                stop = min(size, start + FOR_A_THREAD // 2)
                unfit = run(program.ints, program.floats, memory, places, largest, start, stop)
        return unfit < 0

    # This thread works as well: it has a processor, and a new one is soon given another.
    others = min(cpu_count() or 1, size // FOR_A_THREAD) - 1
    if others < 1:
        return work()
    with ThreadPoolExecutor(others) as pool:
        doing = [pool.submit(work) for _ in range(others)]
        return all([work(), *(done.result() for done in doing)])


def by_declared_name(
    values: Mapping[str, ArrayLike], names: tuple[str, ...], kind: str
) -> dict[str, ArrayLike]:
    """Return `values` under the names as declared; letter case is ignored (S1)."""
    return {declared_name(name, names, kind): value for name, value in values.items()}


def declared_name(name: str, names: tuple[str, ...], kind: str) -> str:
    """Return the declared name that `name` means; TypeError with the nearest where there is none."""
    for each in names:
        if each.casefold() == name.casefold():
            return each
    near = nearest(name, names)
    hint = f"did you mean {near}?" if near else f"there is {listed(names)}" if names else "there is none"
    raise TypeError(f"no {kind} {name}; {hint}")


def _refuse_unfit(name: str, value: ArrayLike, arithmetic: str) -> None:
    """Raise ValueError for what is not finite, with its first index, or beyond an arithmetic."""
    array = np.asarray(value, np.float64)
    bad = ~np.isfinite(array)
    if bad.any():
        if array.ndim == 0:
            raise ValueError(f"{name} is {array[()]}")
        index = tuple(int(axis) for axis in np.argwhere(bad)[0])
        shown = str(index[0]) if len(index) == 1 else str(index)
        raise ValueError(f"{name} is {array[index]} at index {shown}")
    largest = PRECISIONS[arithmetic].largest
    if (np.abs(array) > largest).any():
        raise ValueError(f"{name} has values beyond {largest:g}, to which {arithmetic} reaches")
