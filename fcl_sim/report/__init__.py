"""What a run leaves behind: one PDF, a page for a browser, pictures, and the results as data.

In: Outcomes of testbench, or a Block alone for its pictures. Out: files in a
folder, each whole or not there at all; figures; the document of `--json`.
May import every room below it; `cli` alone imports it. What draws is loaded
when it is asked for. Tests: tests/report.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from fcl_sim.report.results import document

if TYPE_CHECKING:
    from fcl_sim.report.writer import write

__all__ = ["document", "write"]


def __getattr__(name: str) -> Any:
    if name == "write":
        return import_module("fcl_sim.report.writer").write
    raise AttributeError(name)
