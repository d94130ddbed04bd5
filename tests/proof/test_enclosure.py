"""Bounds over boxes hold whatever is evaluated within them, and so do those of slopes."""

import numpy as np
import pytest

from fcl_sim.block import loads
from fcl_sim.proof.degrees import Boxes
from fcl_sim.proof.enclosure import Enclosure
from fcl_sim.proof.prove import prove
from tests.house.places import ROOT
from tests.proof.bases import ANY, block_of, random_text

ROUNDING = 1e-9
SHIPPED = [
    "bath/valve_or.fcl",
    "cone/schedule.fcl",
    "crane/crane_completed.fcl",
    "crane/crane_printed.fcl",
    "exchanger/precontrol.fcl",
    "oven/oven_printed.fcl",
    "pi/linear9.fcl",
    "pi/positional8.fcl",
    "vessel/figure7.fcl",
]


def boxes_of(block, random, count):
    """Return boxes of all sizes around where the terms are."""
    lows, widths = [], []
    for each in block.inputs:
        terms = [own.terms for own in block.fuzzifications if own.variable == each.name]
        places = [point.x for own in terms for term in own for point in term.shape.points] or [0.0, 1.0]
        span = max(places) - min(places)
        lows.append(random.uniform(min(places) - 0.1 * span, max(places), count))
        widths.append(span * random.choice([0.0, 1e-3, 0.1, 0.5], count) * random.random(count))
    low = np.array(lows).T
    return Boxes(low, low + np.array(widths).T)


def evaluated(text, block, points):
    columns = {each.name: points[:, place] for place, each in enumerate(block.inputs)}
    return loads(text).evaluate(columns)


AREAS = {"s0": "(-4, 0) (-1, 1) (0, 1) (0, 0.5) (3, 0)", "s1": "(0, 0.25) (2, 1) (5, 0)"}


def with_areas(seed):
    """Return a rule base with areas: CoG or CoA, ACT MIN or PROD, with a RANGE that cuts them off or none."""
    text = random_text(seed, ANY)
    for name, shape in AREAS.items():
        text = text.replace(f"TERM {name} := {name[1]};", f"TERM {name} := {shape};")
    limits = "RANGE := (-3 .. 4);" if seed % 3 else ""
    text = text.replace("METHOD: CoGS;", f"METHOD: {('CoG', 'CoA')[seed % 2]}; {limits}")
    return text.replace("ACCU: MAX;", f"ACCU: MAX; ACT: {('MIN', 'PROD')[seed // 2 % 2]};")


def texts():
    yield from ((f"areas {seed}", with_areas(seed)) for seed in range(4))
    yield from ((f"seed {seed}", random_text(seed, ANY)) for seed in range(12))
    yield from ((name, (ROOT / "scenarios" / name).read_text("utf-8")) for name in SHIPPED)


@pytest.mark.parametrize(("name", "text"), list(texts()), ids=lambda each: each[:20].split("\n")[0])
def test_an_output_stays_within_its_bounds(name, text):
    block = block_of(text)
    random = np.random.default_rng(1)
    boxes = boxes_of(block, random, 300)
    laws = {each.variable: Enclosure(block, each.variable).law(boxes) for each in block.defuzzifications}
    for _ in range(20):
        points = boxes.low + random.random(boxes.low.shape) * (boxes.high - boxes.low)
        for output, values in evaluated(text, block, points).items():
            law = laws[output]
            assert (values >= law.low - ROUNDING).all()
            assert (values <= law.high + ROUNDING).all()


@pytest.mark.parametrize(("name", "text"), list(texts()), ids=lambda each: each[:20].split("\n")[0])
def test_a_difference_along_one_input_stays_within_the_bounds_of_the_slope(name, text):
    block = block_of(text)
    random = np.random.default_rng(2)
    boxes = boxes_of(block, random, 300)
    for output in (each.variable for each in block.defuzzifications):
        law = Enclosure(block, output).law(boxes)
        for place in range(len(block.inputs)):
            start = boxes.low + random.random(boxes.low.shape) * (boxes.high - boxes.low)
            end = start.copy()
            end[:, place] = (
                boxes.low[:, place] + random.random(len(boxes)) * (boxes.high - boxes.low)[:, place]
            )
            step = end[:, place] - start[:, place]
            change = evaluated(text, block, end)[output] - evaluated(text, block, start)[output]
            with np.errstate(invalid="ignore"):
                ends = np.array([law.falls[:, place] * step, law.rises[:, place] * step])
            ends = np.nan_to_num(ends, nan=0.0)
            assert (change >= ends.min(axis=0) - ROUNDING).all()
            assert (change <= ends.max(axis=0) + ROUNDING).all()


def test_bounds_close_in_on_the_law_as_boxes_shrink():
    text = (ROOT / "scenarios/crane/crane_completed.fcl").read_text("utf-8")
    block = block_of(text)
    middle = np.random.default_rng(3).uniform([-5, -50], [22, 50], (200, 2))
    widths = []
    for half in (1.0, 0.1, 0.01):
        law = Enclosure(block, "power").law(Boxes(middle - half, middle + half))
        widths.append(np.mean(law.high - law.low))
    assert widths[1] < 0.3 * widths[0]
    assert widths[2] < 0.3 * widths[1]


@pytest.mark.parametrize("terms", ["TERM a := 1;", "TERM a := (0, 0) (1, 1) (2, 0);"])
def test_an_output_that_no_rule_concludes_on_has_its_default(terms):
    method = "CoG" if "(" in terms else "CoGS"
    text = f"""FUNCTION_BLOCK lone
VAR_INPUT x: REAL; END_VAR
VAR_OUTPUT u: REAL; w: REAL; END_VAR
FUZZIFY x TERM low := (0, 0) (1, 1); END_FUZZIFY
DEFUZZIFY u {terms} METHOD: {method}; DEFAULT := 0; END_DEFUZZIFY
DEFUZZIFY w {terms} METHOD: {method}; DEFAULT := 0.5; END_DEFUZZIFY
RULEBLOCK r AND: MIN; RULE 1: IF x IS low THEN u IS a; END_RULEBLOCK
END_FUNCTION_BLOCK"""
    law = Enclosure(block_of(text), "w").law(Boxes(np.zeros((3, 1)), np.ones((3, 1))))
    assert law.maybe_undefined.all()
    assert (law.low <= 0.5).all()
    assert (law.high >= 0.5).all()
    assert evaluated(text, block_of(text), np.ones((1, 1)))["w"] == [0.5]
    assert prove(block_of(text))  # by other algorithms too, as ACCU is left out


@pytest.mark.parametrize("method", ["CoG", "CoA"])
def test_bounds_of_areas_are_near_what_is_reached(method):
    text = with_areas(1).replace("METHOD: CoA;", f"METHOD: {method};")
    block = block_of(text)
    random = np.random.default_rng(3)
    middle = random.uniform(0, 12, (300, len(block.inputs)))
    law = Enclosure(block, "y").law(Boxes(middle, middle))
    (values,) = evaluated(text, block, middle).values()
    sure = ~law.maybe_undefined
    assert sure.sum() > 50
    assert np.abs(law.high - values)[sure].max() < 0.1
    assert np.abs(law.low - values)[sure].max() < 0.1
