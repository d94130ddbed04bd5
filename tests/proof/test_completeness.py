"""What is proved of an output is what an evaluation shows, everywhere; and z3 comes to the same."""

from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
import z3

from fcl_sim.block import loads
from fcl_sim.model import And, Degree, Is, Not, Or
from fcl_sim.proof.axes import base_of
from fcl_sim.proof.completeness import Certainty, completeness
from fcl_sim.proof.exact import exactly
from fcl_sim.proof.space import axes_of
from fcl_sim.proof.universe import universe_of
from tests.house.places import ROOT
from tests.proof.bases import ANY, HIGH, LOW, block_of, inside, random_points, random_text

AREAS = """
FUNCTION_BLOCK areas
VAR_INPUT x: REAL; END_VAR
VAR_OUTPUT y: REAL; END_VAR
FUZZIFY x TERM low := (0, 1) (1, 0); TERM high := (0, 0) (1, 1); END_FUZZIFY
DEFUZZIFY y
    TERM small := (0, 0) (20, 1) (40, 0);
    TERM large := {shape};
    METHOD: CoG; DEFAULT := 7; RANGE := (0 .. 100);
END_DEFUZZIFY
RULEBLOCK No1
    ACCU: MAX;
    RULE 1: IF x IS low THEN y IS small;
    RULE 2: IF x IS high THEN y IS large;
END_RULEBLOCK
END_FUNCTION_BLOCK
"""


def universe(block):
    return universe_of(block, [f"{each.variable}={LOW}..{HIGH}" for each in block.fuzzifications])


def active(text, points):
    """Return at which points a rule is active for y."""
    columns = {name: np.array([float(each[name]) for each in points]) for name in points[0]}
    return loads(text).evaluation(columns).active["y"]


@pytest.mark.parametrize("seed", range(20))
def test_a_point_is_in_a_gap_exactly_where_no_rule_is_active(seed):
    text = random_text(seed)
    block = block_of(text)
    (proved,) = completeness(block, universe(block))
    assert (proved.certainty, proved.proved) == (Certainty.EXACT, 1)
    boxes = proved.gap.boxes if proved.gap else ()
    assert not (proved.gap and proved.gap.more)
    points = random_points([each.name for each in block.inputs], seed, 1000)
    told = [not any(inside(box, point) for box in boxes) for point in points]
    assert told == active(text, points).tolist()


@pytest.mark.parametrize("seed", range(20))
def test_operators_that_leave_doubt_are_never_wrong(seed):
    text = random_text(seed, ANY)
    block = block_of(text)
    (proved,) = completeness(block, universe(block))
    boxes = proved.gap.boxes if proved.gap else ()
    points = random_points([each.name for each in block.inputs], seed, 1000)
    fires = active(text, points)
    gap = np.array([any(inside(box, point) for box in boxes) for point in points])
    assert not (gap & fires).any()
    if proved.certainty is Certainty.EXACT:
        assert (gap | fires).all()
    elif proved.parts:
        parts = np.array([any(inside(box, point) for box in proved.parts.boxes) for point in points])
        assert proved.parts.more or (gap | fires | parts).all()


@pytest.mark.parametrize("seed", range(15))
def test_bdif_is_told_by_half_spaces(seed):
    text = random_text(seed, ANY)
    block = block_of(text)
    (proved,) = completeness(block, universe(block))
    assert (proved.certainty is Certainty.EXACT) != (proved.parts is not None)
    if proved.parts:
        (output,) = exactly(block, proved.parts.witness).outputs
        assert str(output.origin) == "DEFAULT"
        assert proved.doubt > 0 or all(box.is_thin for box in proved.parts.boxes)


GRID = """
FUNCTION_BLOCK grid
VAR_INPUT a: REAL; b: REAL; END_VAR
VAR_OUTPUT y: REAL; END_VAR
FUZZIFY a TERM low := (0, 1) (10, 0); TERM high := (0, 0) (10, 1); END_FUZZIFY
FUZZIFY b TERM low := (0, 1) (10, 0); TERM high := ({foot}, 0) (10, 1); END_FUZZIFY
DEFUZZIFY y TERM less := -1; TERM more := 1; METHOD: CoGS; DEFAULT := 0; END_DEFUZZIFY
RULEBLOCK r
    AND: BDIF; OR: BSUM; ACCU: MAX;
    RULE 1: IF a IS low AND b IS low THEN y IS less;
    RULE 2: IF a IS high AND b IS high THEN y IS more;
    RULE 3: IF a IS low AND b IS high THEN y IS more;
    RULE 4: IF a IS high AND b IS low THEN y IS more;
END_RULEBLOCK
END_FUNCTION_BLOCK
"""


