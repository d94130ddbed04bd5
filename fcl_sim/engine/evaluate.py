"""Many evaluations over arrays, and the checks of what goes in (S37)."""

from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from itertools import pairwise
from math import prod
from os import cpu_count

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fcl_sim.diagnostics import nearest
from fcl_sim.diagnostics.spelling import listed
from fcl_sim.engine.entries import many_for
from fcl_sim.engine.precision import PRECISIONS
from fcl_sim.engine.program import Floats, Program

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
    former = by_declared_name(previous or {}, program.output_names, "output")
    starts = program.initial
    given = {**inputs, **former}
    names = (*program.input_names, *program.output_names)
    columns = [
        within(name, given[name], program.arithmetic) if name in given else starts[i : i + 1].reshape(())
        for i, name in enumerate(names)
    ]
    shape = np.broadcast_shapes(*(column.shape for column in columns))
    points = np.empty((program.degrees_at, *shape), starts.dtype)
    for i, column in enumerate(columns):
        points[i, ...] = column
    _in_threads(program, points.reshape(-1), prod(shape))
    outputs, active = points[program.outputs_at : program.active_at], points[program.active_at :] != 0.0
    return Evaluation(
        {name: outputs[i, ...].astype(np.float64, copy=False) for i, name in enumerate(program.output_names)},
        {name: active[i, ...] for i, name in enumerate(program.output_names)},
    )


def checked_names(
    program: Program, values: Mapping[str, ArrayLike], optional: frozenset[str]
) -> dict[str, ArrayLike]:
    """Return `values` by declared names; TypeError for one that is missing or unknown."""
    inputs = by_declared_name(values, program.input_names, "input")
    for name in program.input_names:
        if name not in inputs and name not in optional:
            raise TypeError(f"{program.name} needs a value for {name}")
    return inputs


def _in_threads(program: Program, points: Floats, size: int) -> None:
    """Evaluate all points, many of them on all processors: the kernel holds no lock of the interpreter."""
    run = many_for(program).compile()

    def stretch(start: int, stop: int) -> None:
        run(program.ints, program.floats, program.initial.copy(), points, start, stop)

    workers = min(cpu_count() or 1, size // FOR_A_THREAD)
    if workers < 2:
        stretch(0, size)
        return
    ends = [size * part // workers for part in range(workers + 1)]
    with ThreadPoolExecutor(workers) as pool:
        for done in [pool.submit(stretch, *pair) for pair in pairwise(ends)]:
            done.result()


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


def finite(name: str, value: ArrayLike) -> Values:
    """Return `value` as an array of finite numbers; ValueError names the variable and the first bad index."""
    array = np.asarray(value, np.float64)
    bad = ~np.isfinite(array)
    if bad.any():
        if array.ndim == 0:
            raise ValueError(f"{name} is {array[()]}")
        index = tuple(int(axis) for axis in np.argwhere(bad)[0])
        shown = str(index[0]) if len(index) == 1 else str(index)
        raise ValueError(f"{name} is {array[index]} at index {shown}")
    return array


def within(name: str, value: ArrayLike, arithmetic: str) -> Values:
    """Return what `finite` does; ValueError too for what an arithmetic cannot hold."""
    array = finite(name, value)
    largest = PRECISIONS[arithmetic].largest
    if arithmetic != "LREAL" and array.size > 0 and np.abs(array).max() > largest:
        raise ValueError(f"{name} has values beyond {largest:g}, to which {arithmetic} reaches")
    return array
