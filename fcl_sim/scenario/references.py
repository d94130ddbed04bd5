"""[baseline] → which signals the baseline of a run keeps."""

from collections.abc import Mapping

from fcl_sim.diagnostics import InputFault, nearest
from fcl_sim.diagnostics.spelling import listed
from fcl_sim.scenario.model import Scenario
from fcl_sim.toml.tree import finding


def reference_signals(scenario: Scenario, variant: str, units: Mapping[str, str]) -> tuple[str, ...] | None:
    """Return the signals that a variant's baseline is told to keep; None where it is told nothing.

    `units` has the unit of every signal of the run. InputFault where a signal
    does not exist.
    """
    asked = scenario.variants[variant].references
    if asked is None:
        return None
    faults = []
    for entry in asked:
        if entry.value not in units:
            near = nearest(str(entry.value), units)
            hint = f"did you mean `{near}`?" if near else f"there are {listed(sorted(units))}"
            faults.append(finding("SCN410", f"there is no signal called `{entry.value}`", entry, hint))
    if faults:
        raise InputFault(faults)
    return tuple(str(entry.value) for entry in asked)