def test_a_full_grid_under_bdif_has_one_point_without_a_rule():
    block = block_of(GRID.format(foot=0))
    (proved,) = completeness(block, universe_of(block, ["a=0..10", "b=0..10"]))
    assert dict(proved.parts.witness) == {"a": 5, "b": 5}


def test_terms_that_overlap_more_leave_none():
    block = block_of(GRID.format(foot=-1))
    (proved,) = completeness(block, universe_of(block, ["a=0..10", "b=0..10"]))
    assert (proved.gap, proved.parts, proved.certainty) == (None, None, Certainty.EXACT)


@pytest.mark.parametrize("seed", range(20))
def test_a_witness_shows_the_gap(seed):
    text = random_text(seed, ANY)
    block = block_of(text)
    (proved,) = completeness(block, universe(block))
    for gap in filter(None, (proved.gap,)):
        assert not active(text, [gap.witness]).any()
        assert inside(gap.boxes[0], gap.witness)


@pytest.mark.parametrize("seed", range(8))
def test_the_share_is_the_volume_of_the_boxes_together(seed):
    text = random_text(seed)
    block = block_of(text)
    (proved,) = completeness(block, universe(block))
    boxes = proved.gap.boxes if proved.gap else ()
    random = np.random.default_rng(seed)
    names = [each.name for each in block.inputs]
    spread = random.uniform(size=(4000, len(names))) * [1 if each == "d" else HIGH - LOW for each in names]
    points = [dict(zip(names, row.tolist(), strict=True)) for row in spread]
    hit = np.mean([any(inside(box, point) for box in boxes) for point in points])
    share = float(proved.gap.share) if proved.gap else 0.0
    assert abs(hit - share) < 0.04


@pytest.mark.parametrize("seed", range(20))
def test_z3_finds_a_point_without_a_rule_exactly_where_there_is_a_gap(seed):
    block = block_of(random_text(seed))
    (proved,) = completeness(block, universe(block))
    assert (proved.gap is not None) == (gap_by_z3(block) is not None)


BOUNDED = {"AND": ("BDIF",), "OR": ("BSUM",)}


@pytest.mark.parametrize("seed", range(12))
def test_z3_finds_a_point_without_a_rule_under_bdif_exactly_where_there_is_a_gap_or_a_part(seed):
    block = block_of(random_text(seed, BOUNDED))
    (proved,) = completeness(block, universe(block))
    told = proved.gap is not None or proved.parts is not None
    assert told == (gap_by_z3(block, above=is_above_by_degree) is not None)


def is_above_by_degree(condition, terms, names):
    return degree(condition, terms, names) > 0


def degree(condition, terms, names):
    """Return the degree of a condition under BDIF and BSUM."""
    match condition:
        case Is(variable, term):
            return terms[variable, term]
        case Degree(variable):
            return names[variable]
        case Not(argument):
            return 1 - degree(argument, terms, names)
        case And(arguments):
            total = sum(degree(each, terms, names) for each in arguments) - (len(arguments) - 1)
            return z3.If(total > 0, total, 0)
        case Or(arguments):
            total = sum(degree(each, terms, names) for each in arguments)
            return z3.If(total < 1, total, 1)
    raise TypeError(condition)


def gap_by_z3(block, above=None):
    """Return a point at which no rule fires, by z3 over the reals; None where it proves there is none."""
    above = above or is_above
    solver = z3.Solver()
    names = {each.name: z3.Real(each.name) for each in block.inputs}
    for name, value in names.items():
        low, high = (0, 1) if name == "d" else (LOW, HIGH)
        solver.add(value >= low, value <= high)
    terms = {
        (each.variable, term.name): membership(base_of(term), names[each.variable])
        for each in block.fuzzifications
        for term in each.terms
    }
    for rule in block.rule_blocks[0].rules:
        if rule.conclusions[0].weight:
            solver.add(z3.Not(above(rule.condition, terms, names)))
    return solver.model() if solver.check() == z3.sat else None


