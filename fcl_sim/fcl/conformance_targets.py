"""What a user calls a target → its statement: one that is shipped, or a file."""

import os

from fcl_sim.diagnostics import InputFault, nearest
from fcl_sim.diagnostics.spelling import listed
from fcl_sim.fcl.conformance_statement import Statement, read_statement
from fcl_sim.fcl.files import open_source
from fcl_sim.fcl.targets import NAMES, shipped

SUFFIX = ".toml"


def target(name: str) -> Statement:
    """Return the statement of a target: of a shipped one by its name, else of a file.

    InputFault with everything that is wrong with it, or where there is none.
    """
    if name.casefold() in NAMES:
        return read_statement(shipped(name.casefold()))
    if name.endswith(SUFFIX) or os.sep in name or os.path.exists(name):  # noqa: PTH110  any text may come
        return read_statement(open_source(name))
    near = nearest(name, NAMES)
    hint = f"did you mean `{near}`?" if near else f"there is {listed(NAMES)}, or a file {SUFFIX}"
    raise InputFault.at_file("FCL520", "", f"there is no target `{name}`", hint)
