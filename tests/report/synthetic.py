"""Outcomes that were never simulated: small, quick, with every kind of thing a report must show."""

import hashlib
from dataclasses import replace
from pathlib import Path

import numpy as np

from fcl_sim.block import Block, loads
from fcl_sim.diagnostics import Source, Span
from fcl_sim.formula.text import plain
from fcl_sim.judge.temporal.formula import bind, read
from fcl_sim.judge.verdict import Band, Requirement, Status, Verdict, worst
from fcl_sim.loop.diagram import Diagram, FuzzyNode, Integration, PlantNode, Timing, Wire
from fcl_sim.loop.trace import Fault, FuzzyRecord, Trace
from fcl_sim.plant.catalog import PlantModel
from fcl_sim.plant.declaration import Input, Output, Parameter, Plant, State
from fcl_sim.plant.functions import DEFAULTS, PlantFunctions, as_entry
from fcl_sim.scenario.model import PlantSetup, Scenario, Setup, SourceFile
from fcl_sim.testbench import BASE, Outcome, Run
from fcl_sim.toml import Entry

EVIL = "#panic(1) $x$ <script>alert(1)</script> µ 😀 \\ [*_`@ &amp; 漢字"
"""What a name may hold that markup, mathematics or HTML would take for their own."""

LONG = "a_very_long_name_that_goes_on.and_on_without_any_blank/until_it_is_longer_than_any_column_is_wide"

CRANE = """(* figure C.16, rule 2 corrected *)
FUNCTION_BLOCK crane
VAR_INPUT distance: REAL; angle: REAL; END_VAR
VAR_OUTPUT power: REAL; END_VAR
FUZZIFY distance
    TERM too_far := (-5, 1) (0, 0);
    TERM zero := (-5, 0) (0, 1) (5, 0);
    TERM close := (0, 0) (5, 1) (10, 0);
    TERM medium := (5, 0) (10, 1) (22, 0);
    TERM far := (10, 0) (22, 1);
END_FUZZIFY
FUZZIFY angle
    TERM neg_big := (-50, 1) (-5, 0);
    TERM neg_small := (-50, 0) (-5, 1) (0, 0);
    TERM zero := (-5, 0) (0, 1) (5, 0);
    TERM pos_small := (0, 0) (5, 1) (50, 0);
    TERM pos_big := (5, 0) (50, 1);
END_FUZZIFY
DEFUZZIFY power
    TERM neg_high := -27;
    TERM neg_medium := -9;
    TERM zero := 0;
    TERM pos_medium := 9;
    TERM pos_high := 27;
    METHOD: CoGS;
    DEFAULT := 0;
END_DEFUZZIFY
RULEBLOCK No1
    AND: MIN;
    ACCU: MAX;
    RULE 1: IF distance IS far AND angle IS zero THEN power IS pos_medium;
    RULE 2: IF distance IS far AND angle IS neg_small THEN power IS pos_high;
    RULE 3: IF distance IS far AND angle IS neg_big THEN power IS pos_medium;
    RULE 4: IF distance IS medium AND angle IS neg_small THEN power IS neg_medium;
    RULE 5: IF distance IS close AND angle IS pos_small THEN power IS pos_medium;
    RULE 6: IF distance IS zero AND angle IS zero THEN power IS zero;
END_RULEBLOCK
END_FUNCTION_BLOCK
"""

ONE_INPUT = """FUNCTION_BLOCK valve
VAR_INPUT level: REAL; END_VAR
VAR_OUTPUT opening: REAL; END_VAR
FUZZIFY level
    TERM low := (0, 1) (2, 0);
    TERM high := (5, 0) (10, 1);
END_FUZZIFY
DEFUZZIFY opening
    TERM shut := 0;
    TERM open := 100;
    METHOD: CoGS;
    DEFAULT := NC;
END_DEFUZZIFY
RULEBLOCK rules
    AND: MIN;
    ACCU: MAX;
    RULE 1: IF level IS low THEN opening IS shut;
    RULE 2: IF level IS high THEN opening IS open;
END_RULEBLOCK
END_FUNCTION_BLOCK
"""

