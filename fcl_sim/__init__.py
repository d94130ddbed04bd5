"""fcl_sim: a test bench on which a fuzzy rule base in FCL (IEC 61131-7) is proved in closed loop.

Nothing heavy is imported until a name is used (PEP 562).
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from fcl_sim import interop
    from fcl_sim.block import Block, load, load_all, loads
    from fcl_sim.diagnostics import InputFault
    from fcl_sim.engine.instance import Instance
    from fcl_sim.testbench import OpenLoop, Outcome, open_loop, run

__version__ = "0.1.0"

__all__ = [
    "Block",
    "InputFault",
    "Instance",
    "OpenLoop",
    "Outcome",
    "__version__",
    "interop",
    "load",
    "load_all",
    "loads",
    "open_loop",
    "run",
]

_HOMES = {
    "Block": "fcl_sim.block",
    "InputFault": "fcl_sim.diagnostics",
    "Instance": "fcl_sim.engine.instance",
    "OpenLoop": "fcl_sim.testbench",
    "Outcome": "fcl_sim.testbench",
    "load": "fcl_sim.block",
    "load_all": "fcl_sim.block",
    "loads": "fcl_sim.block",
    "open_loop": "fcl_sim.testbench",
    "run": "fcl_sim.testbench",
}
"""Where each public name lives."""
_ROOMS = ("interop",)
"""Rooms that are named whole."""


def __getattr__(name: str) -> Any:
    if name in _ROOMS:
        return import_module(f"{__name__}.{name}")
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(_HOMES[name]), name)


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