def is_above(condition, terms, names, *, one=False):
    """Return the formula that a condition's degree is above 0, or with `one` below 1."""
    match condition:
        case Is(variable, term):
            return terms[variable, term] < 1 if one else terms[variable, term] > 0
        case Degree(variable):
            return names[variable] < 1 if one else names[variable] > 0
        case Not(argument):
            return is_above(argument, terms, names, one=not one)
        case And(arguments) | Or(arguments):
            parts = [is_above(each, terms, names, one=one) for each in arguments]
            return z3.And(*parts) if isinstance(condition, And) != one else z3.Or(*parts)
    raise TypeError(condition)


def membership(base, x):
    """Return the degree of base points at `x`: the last point, then segments and points before it."""
    found = number(base[-1][1])
    for (left, low), (right, high) in reversed(list(pairwise(base))):
        if left < right:
            slope = (high - low) / (right - left)
            found = z3.If(x < number(right), number(low) + number(slope) * (x - number(left)), found)
        top = max(degree for place, degree in base if place == right)
        found = z3.If(x == number(right), number(top), found)
    first = max(degree for place, degree in base if place == base[0][0])
    found = z3.If(x == number(base[0][0]), number(first), found)
    return z3.If(x < number(base[0][0]), number(base[0][1]), found)


def number(value):
    return z3.RealVal(str(Fraction(value)))


@pytest.mark.parametrize(
    "shape",
    [
        "(100, 0) (150, 1) (200, 0)",
        "(150, 0) (200, 1)",
        "(50, 0) (50, 1) (50, 0)",
        "COSINE 150 100",
        "(90, 1)",
    ],
)
def test_a_rule_whose_term_has_no_area_within_range_defines_nothing(shape):  # S31
    text = AREAS.format(shape=shape)
    (proved,) = completeness(block_of(text), universe_of(block_of(text)))
    points = [{"x": Fraction(n, 8)} for n in range(-8, 17)]
    told = [not (proved.gap and any(inside(box, each) for box in proved.gap.boxes)) for each in points]
    assert told == active(text, points).tolist()


SHIPPED = sorted((ROOT / "scenarios").rglob("*.fcl"))


@pytest.mark.parametrize("file", SHIPPED, ids=lambda each: each.stem)
def test_a_hundred_thousand_points_contradict_nothing(file):
    text = file.read_text("utf-8")
    block = block_of(text)
    columns = sampled(block, 100_000)
    active = loads(text).evaluation(columns).active
    for proved in completeness(block, universe_of(block)):
        assert not (proved.gap and proved.gap.more)
        gap = np.zeros(100_000, np.bool_)
        for box in proved.gap.boxes if proved.gap else ():
            sides = [within(side, columns[name]) for name, side in box.sides.items()]
            gap |= np.logical_and.reduce(sides)
        fires = active[proved.output]
        assert not (gap & fires).any()
        if proved.certainty is Certainty.EXACT:
            assert (gap | fires).all()


def sampled(block, count):
    """Return points anywhere on and a little beyond the breakpoints, every third number on one of them."""
    random = np.random.default_rng(7)
    axes = {each.variable: each for each in axes_of(block, universe_of(block))}
    columns = {}
    for each in block.inputs:
        cells = axes[each.name].cells if each.name in axes else ()
        knots = np.array([float(cell.low) for cell in cells if cell.is_point] or [0.0, 30.0])
        margin = 0.0 if None in (axes[each.name].literals if each.name in axes else ()) else np.ptp(knots) / 5
        spread = random.uniform(knots.min() - margin, knots.max() + margin, count)
        columns[each.name] = np.where(random.random(count) < 1 / 3, random.choice(knots, count), spread)
    return columns


def within(side, values):
    found = np.ones(values.shape, np.bool_)
    if side.low is not None:
        found &= values >= float(side.low) if side.low_closed else values > float(side.low)
    if side.high is not None:
        found &= values <= float(side.high) if side.high_closed else values < float(side.high)
    return found
