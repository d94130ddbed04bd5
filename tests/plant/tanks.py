"""A plant of a tank that keeps the contract, and what is told of one that does not."""

import pytest

from fcl_sim.diagnostics import InputFault
from fcl_sim.plant.catalog import load

GOOD = """from fcl_sim.plant import *

PLANT = Plant(
    name="tank", title="tank",
    states=(State("level", "m", 1.0, "level"), State("flow", "m3/s", 0.0, "flow")),
    inputs=(Input("valve", "1", "opening"),),
    outputs=(Output("level", "m", "level"),),
    parameters=(Parameter("area", "m2", 2.0, "area", "[A]"),),
)


@kernel
def rate(flow, area):
    return -flow / area


def dynamics(t, x, u, p, mode, dx):
    dx[0] = rate(x[1], p[0])
    dx[1] = u[0] - x[1]


def outputs(t, x, u, p, mode, y):
    y[0] = x[0]
"""


def written(tmp_path, *changes):
    """Return the path of the tank's file, each old text in it replaced by a new one."""
    text = GOOD
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    path = tmp_path / "tank.py"
    path.write_text(text, encoding="utf-8")
    return path


def refusal(tmp_path, *changes, use=load):
    """Return all that is told where the changed tank is loaded, or used as `use` does."""
    path = written(tmp_path, *changes)
    with pytest.raises(InputFault) as caught:
        use(path)
    return str(caught.value).replace(str(path), "plants/tank.py")
