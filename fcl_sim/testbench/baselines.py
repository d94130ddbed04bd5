"""Accept what a run came to: its new baseline; find those of runs that are no more."""

from fcl_sim.diagnostics import Diagnostic, InputFault, Place
from fcl_sim.scenario import baseline_file
from fcl_sim.scenario.document import shown
from fcl_sim.scenario.model import Scenario
from fcl_sim.scenario.references import reference_signals
from fcl_sim.testbench.outcome import Outcome, Run, Update
from fcl_sim.verify.record import Acceptance, record, unfit


def update_baseline(outcome: Outcome, variant: str, *, reason: str, date: str) -> Update:
    """Write what `new_baseline` returns."""
    made = new_baseline(outcome, variant, reason=reason, date=date)
    baseline_file.write(made.after, made.path)
    return made


def new_baseline(outcome: Outcome, variant: str, *, reason: str, date: str) -> Update:
    """Return the baseline of a run as it came out beside the former one; nothing is written.

    `date` is the day, as 2026-01-31. Tolerances of the former baseline are
    kept. InputFault where the scenario was run with overrides, where the run
    ended in a fault, or where a signal that is kept is not finite.
    """
    scenario, run = outcome.scenario, outcome.variants[variant]
    _acceptable(scenario, run)
    path = baseline_file.path_of(scenario.path, variant)
    before = baseline_file.read(scenario.path, variant)
    after = record(
        Acceptance(scenario=scenario.name, variant=variant, date=date, reason=reason),
        run.diagram,
        run.trace,
        run.verdicts,
        signals=reference_signals(scenario, variant, run.trace.units),
        former=before,
    )
    return Update(path=path, before=before, after=after)


def lost_runs(scenario: Scenario) -> tuple[Diagnostic, ...]:
    """Return a finding for each baseline of a run that a scenario no longer has, at the baseline's file.

    There is none where overrides are laid over the scenario: they are other runs.
    """
    if scenario.overrides:
        return ()
    message = f"this is the baseline of a run that {scenario.name} no longer has"
    hint = "delete the file if that is meant, else bring the run back"
    return tuple(
        Diagnostic(code="JDG408", message=message, places=(Place(file=shown(file)),), hint=hint)
        for file in baseline_file.of_no_run(scenario.path, scenario.variants)
    )


def _acceptable(scenario: Scenario, run: Run) -> None:
    """Raise InputFault where a run is nothing to hold others against."""
    file, name = str(scenario.path), f"the run `{run.variant}`"
    told = unfit(run.trace, reference_signals(scenario, run.variant, run.trace.units) or run.trace.names)
    if scenario.overrides:
        hint = "write what differs as a variant, which has a baseline of its own"
        raise InputFault.at_file("RUN108", file, f"{name} has overrides, and a baseline is of none", hint)
    if told:
        raise InputFault.at_file("RUN108", file, f"{name}: {told}", "mend the run before it is accepted")
