"""Outcomes as JUnit XML: a suite for each run, a case for each requirement.

What is not green fails, for a build server takes what is skipped for green;
FAULT, and what could not be run at all, is an error.
"""

from collections.abc import Iterable, Iterator, Sequence
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from fcl_sim.diagnostics import Diagnostic, Place
from fcl_sim.diagnostics.render import render
from fcl_sim.judge.baseline import Comparison
from fcl_sim.judge.envelope import EnvelopeVerdict
from fcl_sim.judge.verdict import Requirement, Status, Verdict
from fcl_sim.report.baselines import lines as lines_of
from fcl_sim.report.findings import name_of, nothing_asked, of_baseline, of_envelope, of_verdict
from fcl_sim.report.summary import EXPECTED_MISS, expected_miss
from fcl_sim.report.words import one_line, plain
from fcl_sim.scenario.model import Scenario
from fcl_sim.testbench import Outcome, Run

TOOL = "fcl-sim"
OF_RUN, OF_BASELINE = "requirements", "baseline"
"""The case of a run of which nothing is required, and that of a run beside its baseline."""
OF_INPUT = "input"
"""The suite of what could not be run."""

COUNTS = {"failures": "failure", "errors": "error"}


def text(outcomes: Sequence[Outcome], faults: Iterable[Diagnostic] = ()) -> str:
    """Return the document; `faults` are what kept further scenarios from being run."""
    root = Element("testsuites", name=TOOL)
    for outcome in outcomes:
        for run in outcome.variants.values():
            root.append(_of_run(outcome.scenario, run))
    listed = [each for each in faults if each.is_error]
    if listed:
        root.append(_of_faults(listed))
    _count(root)
    indent(root)
    return f'<?xml version="1.0" encoding="utf-8"?>\n{tostring(root, encoding="unicode")}\n'


def facts(verdict: Verdict | EnvelopeVerdict) -> Iterator[tuple[str, str]]:
    """Yield what there is to know of a verdict besides its words: name and value, as a property has them.

    Over an envelope the value is that at the worst point, or the mean.
    """
    asked = verdict.requirement
    yield "requirement", one_line(asked.text)
    yield "verdict", str(verdict.status)
    yield "definition", one_line(verdict.definition)
    for name in ("metric", "signal", "unit"):
        if getattr(asked, name):
            yield name, one_line(getattr(asked, name))
    for name, number in (("value", verdict.value), ("min", asked.minimum), ("max", asked.maximum)):
        if number is not None:
            yield name, repr(float(number))
    if isinstance(verdict, EnvelopeVerdict):
        yield "points", str(verdict.points)
        yield "passed", str(verdict.passed)
        yield "needed", str(verdict.needed)
    elif verdict.violation is not None:
        yield "violated_from", repr(verdict.violation[0])
        yield "violated_to", repr(verdict.violation[1])
    if asked.expect_fail:
        yield "expect", "fail"


def over_envelope(name: str) -> str:
    """Return what the case of a requirement over an envelope is called."""
    return f"{name}[envelope]"


def baseline_facts(compared: Comparison) -> Iterator[tuple[str, str]]:
    """Yield what there is to know of a run beside its baseline, as properties."""
    yield "verdict", str(compared.status)
    if compared.baseline:
        yield "date", compared.baseline.date
        yield "reason", one_line(compared.baseline.reason)


def _of_run(scenario: Scenario, run: Run) -> Element:
    suite = Element("testsuite", name=plain(f"{scenario.name}.{run.variant}"), time=f"{run.seconds:.3f}")
    _properties(suite, [("scenario", plain(scenario.title)), ("run", plain(run.title))])
    for verdict in run.verdicts:
        case = _case(suite, verdict.requirement.id, scenario, run, verdict.requirement)
        _properties(case, list(facts(verdict)))
        if verdict.status is not Status.PASS:
            _fails(case, of_verdict(verdict, run.variant, scenario), str(verdict.status))
        elif expected_miss(verdict):
            _misses(case, verdict)
    for over in run.envelope.verdicts if run.envelope else ():
        case = _case(suite, over_envelope(over.requirement.id), scenario, run, over.requirement)
        _properties(case, list(facts(over)))
        if over.status is not Status.PASS:
            _fails(case, of_envelope(over, run.variant, scenario), str(over.status))
        elif expected_miss(over):
            _misses(case, over)
    if not run.verdicts and run.compared is None and run.envelope is None:
        case = _case(suite, OF_RUN, scenario, run)
        _fails(case, nothing_asked(scenario, run.variant), str(Status.UNTESTED))
    if run.compared:
        case = _case(suite, OF_BASELINE, scenario, run)
        _properties(case, list(baseline_facts(run.compared)))
        if run.compared.status is not Status.PASS:
            _fails(case, of_baseline(run, scenario), str(run.compared.status), lines=list(lines_of(run)))
    return suite


def _of_faults(faults: Sequence[Diagnostic]) -> Element:
    suite = Element("testsuite", name=OF_INPUT)
    for each in faults:
        place = each.places[0] if each.places else Place()
        file = plain(place.name)
        case = SubElement(suite, "testcase", classname=file or TOOL, name=one_line(each.message))
        _place(case, place)
        _fails(case, each, each.code, "error")
    return suite


def _case(
    suite: Element, name: str, scenario: Scenario, run: Run, requirement: Requirement | None = None
) -> Element:
    classname = plain(f"{scenario.name}.{run.variant}")
    case = SubElement(suite, "testcase", classname=classname, name=one_line(name))
    span = requirement.span if requirement else None
    _place(case, Place(span=span) if span else Place(file=name_of(scenario)))
    return case


def _place(case: Element, place: Place) -> None:
    if place.name:
        case.set("file", plain(place.name))
    if place.span is not None:
        case.set("line", str(place.span.line))


def _properties(owner: Element, pairs: Sequence[tuple[str, str]]) -> None:
    table = SubElement(owner, "properties")
    for name, value in pairs:
        SubElement(table, "property", name=name, value=value)


def _fails(
    case: Element, finding: Diagnostic, kind: str, tag: str = "", *, lines: Sequence[str] = ()
) -> None:
    tag = tag or ("error" if kind == Status.FAULT else "failure")
    told = "\n".join([render(finding), *(f"  {each}" for each in lines)])
    SubElement(case, tag, type=kind, message=one_line(finding.message)).text = plain(told)


def _misses(case: Element, verdict: Verdict | EnvelopeVerdict) -> None:
    """Say of a case that passes that it does so as an expected miss."""
    SubElement(case, "system-out").text = plain(f"{EXPECTED_MISS}: {verdict.reason}")


def _count(root: Element) -> None:
    """Write the number of cases, failures and errors of each suite and of all."""
    for suite in (root, *root):
        cases = list(suite.iter("testcase"))
        suite.set("tests", str(len(cases)))
        for name, tag in COUNTS.items():
            suite.set(name, str(sum(each.find(tag) is not None for each in cases)))
        suite.set("skipped", "0")
    root.set("time", f"{sum(float(suite.get('time', 0.0)) for suite in root):.3f}")
