"""Findings about a user's input: where, what, and what would be right.

In: texts with places in them. Out: `Diagnostic` values and their rendering.
Imports nothing of fcl_sim. A room that reads input collects diagnostics and
never stops at the first; `InputFault` carries them to the door.
Tests: tests/diagnostics.
"""

from fcl_sim.diagnostics.diagnostic import Diagnostic, Place, Severity
from fcl_sim.diagnostics.fault import InputFault
from fcl_sim.diagnostics.source import Source, Span
from fcl_sim.diagnostics.spelling import nearest

__all__ = ["Diagnostic", "InputFault", "Place", "Severity", "Source", "Span", "nearest"]
