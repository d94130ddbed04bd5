"""Linear plants under blocks alone, for laws that are known in closed form."""

from fcl_sim.loop.diagram import Diagram, Node, PlantNode, Timing, Wire
from fcl_sim.loop.run import run
from fcl_sim.loop.trace import Trace
from fcl_sim.plant.declaration import Input, Output
from fcl_sim.plant.linear import StateSpace, linear_plant


def diagram(
    system: StateSpace,
    timing: Timing,
    *nodes: Node,
    source: str = "u",
    delay: float = 0.0,
    start: float = 0.0,
) -> Diagram:
    """A plant `plant` with the input `u` and the output `y`, driven by the signal `source`.

    Its input comes `delay` seconds late; before the first write it is `start`.
    """
    inputs, outputs = [Input("u", "", "", start)], [Output("y", "", "")]
    model = linear_plant(system, inputs=inputs, outputs=outputs, delay=round(delay * 1e9))
    plant = PlantNode(name="plant", model=model, inputs={"u": Wire(source)})
    return Diagram(plant=plant, nodes=nodes, timing=timing)


def simulated(
    system: StateSpace, timing: Timing, *nodes: Node, source: str = "u", delay: float = 0.0
) -> Trace:
    """Return the trace of such a loop, run to its end."""
    trace = run(diagram(system, timing, *nodes, source=source, delay=delay))
    assert trace.fault is None
    return trace
