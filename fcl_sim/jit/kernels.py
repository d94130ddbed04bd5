"""Compiling: kernels that kernels call, and entries that Python calls, kept on disk.

An entry is compiled at its first call, for one explicit signature, and cached
in a folder keyed by a digest of every kernel source, because numba's own cache
does not notice an edit in a called function of another file.
"""

import sys
from collections.abc import Callable, Mapping
from contextlib import suppress
from pathlib import Path
from threading import Lock
from typing import Any, TypeVar, cast

import numba
from numba.core import caching, targetconfig
from numba.core.compiler import Flags
from numba.core.registry import CPUDispatcher
from numba.core.types.misc import unliteral

from fcl_sim.jit.signatures import compiled
from fcl_sim.jit.singles import Pipeline
from fcl_sim.kernel_cache import cache_folder

Function = TypeVar("Function", bound=Callable[..., Any])

OPTIONS = {"nogil": True, "error_model": "numpy"}
"""How kernels are compiled."""


class _Inner(CPUDispatcher):
    """A function that kernels call. Python gets it as written.

    What numba would make for calls from Python is a fifth of its work.
    """

    def __call__(self, *arguments: Any) -> Any:
        return self.py_func(*arguments)

    def get_call_template(self, args: Any, kws: Any) -> Any:
        """Return how a call is typed: of a constant that is passed its type counts, not its value.

        For each value numba would compile the function anew, and all that it
        calls. What is copied into its caller is the same without.
        """
        plain = {name: unliteral(each) for name, each in kws.items()}
        return super().get_call_template(tuple(map(unliteral, args)), plain)


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
    return _inner(function, Pipeline)


def flat(function: Function) -> Function:
    """Decorate a kernel that makes no arrays: those it is given are not counted as references.

    numba's counting costs an atomic operation or two per array and call, as
    much as a small rule base, wherever its own pruning does not see through.
    """
    return _inner(function, Pipeline, _nrt=False)


def apart(function: Function) -> Function:
    """Decorate a flat kernel that is never copied into its callers, though they are into theirs.

    What is called seldom, or works long, is compiled in less time so.
    """
    return _inner(function, Pipeline, _Apart, _nrt=False)


def inlined(function: Function) -> Function:
    """Decorate a small flat kernel that is copied into its callers."""
    return _inner(function, Pipeline, _nrt=False, forceinline=True)


def copied(function: Function) -> Function:
    """Decorate a kernel that may make arrays and is copied into its callers."""
    return _inner(function, Pipeline, forceinline=True)


def rounded(function: Function) -> Function:
    """Decorate a small flat kernel that computes in binary64 whatever it is given, and rounds its result."""
    return _inner(function, _nrt=False, forceinline=True)


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
        self.salt = salt
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
                    self._ready = _compile(self.function, self._signature, self.salt, self._options)
        return self._ready


def entry(signature: Any, *, flat: bool = False) -> Callable[[Callable[..., Any]], Entry]:
    """Decorate a kernel that Python calls, with its one signature; one that is `flat` makes no arrays."""

    def wrap(function: Callable[..., Any]) -> Entry:
        return Entry(function, signature, flat=flat)

    return wrap


def _compile(
    function: Callable[..., Any], signature: Any, salt: str, options: Mapping[str, Any]
) -> Callable[..., Any]:
    dispatcher: Any = numba.njit(pipeline_class=Pipeline, **options)(function)
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
