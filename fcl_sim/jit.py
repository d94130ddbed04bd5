"""`kernel` and `entry`: the only file that imports numba.

A kernel is plain Python in numba's subset. `NUMBA_DISABLE_JIT=1` runs the same
text uncompiled. One text serves two precisions: a kernel that is given binary32
numbers and no binary64 ones computes in binary32 throughout, as it does
uncompiled, where NumPy lets a literal take the precision of its partner; for
numba its float constants are made binary32, and a binary64 number that is left
is an error of compiling. An entry is a kernel that Python calls: it is compiled at its
first call, for one explicit signature, and cached on disk in a folder keyed by
a digest of every kernel source, because numba's own cache does not notice an
edit in a called function of another file.
"""

import sys
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from pathlib import Path
from threading import Lock
from types import SimpleNamespace
from typing import Any, TypeVar, cast

import numba
import numpy as np
from llvmlite import ir as llvm
from numba import extending
from numba.core import caching, cgutils, errors, ir, targetconfig, types
from numba.core.compiler import CompilerBase, DefaultPassBuilder, Flags
from numba.core.compiler_machinery import AnalysisPass, FunctionPass, register_pass
from numba.core.registry import CPUDispatcher
from numba.core.typed_passes import NopythonTypeInference
from numba.core.untyped_passes import IRProcessing
from numba.experimental import structref

from fcl_sim.kernel_cache import cache_folder

Function = TypeVar("Function", bound=Callable[..., Any])

CompileError = errors.NumbaError
"""What compiling raises of code outside numba's subset."""

OPTIONS = {"nogil": True, "error_model": "numpy"}
"""How kernels are compiled."""

F = types.Array(types.float64, 1, "C")
"""Signature part: a contiguous float64 buffer."""
F4 = types.Array(types.float32, 1, "C")
"""Signature part: a contiguous float32 buffer."""
I = types.Array(types.int64, 1, "C")  # noqa: E741  the pair of F
"""Signature part: a contiguous int64 buffer."""
FF = types.Array(types.float64, 2, "C")
f8 = types.float64
i8 = types.int64
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


def _clear_eight(typing: Any, memory: Any, at: Any) -> Any:  # noqa: ARG001  numba's signature
    """Type and generate `clear_eight`."""

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        kind = signature.args[0]
        buffer = cgutils.create_struct_proxy(kind)(context, builder, value=arguments[0])
        four = llvm.VectorType(context.get_value_type(kind.dtype), 4)
        first = builder.gep(buffer.data, [arguments[1]])
        halves = builder.bitcast(first, four.as_pointer())
        for half in range(2):
            place = builder.gep(halves, [llvm.Constant(llvm.IntType(64), half)])
            builder.store(llvm.Constant(four, None), place, align=4)
        return context.get_dummy_value()

    return types.void(memory, types.uint64), generate


def _clear_eight_uncompiled(memory: Any, at: int) -> None:
    memory[at : at + 8] = 0.0


clear_eight: Callable[[Any, Any], None] = (
    extending.intrinsic(_clear_eight) if compiled() else _clear_eight_uncompiled
)
"""In a kernel: set eight numbers of a buffer to 0, from an unsigned index on, by two stores of four."""


def _two_ramps(typing: Any, x: Any, buffer: Any, at: Any) -> Any:  # noqa: ARG001
    """Type and generate `two_ramps`."""

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        kind = signature.args[1]
        one = context.get_value_type(kind.dtype)
        two = llvm.VectorType(one, 2)
        data = cgutils.create_struct_proxy(kind)(context, builder, value=arguments[1]).data

        def pair(number: int) -> Any:
            first = builder.bitcast(builder.gep(data, [arguments[2]]), two.as_pointer())
            return builder.load(builder.gep(first, [llvm.Constant(llvm.IntType(64), number)]), align=4)

        both = llvm.Constant(two, llvm.Undefined)
        for lane in range(2):
            both = builder.insert_element(both, arguments[0], llvm.Constant(llvm.IntType(32), lane))
        risen = builder.fadd(pair(1), builder.fdiv(builder.fsub(both, pair(0)), pair(2)))
        top = llvm.Constant(two, [llvm.Constant(one, 1.0)] * 2)
        result = builder.select(builder.fcmp_ordered("<", top, risen), top, risen)
        lanes = [builder.extract_element(result, llvm.Constant(llvm.IntType(32), lane)) for lane in range(2)]
        return context.make_tuple(builder, signature.return_type, lanes)

    return types.containers.UniTuple(buffer.dtype, 2)(x, buffer, types.uint64), generate


