"""Kernels in binary32: their constants, and the proof that nothing in them is binary64.

One text serves two precisions: a kernel that is given binary32 numbers and no
binary64 ones computes in binary32 throughout, as it does uncompiled, where
NumPy lets a literal take the precision of its partner. For numba its float
constants are made binary32, and a binary64 number that is left is an error of
compiling.
"""

from collections.abc import Iterator
from typing import Any

import numpy as np
from numba.core import errors, ir, types
from numba.core.compiler import CompilerBase, DefaultPassBuilder
from numba.core.compiler_machinery import AnalysisPass, FunctionPass, register_pass
from numba.core.typed_passes import NopythonTypeInference
from numba.core.untyped_passes import IRProcessing

CompileError = errors.NumbaError
"""What compiling raises of code outside numba's subset."""


def _precisions(kind: Any) -> Iterator[Any]:
    """Yield the float types that a type is made of."""
    if isinstance(kind, types.Float):
        yield kind
    elif isinstance(kind, types.Array):
        yield from _precisions(kind.dtype)
    elif isinstance(kind, types.containers.BaseTuple):
        for each in kind.types:
            yield from _precisions(each)


def _is_single(state: Any) -> bool:
    """Return whether a kernel is compiled for binary32."""
    return {each for kind in state.args for each in _precisions(kind)} == {types.float32}


def _singly(value: Any) -> Any:
    """Return a constant with its floats in binary32."""
    if isinstance(value, float):
        return np.float32(value)
    return tuple(map(_singly, value)) if type(value) is tuple else value


@register_pass(mutates_CFG=False, analysis_only=False)
class _SingleConstants(FunctionPass):
    """Make the float constants of a kernel binary32, where all else that it is given is."""

    _name = "fcl_sim_single_constants"

    def __init__(self) -> None:
        super().__init__()

    def run_pass(self, state: Any) -> bool:
        if not _is_single(state):
            return False
        for block in state.func_ir.blocks.values():
            for assignment in block.find_insts(ir.Assign):
                if isinstance(assignment.value, ir.Const | ir.Global | ir.FreeVar):
                    assignment.value.value = _singly(assignment.value.value)
        return True


@register_pass(mutates_CFG=False, analysis_only=True)
class _SingleThroughout(AnalysisPass):
    """Refuse a kernel that is compiled for binary32 and comes by a binary64 number."""

    _name = "fcl_sim_single_throughout"

    def __init__(self) -> None:
        super().__init__()

    def run_pass(self, state: Any) -> bool:
        if _is_single(state):
            results = [each.return_type for each in state.calltypes.values() if each is not None]
            for name, kind in [*state.typemap.items(), *(("a result", each) for each in results)]:
                if types.float64 in _precisions(kind):
                    message = f"{name} is binary64 in {state.func_id.func_qualname}, called with binary32"
                    raise CompileError(message)
        return False


class Pipeline(CompilerBase):
    """The way of a kernel: numba's own passes, and ours before and behind the one that infers types."""

    def define_pipelines(self) -> list[Any]:
        """Return the one way, as numba asks for it."""
        passes = DefaultPassBuilder.define_nopython_pipeline(self.state)
        passes.add_pass_after(_SingleConstants, IRProcessing)
        passes.add_pass_after(_SingleThroughout, NopythonTypeInference)
        passes.finalize()
        return [passes]