THREE_INPUTS = """FUNCTION_BLOCK mixer
VAR_INPUT a: REAL; b: REAL; c: REAL; END_VAR
VAR_OUTPUT u: REAL; v: REAL; END_VAR
FUZZIFY a TERM lo := (0, 1) (1, 0); TERM hi := (0, 0) (1, 1); END_FUZZIFY
FUZZIFY b TERM lo := (0, 1) (1, 0); TERM hi := (0, 0) (1, 1); END_FUZZIFY
FUZZIFY c TERM lo := (0, 1) (1, 0); TERM hi := (0, 0) (1, 1); END_FUZZIFY
DEFUZZIFY u TERM small := 0; TERM large := 1; METHOD: CoGS; DEFAULT := 0; END_DEFUZZIFY
DEFUZZIFY v TERM small := 0; TERM large := 1; METHOD: CoGS; DEFAULT := 0; END_DEFUZZIFY
RULEBLOCK rules
    AND: MIN;
    ACCU: MAX;
    RULE 1: IF a IS lo AND b IS lo AND c IS lo THEN u IS small, v IS large;
    RULE 2: IF a IS hi OR b IS hi OR c IS hi THEN u IS large, v IS small;
END_RULEBLOCK
END_FUNCTION_BLOCK
"""

SCAN = 500_000_000
DURATION = 60 * 10**9


def crane() -> Block:
    return loads(CRANE, "crane.fcl")


def trace(kind: str = "settles", *, names: tuple[str, ...] = ()) -> Trace:
    """Return a run of the crane that `settles`, `swings` for ever, or ends early with a `fault`."""
    ticks = np.arange(0, DURATION + SCAN, SCAN, dtype=np.int64)
    time = ticks / 1e9
    if kind == "swings":
        distance, angle = 25.0 * np.cos(0.5 * time), 12.0 * np.sin(0.8 * time)
    else:
        distance, angle = 25.0 * np.exp(-time / 6.0), 4.0 * np.exp(-time / 9.0) * np.sin(time)
    power = np.clip(2.0 * distance, -27.0, 27.0)
    names = names or ("crane.distance", "crane.sway", "controller.distance", "controller.rules.power")
    columns = dict(zip(names, (distance, angle, distance, power), strict=True))
    units = dict(zip(names, ("m", "deg", "m", "kW"), strict=True))
    record = FuzzyRecord(
        input_names=("distance", "angle"),
        output_names=("power",),
        rule_labels=("1",),
        inputs=np.column_stack([distance, angle]),
        outputs=power[:, None],
        degrees=np.ones((len(time), 1)),
        flags=(time < 20.0)[:, None] | (time > 30.0)[:, None],
    )
    end = len(ticks) // 3 if kind == "fault" else len(ticks)
    fault = Fault(int(ticks[end - 1]), names[0], "the integrator cannot reach its tolerance")
    return Trace(
        ticks=ticks[:end],
        names=names,
        units=units,
        values=np.column_stack(list(columns.values()))[:end],
        fuzzy={
            "controller.rules": replace(
                record, inputs=record.inputs[:end], outputs=record.outputs[:end], flags=record.flags[:end]
            )
        },
        fault=fault if kind == "fault" else None,
    )


def requirement(**given) -> Requirement:
    asked = {
        "id": "CR-1",
        "text": "The container stands within half a metre of the target",
        "metric": "settling_time",
        "signal": "crane.distance",
        "arguments": {"final": 0.0, "band": 0.5},
        "maximum": 35.0,
        "unit": "s",
    }
    return Requirement(**{**asked, **given})


def verdict(measured: Status = Status.PASS, value: float | None = 25.4, **given) -> Verdict:
    asked = requirement(**given)
    missed = measured is Status.FAIL
    flipped = {Status.PASS: Status.FAIL, Status.FAIL: Status.PASS}
    status = flipped.get(measured, measured) if asked.expect_fail else measured
    return Verdict(
        requirement=asked,
        status=status,
        measured=measured,
        value=value,
        definition="time until the signal stays within final ± band; final = 0 m, band = 0.5 m",
        reason="crane.distance does not settle." if missed else "The settling time is 25.4 s.",
        band=Band(signal=asked.signal, low=-0.5, high=0.5, start=35.0, end=60.0),
        violation=(35.0, 60.0) if missed else None,
    )


def of_formula(text: str, measured: Status = Status.PASS, value: float | None = 0.5) -> Verdict:
    """Return a verdict on a formula, violated from 20 s to 25 s where it is missed."""
    formula = bind(read(plain(text)), {"crane.distance": "m", "crane.sway": "deg"})
    asked = requirement(
        id="CR-6", metric="", signal="", arguments={}, maximum=None, unit="deg", formula=formula
    )
    return Verdict(
        requirement=asked,
        status=measured,
        measured=measured,
        value=value,
        definition=str(formula),
        reason="The formula holds." if measured is Status.PASS else "The formula does not hold.",
        violation=(20.0, 25.0) if measured is Status.FAIL else None,
    )


