"""Function blocks in python-control: systems to interconnect, and loops about an operating point.

In: Block, and linear systems of python-control. Out: its NonlinearIOSystem,
Linearisation, poles and margins, and the [plant] of a scenario. May import block and the rooms below; the
only room that imports control, and the simulator does without it.
Tests: tests/interop; page: docs/interop.md.
"""

from fcl_sim.interop.iosystem import to_iosystem
from fcl_sim.interop.linearise import Linearisation, linearise
from fcl_sim.interop.loop import Loop
from fcl_sim.interop.margins import Margins
from fcl_sim.interop.plant import plant_text

__all__ = ["Linearisation", "Loop", "Margins", "linearise", "plant_text", "to_iosystem"]
