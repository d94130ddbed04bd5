"""The figure of an inference that `fcl-sim eval --figure` writes."""

from datetime import UTC, datetime
from pathlib import Path

from fcl_sim.diagnostics import InputFault
from fcl_sim.engine.explain import Explanation
from fcl_sim.model import FunctionBlock
from fcl_sim.report.inference import picture
from fcl_sim.report.sheet import write_sheet


def write(block: FunctionBlock, explanation: Explanation, source: Path, target: Path) -> None:
    """Write the figure of an explanation of `block`, dated as `source`; the ending of `target` says how.

    InputFault where the folder does not exist, or for another ending.
    """
    if not target.parent.is_dir():
        hint = "make the folder, or name another one"
        raise InputFault.at_file("RUN101", str(target), f"there is no folder `{target.parent}`", hint)
    date = datetime.fromtimestamp(int(source.stat().st_mtime), UTC)
    write_sheet([picture(block, explanation)], target, date)
