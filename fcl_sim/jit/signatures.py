"""What kernels are given: the types of arguments, and functions that were linked once."""

from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

import numba
import numpy as np
from numba.core import types
from numba.experimental import structref

F = types.Array(types.float64, 1, "C")
"""Signature part: a contiguous float64 buffer."""
F4 = types.Array(types.float32, 1, "C")
"""Signature part: a contiguous float32 buffer."""
I = types.Array(types.int64, 1, "C")  # noqa: E741  the pair of F
"""Signature part: a contiguous int64 buffer."""
FF = types.Array(types.float64, 2, "C")
f8 = types.float64
i8 = types.int64
b1 = types.boolean
void = types.void
u = np.uint64
"""An index that is never negative: `buffer[u(at + 3)]` spares the test for wrap-around."""


def compiled() -> bool:
    """Return whether kernels are compiled (not `NUMBA_DISABLE_JIT`)."""
    return not numba.config.DISABLE_JIT


def signature(result: Any, *arguments: Any) -> Any:
    """Return the signature of an entry, from the parts above."""
    return result(*arguments)


def function_type(result: Any, *arguments: Any) -> Any:
    """Return the signature part of an argument that is itself a kernel (first-class function)."""
    return types.FunctionType(result(*arguments))


class Links(structref.StructRefProxy):
    """First-class functions that were linked once; see `links_type`."""


@structref.register
class LinksType(types.StructRef):  # type: ignore[name-defined]
    """numba's type of `Links`."""


structref.define_boxing(LinksType, Links)


def links_type(**functions: Any) -> Any:
    """Return the signature part of an argument that holds first-class functions, each by its name.

    As arguments of their own they would cost a tenth of a millisecond each at
    every call from Python, in which numba looks their addresses up.
    """
    return LinksType(tuple(functions.items()))


new_links: Callable[[Any], Any] = (lambda _: SimpleNamespace()) if numba.config.DISABLE_JIT else structref.new
"""In a kernel: make an object of a `links_type`, whose attributes are still to be set."""
