"""The figures that `fcl-sim eval --figure` and `fcl-sim show wiring --figure` write."""

from collections.abc import Sequence
from datetime import UTC, datetime
from pathlib import Path

from fcl_sim.diagnostics import InputFault
from fcl_sim.engine.explain import Explanation
from fcl_sim.loop.wiring import Wiring
from fcl_sim.model import FunctionBlock
from fcl_sim.report.inference import picture
from fcl_sim.report.pictures import Picture
from fcl_sim.report.sheet import write_sheet
from fcl_sim.report.wiring import pictures as pictures_of_wiring


def write(block: FunctionBlock, explanation: Explanation, source: Path, target: Path) -> None:
    """Write the figure of an explanation of `block`, dated as `source`; the ending of `target` says how.

    InputFault where the folder does not exist, or for another ending.
    """
    _write([picture(block, explanation)], source, target)


def write_wiring(wiring: Wiring, title: str, source: Path, target: Path) -> None:
    """Write the figure of a wiring in the same way."""
    _write(pictures_of_wiring(wiring, title), source, target)


def _write(drawn: Sequence[Picture], source: Path, target: Path) -> None:
    if not target.parent.is_dir():
        hint = "make the folder, or name another one"
        raise InputFault.at_file("RUN101", str(target), f"there is no folder `{target.parent}`", hint)
    date = datetime.fromtimestamp(int(source.stat().st_mtime), UTC)
    write_sheet(drawn, target, date)
