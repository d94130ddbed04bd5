"""Several numbers of a buffer in one instruction, where the compiler does not see that it could.

Each operation has a twin for the uncompiled mode, and gives the same bits as
the numbers one by one: lanes are added and multiplied, never contracted.
Buffers are of one type; indices into them are unsigned.
"""

from collections.abc import Callable, Iterable
from typing import Any

import numpy as np
from llvmlite import ir as llvm
from numba import extending
from numba.core import cgutils, types
from numba.np import arrayobj

from fcl_sim.jit.signatures import compiled

WORD = llvm.IntType(64)


def _intrinsic(typed: Callable[..., Any], twin: Callable[..., Any]) -> Callable[..., Any]:
    """Return what a kernel calls: compiled, what `typed` generates; uncompiled, its twin."""
    made: Callable[..., Any] = extending.intrinsic(typed) if compiled() else twin
    return made


class _Lanes:
    """Vectors of some lanes, in the code of an intrinsic that is given `values` of the types `kinds`."""

    def __init__(self, lanes: int, context: Any, builder: Any, kinds: Any, values: Any) -> None:
        self.one = context.get_value_type(next(kind.dtype for kind in kinds if isinstance(kind, types.Array)))
        self.type = llvm.VectorType(self.one, lanes)
        self._lanes, self._context, self._builder = lanes, context, builder
        self._kinds, self._values = kinds, values

    def at(self, buffer: int, index: Any) -> Any:
        """Return a pointer to the numbers of the buffer that is argument `buffer`, from an index on."""
        proxy = cgutils.create_struct_proxy(self._kinds[buffer])
        data = proxy(self._context, self._builder, value=self._values[buffer]).data
        return self._builder.bitcast(self._builder.gep(data, [index]), self.type.as_pointer())

    def load(self, buffer: int, index: Any) -> Any:
        """Return the numbers of a buffer from an index on, which need not be a multiple of the lanes."""
        return self._builder.load(self.at(buffer, index), align=4)

    def store(self, vector: Any, buffer: int, index: Any) -> None:
        """Set the numbers of a buffer from an index on."""
        self._builder.store(vector, self.at(buffer, index), align=4)

    def of(self, numbers: Iterable[Any]) -> Any:
        """Return a vector of numbers, one for each lane."""
        vector = llvm.Constant(self.type, llvm.Undefined)
        for lane, number in enumerate(numbers):
            vector = self._builder.insert_element(vector, number, llvm.Constant(llvm.IntType(32), lane))
        return vector

    def spread(self, number: Any) -> Any:
        """Return a vector that has one number in all lanes."""
        return self.of([number] * self._lanes)


def _clear_eight(typing: Any, memory: Any, at: Any) -> Any:
    """Type and generate `clear_eight`."""

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        four = _Lanes(4, context, builder, signature.args, arguments)
        for first in (0, 4):
            place = builder.add(arguments[1], llvm.Constant(WORD, first))
            four.store(llvm.Constant(four.type, None), 0, place)
        return context.get_dummy_value()

    return types.void(memory, types.uint64), generate


def _clear_eight_twin(memory: Any, at: int) -> None:
    memory[at : at + 8] = 0.0


clear_eight: Callable[[Any, Any], None] = _intrinsic(_clear_eight, _clear_eight_twin)
"""In a kernel: set eight numbers of a buffer to 0, from an index on, by two stores of four."""


def _two_ramps(typing: Any, x: Any, buffer: Any, at: Any) -> Any:
    """Type and generate `two_ramps`."""

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        two = _Lanes(2, context, builder, signature.args, arguments)
        origin, value, run = (
            two.load(1, builder.add(arguments[2], llvm.Constant(WORD, first))) for first in (0, 2, 4)
        )
        risen = builder.fadd(value, builder.fdiv(builder.fsub(two.spread(arguments[0]), origin), run))
        top = two.spread(llvm.Constant(two.one, 1.0))
        result = builder.select(builder.fcmp_ordered("<", top, risen), top, risen)
        lanes = [builder.extract_element(result, llvm.Constant(llvm.IntType(32), lane)) for lane in (0, 1)]
        return context.make_tuple(builder, signature.return_type, lanes)

    return types.containers.UniTuple(buffer.dtype, 2)(x, buffer, types.uint64), generate


def _two_ramps_twin(x: Any, buffer: Any, at: int) -> tuple[Any, Any]:
    first, second = (
        buffer[at + 2 + lane] + (x - buffer[at + lane]) / buffer[at + 4 + lane] for lane in (0, 1)
    )
    return (1.0 if first > 1.0 else first), (1.0 if second > 1.0 else second)  # noqa: FURB136  NaN stays


two_ramps: Callable[[Any, Any, Any], tuple[Any, Any]] = _intrinsic(_two_ramps, _two_ramps_twin)
"""In a kernel: min(1, value + (x - origin) / run) for two ramps, by one division of two numbers.

From an index on, the buffer holds the two origins, the two values, the two runs.
"""