def verdicts(kind: str, *, expect_fail: bool = False) -> tuple[Verdict, ...]:
    if kind == "fault":
        return (verdict(Status.FAULT, None),)
    if kind == "swings":
        return (verdict(Status.FAIL, None, expect_fail=expect_fail),)
    sway = verdict(
        id="CR-2", signal="crane.sway", text="No sway is left", metric="peak", unit="deg", maximum=0.5
    )
    return (verdict(), sway)


UNITS = {"distance": "m", "angle": "deg", "power": "kW"}


def at_rest(t, x, u, p, mode, result):
    """Stand still."""


def plant(folder: Path, block: Block | None = None) -> PlantModel:
    """Return a plant that gives the distance and whatever `block` reads."""
    measured = dict.fromkeys(("distance", *(block.inputs if block else ())))
    declaration = Plant(
        name="crane",
        title="Container crane",
        states=(State("position", "m", -25.0, "trolley"),),
        inputs=(Input("power", "kW", "drive"),),
        outputs=tuple(Output(each, UNITS.get(each, "1"), "measured") for each in measured),
        parameters=(Parameter("load_mass", "t", 20.0, "container", "[A]"),),
    )
    path, parts = folder / "crane.py", {"dynamics": at_rest, "outputs": at_rest, **DEFAULTS}
    functions = {part: as_entry(part, function, "synthetic") for part, function in parts.items()}
    return PlantModel(
        declaration=declaration,
        path=path,
        digest="ab" * 32,
        functions=PlantFunctions(**functions, path=path),
        samples=False,
    )


def of_all_rules(found: Trace, block: Block) -> Trace:
    """Return a trace in which every rule of a block fires all the time."""
    labels = block.program.rule_labels
    degrees = np.ones((len(found.ticks), len(labels)))
    records = {
        name: replace(record, rule_labels=labels, degrees=degrees) for name, record in found.fuzzy.items()
    }
    return replace(found, fuzzy=records)


def run(folder: Path, variant: str = BASE, kind: str = "settles", **given) -> Run:
    block = given.get("block") or crane()
    node = FuzzyNode(
        name="controller.rules",
        block=block,
        inputs={each: Wire(f"crane.{each}") for each in block.inputs},
        units=UNITS,
    )
    diagram = Diagram(
        plant=PlantNode(
            name="crane",
            model=plant(folder, block),
            parameters={"load_mass": 20.0},
            start={"position": -25.0},
            inputs={"power": Wire(f"controller.rules.{block.outputs[0]}")},
        ),
        nodes=(node,),
        timing=Timing(scan=SCAN, duration=DURATION),
    )
    judged = given.get("verdicts") or verdicts(kind, expect_fail=variant != BASE)
    return Run(
        variant=variant,
        title=given.get("title", ""),
        diagram=diagram,
        trace=of_all_rules(given.get("trace") or trace(kind), node.block),
        verdicts=judged,
        verdict=worst([each.status for each in judged]),
        seconds=0.1,
    )


def _setup(run: Run, file: Path) -> Setup:
    nowhere = Span(Source("transfer.toml", ""), 0, 0)
    return Setup(
        variant=run.variant,
        title=run.title,
        description="",
        timing=run.diagram.timing,
        integration=Integration(),
        plant=PlantSetup(
            model=Entry("crane", nowhere, nowhere),
            name="crane",
            parameters={},
            start={},
            inputs={},
            span=nowhere,
        ),
        controller=None,
        blocks={},
        rule_bases={"controller.rules": file},
        tree=Entry({}, nowhere, nowhere),
    )


def outcome(folder: Path, *runs: Run, **given) -> Outcome:
    """Return an outcome of `runs`, whose files stand in `folder`."""
    files = []
    for role, name, text in (
        ("scenario", "transfer.toml", "title = 'transfer'"),
        ("rule base", "crane.fcl", given.get("fcl", CRANE)),
    ):
        path = folder / name
        path.write_text(text, encoding="utf-8")
        digest = hashlib.sha256(path.read_bytes()).hexdigest()
        files.append(SourceFile(role=role, path=path, source=Source(name, text), digest=digest))
    setups = {each.variant: _setup(each, folder / "crane.fcl") for each in runs}
    scenario = Scenario(
        path=folder / "transfer.toml",
        name=given.get("name", "crane/transfer"),
        title=given.get("title", "Container crane: 25 m transfer"),
        description=given.get("description", "The trolley carries the container.\n\nIt sets it down."),
        bench=folder,
        variants=setups,
        requirements=(),
        files=tuple(files),
        overrides=given.get("overrides", {}),
    )
    variants = {each.variant: each for each in runs}
    return Outcome(
        scenario=scenario, variants=variants, verdict=worst([each.verdict for each in variants.values()])
    )
