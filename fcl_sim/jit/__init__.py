"""`kernel` and `entry`: Python that becomes machine code. The only room that imports numba.

In: functions in numba's subset of Python, and signatures. Out: kernels that
other kernels call, entries that Python calls; with `NUMBA_DISABLE_JIT=1` the
same text runs uncompiled. May import kernel_cache. Tests: tests/jit.
"""

from fcl_sim.jit.addresses import address, bytes_at, doubles_at, integers_at, part_at, scratch, singles_at
from fcl_sim.jit.kernels import Entry, apart, copied, entry, flat, inlined, kernel, rounded
from fcl_sim.jit.signatures import (
    F4,
    FF,
    F,
    I,
    b1,
    compiled,
    f8,
    function_type,
    i8,
    links_type,
    new_links,
    signature,
    u,
    void,
)
from fcl_sim.jit.singles import CompileError
from fcl_sim.jit.vectors import (
    clear_eight,
    combine_four,
    copy_four,
    copy_two,
    put_four,
    shift_four,
    stretch,
    two_ramps,
)

__all__ = [
    "F4",
    "FF",
    "CompileError",
    "Entry",
    "F",
    "I",
    "address",
    "apart",
    "b1",
    "bytes_at",
    "clear_eight",
    "combine_four",
    "compiled",
    "copied",
    "copy_four",
    "copy_two",
    "doubles_at",
    "entry",
    "f8",
    "flat",
    "function_type",
    "i8",
    "inlined",
    "integers_at",
    "kernel",
    "links_type",
    "new_links",
    "part_at",
    "put_four",
    "rounded",
    "scratch",
    "shift_four",
    "signature",
    "singles_at",
    "stretch",
    "two_ramps",
    "u",
    "void",
]
