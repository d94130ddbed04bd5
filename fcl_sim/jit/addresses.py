"""Buffers by their address: an array costs a call from Python as much as a small rule base.

Whoever takes an address keeps the array alive, and never longer than it. In a
kernel such a buffer has no end that could be looked at.
"""

import ctypes
from collections.abc import Callable
from typing import Any

import numpy as np
from llvmlite import ir
from numba import extending
from numba.core import cgutils, types
from numba.np import arrayobj

from fcl_sim.jit.signatures import compiled

ENDLESS = 1 << 48
"""What a buffer by its address has for a size, in numbers."""


def address(array: np.ndarray[Any, Any]) -> int:
    """Return where the numbers of an array begin; ValueError where they do not follow one another."""
    if not array.flags.c_contiguous:
        raise ValueError("only a contiguous array can be known by its address")
    return int(array.__array_interface__["data"][0])


def _scratch(_: Any, size: Any) -> Any:
    """Type and generate `scratch`."""
    count = getattr(size, "literal_value", None)
    if count is None:
        return None

    def generate(context: Any, builder: Any, signature: Any, _arguments: Any) -> Any:
        own = context.get_data_type(types.float64)
        place = cgutils.alloca_once(builder, ir.ArrayType(own, count))
        builder.store(ir.Constant(ir.ArrayType(own, count), None), place)
        width = context.get_constant(types.intp, context.get_abi_sizeof(own))
        made = context.make_array(signature.return_type)(context, builder)
        arrayobj.populate_array(
            made,
            data=builder.bitcast(place, own.as_pointer()),
            shape=[context.get_constant(types.intp, count)],
            strides=[width],
            itemsize=width,
            meminfo=None,
        )
        return made._getvalue()  # noqa: SLF001

    return types.Array(types.float64, 1, "C")(size), generate


def _typed_buffer(kind: Any, place: Any, size: Any) -> Any:
    """Type and generate a buffer of so many numbers at an address."""
    buffer = types.Array(kind, 1, "C")

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        own = context.get_data_type(kind)
        width = context.get_constant(types.intp, context.get_abi_sizeof(own))
        made = context.make_array(signature.return_type)(context, builder)
        arrayobj.populate_array(
            made,
            data=builder.inttoptr(arguments[0], own.as_pointer()),
            shape=[arguments[1] if len(arguments) > 1 else context.get_constant(types.intp, ENDLESS)],
            strides=[width],
            itemsize=width,
            meminfo=None,
        )
        return made._getvalue()  # noqa: SLF001  numba's name for what a proxy holds

    return (buffer(place) if size is None else buffer(place, size)), generate


def _buffer_of(kind: Any, number: Any) -> Callable[[int], Any]:
    """Return what a kernel calls to have the numbers at an address as a buffer."""

    def typed(_: Any, _place: Any) -> Any:
        return _typed_buffer(kind, types.int64, None)

    def twin(place: int) -> Any:
        return _seen(place, number, ENDLESS)

    made: Callable[[int], Any] = extending.intrinsic(typed) if compiled() else twin
    return made


def _seen(place: int, number: Any, size: int) -> Any:
    pointer = ctypes.cast(ctypes.c_void_p(int(place)), ctypes.POINTER(number))
    return np.ctypeslib.as_array(pointer, (int(size),))


def _part_at(_: Any, _place: Any, _size: Any) -> Any:
    """Type and generate `part_at`."""
    return _typed_buffer(types.float64, types.int64, types.int64)


def _part_at_twin(place: int, size: int) -> Any:
    return _seen(place, ctypes.c_double, size)


part_at: Callable[[int, int], Any] = extending.intrinsic(_part_at) if compiled() else _part_at_twin
"""In a kernel: so many float64 numbers at an address."""
scratch: Callable[[int], Any] = extending.intrinsic(_scratch) if compiled() else np.zeros
"""In a kernel: so many float64 numbers of its own, 0 at first, until it returns; their number is a constant.

The compiler keeps them in registers where they are few and it knows which is meant.
"""
integers_at = _buffer_of(types.int64, ctypes.c_int64)
"""In a kernel: the int64 numbers at an address."""
doubles_at = _buffer_of(types.float64, ctypes.c_double)
"""In a kernel: the float64 numbers at an address."""
singles_at = _buffer_of(types.float32, ctypes.c_float)
"""In a kernel: the float32 numbers at an address."""
bytes_at = _buffer_of(types.uint8, ctypes.c_uint8)
"""In a kernel: the bytes at an address."""
