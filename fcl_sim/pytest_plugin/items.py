"""The nodes below a scenario file: its runs, and what each of them is held against."""

from abc import abstractmethod
from collections.abc import Iterator
from datetime import UTC, datetime
from os import PathLike
from pathlib import Path
from typing import Any

import pytest

from fcl_sim.diagnostics import Diagnostic, InputFault, Place
from fcl_sim.diagnostics.render import render, render_all
from fcl_sim.envelope.plan import POINTS
from fcl_sim.judge.envelope import EnvelopeVerdict
from fcl_sim.judge.verdict import Status, Verdict
from fcl_sim.report import baselines, junit
from fcl_sim.report.findings import of_baseline, of_envelope, of_verdict
from fcl_sim.scenario.asked_runs import asked_of
from fcl_sim.scenario.document import shown
from fcl_sim.scenario.model import RequirementText, Scenario
from fcl_sim.scenario.reader import read
from fcl_sim.testbench import Outcome, Run, lost_runs, run_scenario, update_baseline

PACKAGE = Path(__file__).parents[1]


class Missed(Exception):
    """What keeps an item from passing: told without a traceback of ours, from its place in the scenario."""

    def __init__(self, finding: Diagnostic, *remarks: str) -> None:
        self.finding = finding
        super().__init__("\n".join([render(finding), *(f"  {each}" for each in remarks)]))


class ScenarioFile(pytest.File):
    """A scenario; it is simulated, with all its variants, when the first of its items is set up."""

    scenario: Scenario
    outcome: Outcome | None = None

    def collect(self) -> Iterator["RunNode | LostRunItem"]:
        """Yield the runs, the base run first, and the baselines of those that are no more."""
        try:
            self.scenario = read(_as_called(self.path))
        except InputFault as fault:
            raise self.CollectError(render_all(fault.diagnostics)) from None
        for variant in self.scenario.variants:
            yield RunNode.from_parent(self, name=variant)
        for lost in lost_runs(self.scenario):
            yield LostRunItem.from_parent(self, name=Path(lost.places[0].name).name, lost=lost)

    def setup(self) -> None:
        """Simulate and judge; what is wrong with its files is an error of every item."""
        self.outcome, faults = _simulated(self.scenario)
        if faults:
            pytest.fail(render_all(faults), pytrace=False)

    def teardown(self) -> None:
        """Forget the traces."""
        self.outcome = None


class RunNode(pytest.Collector):
    """A variant of a scenario."""

    @property
    def file(self) -> ScenarioFile:
        """The scenario."""
        assert isinstance(self.parent, ScenarioFile)  # noqa: S101  it made this node
        return self.parent

    def collect(self) -> Iterator["RunItem"]:
        """Yield an item for each requirement, and one for the baseline."""
        scenario = self.file.scenario
        for text in asked_of(scenario.requirements, self.name):
            yield RequirementItem.from_parent(self, name=text.id, text=text)
        if scenario.variants[self.name].vary:
            for text in asked_of(scenario.requirements, self.name, POINTS):
                yield EnvelopeItem.from_parent(self, name=junit.over_envelope(text.id), text=text)
        yield BaselineItem.from_parent(self, name=junit.OF_BASELINE)


class ScenarioItem(pytest.Item):
    """Something that a scenario is held against; its own exception is told from its place in there."""

    line = 0
    """Where it stands in the scenario, from 0."""

    def repr_failure(self, excinfo: pytest.ExceptionInfo[BaseException], style: Any = None) -> Any:
        """Return what is told of a failure, placed where the requirement stands."""
        if not isinstance(excinfo.value, Missed):
            return super().repr_failure(excinfo, style)
        told = super().repr_failure(excinfo, "value")
        place = getattr(told, "reprcrash", None)
        if place is not None:
            place.path, place.lineno = str(self.path), self.line + 1
            place.message = excinfo.value.finding.message
        return told


class LostRunItem(ScenarioItem):
    """A baseline of a run that the scenario no longer has: it fails."""

    def __init__(self, *, lost: Diagnostic, **given: Any) -> None:
        super().__init__(**given)
        self.lost = lost
        assert isinstance(self.parent, ScenarioFile)  # noqa: S101  it made this item
        self.scenario = self.parent.scenario
        self.add_marker(pytest.mark.fcl_sim(scenario=self.scenario.name, baseline=True))

    def reportinfo(self) -> tuple[PathLike[str], int, str]:
        """Return the scenario, and its heading."""
        return self.path, self.line, f"{self.scenario.name} {self.name}"

    def runtest(self) -> None:
        """Fail: what becomes of the run is not seen any more."""
        raise Missed(self.lost)