def _copy(lanes: int) -> Callable[[Any, Any, Any, Any], None]:
    """Return what copies so many numbers at once."""

    def typed(_: Any, target: Any, to: Any, source: Any, at: Any) -> Any:
        def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
            own = _Lanes(lanes, context, builder, signature.args, arguments)
            own.store(own.load(2, arguments[3]), 0, arguments[1])
            return context.get_dummy_value()

        return types.void(target, types.uint64, source, types.uint64), generate

    def twin(target: Any, to: int, source: Any, at: int) -> None:
        target[to : to + lanes] = source[at : at + lanes]

    return _intrinsic(typed, twin)


copy_two, copy_four = _copy(2), _copy(4)
"""In a kernel: set two or four numbers of a buffer, from an index on, to those of another."""


def _put_four(typing: Any, target: Any, to: Any, a: Any, b: Any, c: Any, d: Any) -> Any:
    """Type and generate `put_four`."""

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        four = _Lanes(4, context, builder, signature.args, arguments)
        four.store(four.of(arguments[2:]), 0, arguments[1])
        return context.get_dummy_value()

    number = target.dtype
    return types.void(target, types.uint64, number, number, number, number), generate


def _put_four_twin(target: Any, to: int, a: float, b: float, c: float, d: float) -> None:
    target[to : to + 4] = a, b, c, d


put_four: Callable[[Any, Any, Any, Any, Any, Any], None] = _intrinsic(_put_four, _put_four_twin)
"""In a kernel: set four numbers of a buffer at once: who reads them at once need not wait for each."""


def _shift_four(
    typing: Any,
    target: Any,
    to: Any,
    origin: Any,
    origin_at: Any,
    weight: Any,
    way: Any,
    way_at: Any,
) -> Any:
    """Type and generate `shift_four`."""

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        four = _Lanes(4, context, builder, signature.args, arguments)
        step = builder.fmul(four.spread(arguments[4]), four.load(5, arguments[6]))
        four.store(builder.fadd(four.load(2, arguments[3]), step), 0, arguments[1])
        return context.get_dummy_value()

    word = types.uint64
    return types.void(target, word, origin, word, weight, way, word), generate


def _shift_four_twin(
    target: Any, to: int, origin: Any, origin_at: int, weight: Any, way: Any, way_at: int
) -> None:
    target[to : to + 4] = origin[origin_at : origin_at + 4] + weight * way[way_at : way_at + 4]


shift_four: Callable[[Any, Any, Any, Any, Any, Any, Any], None] = _intrinsic(_shift_four, _shift_four_twin)
"""In a kernel: set four numbers of a buffer to those of an origin plus a weight times those of a way."""


def _combine_four(
    typing: Any,
    target: Any,
    to: Any,
    weights: Any,
    weights_at: Any,
    rows: Any,
    rows_at: Any,
    apart: Any,
    count: Any,
) -> Any:
    """Type and generate `combine_four`."""

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        four = _Lanes(4, context, builder, signature.args, arguments)
        _, to, weights, weights_at, _, rows_at, apart, count = arguments
        proxy = cgutils.create_struct_proxy(signature.args[2])
        numbers = proxy(context, builder, value=weights).data
        total = cgutils.alloca_once_value(builder, llvm.Constant(four.type, None))
        with cgutils.for_range(builder, count, intp=WORD) as loop:
            weight = builder.load(builder.gep(numbers, [builder.add(weights_at, loop.index)]))
            row = four.load(4, builder.add(rows_at, builder.mul(loop.index, apart)))
            builder.store(builder.fadd(builder.load(total), builder.fmul(four.spread(weight), row)), total)
        four.store(builder.load(total), 0, to)
        return context.get_dummy_value()

    word = types.uint64
    return types.void(target, word, weights, word, rows, word, word, word), generate


def _combine_four_twin(
    target: Any, to: int, weights: Any, weights_at: int, rows: Any, rows_at: int, apart: int, count: int
) -> None:
    total = np.zeros_like(target[to : to + 4])
    for number in range(count):
        row = rows_at + number * apart
        total += weights[weights_at + number] * rows[row : row + 4]
    target[to : to + 4] = total


combine_four: Callable[[Any, Any, Any, Any, Any, Any, Any, Any], None] = _intrinsic(
    _combine_four, _combine_four_twin
)
"""In a kernel: set four numbers of a buffer to the sum of as many rows of four, each times its weight.

The weights follow one another, the rows begin `apart` numbers from one another.
"""


def _stretch(typing: Any, buffer: Any, at: Any, size: Any) -> Any:
    """Type and generate `stretch`."""

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        kind = signature.args[0]
        whole = context.make_array(kind)(context, builder, value=arguments[0])
        part = context.make_array(kind)(context, builder)
        width = context.get_constant(types.intp, context.get_abi_sizeof(context.get_data_type(kind.dtype)))
        arrayobj.populate_array(
            part,
            data=builder.gep(whole.data, [arguments[1]]),
            shape=[arguments[2]],
            strides=[width],
            itemsize=width,
            meminfo=None,
        )
        return part._getvalue()  # noqa: SLF001  numba's name for what a proxy holds

    return buffer(buffer, types.uint64, types.uint64), generate


def _stretch_twin(buffer: Any, at: int, size: int) -> Any:
    return buffer[at : at + size]


stretch: Callable[[Any, Any, Any], Any] = _intrinsic(_stretch, _stretch_twin)
"""In a flat kernel: a part of a buffer as a buffer, from an index on, without a look at where either ends."""