def _two_ramps_uncompiled(x: Any, buffer: Any, at: int) -> tuple[Any, Any]:
    first, second = (
        buffer[at + 2 + lane] + (x - buffer[at + lane]) / buffer[at + 4 + lane] for lane in (0, 1)
    )
    return (1.0 if first > 1.0 else first), (1.0 if second > 1.0 else second)  # noqa: FURB136  NaN stays


two_ramps: Callable[[Any, Any, Any], tuple[Any, Any]] = (
    extending.intrinsic(_two_ramps) if compiled() else _two_ramps_uncompiled
)
"""In a kernel: min(1, value + (x - origin) / run) for two ramps, by one division of two numbers.

From an unsigned index on, the buffer holds the two origins, the two values, the two runs.
"""

new_links: Callable[[Any], Any] = (lambda _: SimpleNamespace()) if numba.config.DISABLE_JIT else structref.new
"""In a kernel: make an object of a `links_type`, whose attributes are still to be set."""


class _Inner(CPUDispatcher):
    """A function that kernels call. Python gets it as written.

    What numba would make for calls from Python is a fifth of its work.
    """

    def __call__(self, *arguments: Any) -> Any:
        return self.py_func(*arguments)


class _Apart(_Inner):
    """One that is compiled as if nobody called it: numba hands options of a caller on to what it calls."""

    def compile(self, sig: Any) -> Any:
        with targetconfig.ConfigStack().enter(Flags()):
            return super().compile(sig)


def _inner(function: Function, pipeline: Any = None, kind: type[_Inner] = _Inner, **options: Any) -> Function:
    if not compiled():
        return function
    wrappers = {"no_cpython_wrapper": True, "no_cfunc_wrapper": True}
    own = {} if pipeline is None else {"pipeline_class": pipeline}
    dispatcher: Any = kind(
        function, targetoptions={"nopython": True, **OPTIONS, **wrappers, **options}, **own
    )
    return cast("Function", dispatcher)


def kernel(function: Function) -> Function:
    """Decorate a function that only other kernels call, in numba's subset."""
    return _inner(function, _Pipeline)


def flat(function: Function) -> Function:
    """Decorate a kernel that makes no arrays: those it is given are not counted as references.

    numba's counting costs an atomic operation or two per array and call, as
    much as a small rule base, wherever its own pruning does not see through.
    """
    return _inner(function, _Pipeline, _nrt=False)


def apart(function: Function) -> Function:
    """Decorate a flat kernel that is never copied into its callers, though they are into theirs.

    What is called seldom, or works long, is compiled in less time so.
    """
    return _inner(function, _Pipeline, _Apart, _nrt=False)


def inlined(function: Function) -> Function:
    """Decorate a small flat kernel that is copied into its callers."""
    return _inner(function, _Pipeline, _nrt=False, forceinline=True)


def rounded(function: Function) -> Function:
    """Decorate a small flat kernel that computes in binary64 whatever it is given, and rounds its result."""
    return _inner(function, _nrt=False, forceinline=True)


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