class RunItem(ScenarioItem):
    """Something that a run is held against."""

    def __init__(self, **given: Any) -> None:
        super().__init__(**given)
        self.add_marker(
            pytest.mark.fcl_sim(scenario=self.scenario.name, variant=self.node.name, **self.marked())
        )

    @property
    def node(self) -> RunNode:
        """The run's node."""
        assert isinstance(self.parent, RunNode)  # noqa: S101  it made this item
        return self.parent

    @property
    def scenario(self) -> Scenario:
        """The scenario."""
        return self.node.file.scenario

    @property
    def run(self) -> Run:
        """What came of the run."""
        outcome = self.node.file.outcome
        assert outcome is not None  # noqa: S101  the file was set up
        return outcome.variants[self.node.name]

    @abstractmethod
    def marked(self) -> dict[str, Any]:
        """Return what tells it from the others in `-m`."""

    def reportinfo(self) -> tuple[PathLike[str], int, str]:
        """Return its place in the scenario, and its heading."""
        return self.path, self.line, f"{self.scenario.name} {self.node.name} {self.name}"


class RequirementItem(RunItem):
    """A requirement on a run."""

    def __init__(self, *, text: RequirementText, **given: Any) -> None:
        self.requirement, self.line = text.id, text.span.line - 1
        super().__init__(**given)

    def marked(self) -> dict[str, Any]:
        """Return its id."""
        return {"requirement": self.requirement}

    def runtest(self) -> None:
        """Fail where the verdict is not PASS."""
        verdict = next(each for each in self.run.verdicts if each.requirement.id == self.requirement)
        self.user_properties += junit.facts(verdict)
        if verdict.status is not Status.PASS:
            raise Missed(of_verdict(verdict, self.node.name, self.scenario), *_remarks(verdict))


class EnvelopeItem(RequirementItem):
    """A requirement over the envelope of a run."""

    def marked(self) -> dict[str, Any]:
        """Return its id, and that it is about the envelope."""
        return {"requirement": self.requirement, "envelope": True}

    def runtest(self) -> None:
        """Fail where the verdict over all points is not PASS."""
        found = self.run.envelope.verdicts if self.run.envelope else ()
        verdict = next(each for each in found if each.requirement.id == self.requirement)
        self.user_properties += junit.facts(verdict)
        if verdict.status is not Status.PASS:
            raise Missed(of_envelope(verdict, self.node.name, self.scenario), *_remarks(verdict))


class BaselineItem(RunItem):
    """A run beside what it came to when it was last accepted."""

    def marked(self) -> dict[str, Any]:
        """Return that it is about the baseline."""
        return {"baseline": True}

    def runtest(self) -> None:
        """Fail where the run leaves its baseline or has none, and where it is accepted only now."""
        compared, outcome = self.run.compared, self.node.file.outcome
        if compared is None or outcome is None:
            return
        self.user_properties += junit.baseline_facts(compared)
        if compared.status is Status.PASS:
            return
        finding = of_baseline(self.run, self.scenario)
        reason = self.config.getoption("--update-baseline")
        remark = "or: pytest --update-baseline REASON"
        if reason is not None:
            remark = (
                f"written: {shown(self._accept(outcome, reason.strip()))}; the next run is held against it"
            )
        raise Missed(finding, *baselines.lines(self.run), remark)

    def _accept(self, outcome: Outcome, reason: str) -> Path:
        """Write the baseline; return its file."""
        today = datetime.now(UTC).date().isoformat()
        try:
            if self.path.is_relative_to(PACKAGE):
                hint = "copy it: fcl-sim new DIR"
                raise InputFault.at_file(
                    "RUN102", str(self.path), "the shipped bench is never written to", hint
                )
            return update_baseline(outcome, self.node.name, reason=reason, date=today).path
        except InputFault as fault:
            raise Missed(fault.diagnostics[0]) from None
        except OSError as error:
            place = Place(file=str(error.filename or self.path))
            message = f"the baseline cannot be written: {error.strerror or error}"
            raise Missed(Diagnostic(code="RUN101", message=message, places=(place,))) from None


def _simulated(scenario: Scenario) -> tuple[Outcome | None, tuple[Diagnostic, ...]]:
    """Return what came of a scenario, or what is wrong with its files."""
    try:
        return run_scenario(scenario), ()
    except InputFault as fault:
        return None, fault.diagnostics


def _remarks(verdict: Verdict | EnvelopeVerdict) -> Iterator[str]:
    """Yield what a reader of a failure asks next: what is required in words, and how it is measured."""
    yield f"required: {' '.join(verdict.requirement.text.split())}"
    yield f"measured: {' '.join(verdict.definition.split())}"


def _as_called(path: Path) -> Path:
    """Return a file as messages name it: relative to the current folder where it lies below."""
    here = Path.cwd()
    return path.relative_to(here) if path.is_relative_to(here) else path