class _Pipeline(CompilerBase):
    """numba's own passes, and ours before and behind the one that infers types."""

    def define_pipelines(self) -> list[Any]:
        passes = DefaultPassBuilder.define_nopython_pipeline(self.state)
        passes.add_pass_after(_SingleConstants, IRProcessing)
        passes.add_pass_after(_SingleThroughout, NopythonTypeInference)
        passes.finalize()
        return [passes]


class Entry:
    """A kernel that Python calls, compiled at the first call for one signature.

    Called like the function it holds; arguments must match the signature
    exactly (contiguous arrays of the stated type). `salt` is what its machine
    code depends on besides the package's kernel sources. One that is `flat`
    makes no arrays, as a `flat` kernel.
    """

    def __init__(
        self, function: Callable[..., Any], signature: Any, salt: str = "", *, flat: bool = False
    ) -> None:
        self.function = function
        self._signature = signature
        self._salt = salt
        self._options = {**OPTIONS, "_nrt": False} if flat else OPTIONS
        self._ready: Callable[..., Any] | None = None
        self._compiling = Lock()

    def __call__(self, *arguments: Any) -> Any:
        """Call the compiled function."""
        return self.compile()(*arguments)

    def compile(self) -> Callable[..., Any]:
        """Return the compiled function, from the cache where it has one."""
        if self._ready is None:
            with self._compiling:
                if self._ready is None:
                    self._ready = _compile(self.function, self._signature, self._salt, self._options)
        return self._ready


def entry(signature: Any, *, flat: bool = False) -> Callable[[Callable[..., Any]], Entry]:
    """Decorate a kernel that Python calls, with its one signature; one that is `flat` makes no arrays."""

    def wrap(function: Callable[..., Any]) -> Entry:
        return Entry(function, signature, flat=flat)

    return wrap


def _compile(
    function: Callable[..., Any], signature: Any, salt: str, options: Mapping[str, Any]
) -> Callable[..., Any]:
    dispatcher: Any = numba.njit(pipeline_class=_Pipeline, **options)(function)
    if not compiled():
        return cast("Callable[..., Any]", dispatcher)
    folder = cache_folder(salt)
    if folder is not None:
        dispatcher._cache = _cache_in(folder)(dispatcher.py_func)  # noqa: SLF001  numba has no public hook for a locator
    dispatcher.compile(signature)
    dispatcher.disable_compile()
    return cast("Callable[..., Any]", dispatcher)


def _cache_in(folder: Path) -> type[caching.FunctionCache]:
    """Return a numba function cache that lives in `folder`, whatever numba's own settings are."""

    class Locator(caching._CacheLocator):  # noqa: SLF001
        def __init__(self, py_func: Any) -> None:
            self._line = py_func.__code__.co_firstlineno
            self._py_file = py_func.__code__.co_filename

        def get_cache_path(self) -> str:
            return str(folder)

        def get_source_stamp(self) -> str:
            return folder.name

        def get_disambiguator(self) -> str:
            return str(self._line)

        @classmethod
        def from_function(cls, py_func: Any, py_file: str) -> "Locator":  # noqa: ARG003  numba's signature
            return cls(py_func)

    class Implementation(caching.CompileResultCacheImpl):
        def __init__(self, py_func: Any) -> None:
            # numba's own choice of a locator would ask the user's settings first
            self._lineno = py_func.__code__.co_firstlineno
            self._locator = Locator(py_func)
            name = f"{py_func.__module__.rpartition('.')[2]}.{py_func.__qualname__}"
            self._filename_base = self.get_filename_base(name, getattr(sys, "abiflags", ""))

    class Kernels(caching.FunctionCache):
        _impl_class = Implementation

        def load_overload(self, sig: Any, target_context: Any) -> Any:
            try:
                return super().load_overload(sig, target_context)
            except Exception:  # noqa: BLE001  a cut-off or foreign file is no reason to fail: compile again
                with suppress(OSError):
                    self.flush()
                return None

        def save_overload(self, sig: Any, data: Any) -> None:
            with suppress(OSError):
                super().save_overload(sig, data)

    return Kernels
