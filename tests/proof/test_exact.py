"""An evaluation in fractions is what the literal second opinion says, to the last digit."""

from dataclasses import fields, is_dataclass, replace
from fractions import Fraction
from random import Random

import pytest

from fcl_sim import fcl
from fcl_sim.engine.explain import Origin
from fcl_sim.model import Method
from fcl_sim.proof.exact import exactly
from tests import oracle
from tests.engine.random_bases import random_base
from tests.house.places import ROOT
from tests.proof.bases import ANY, block_of, random_points, random_text

PARTS = 64
"""Numbers are taken to multiples of 1/64, which are the same as decimals and as binary fractions."""


ROOT_ERROR = Fraction(1, 10**30)
"""How far the oracle's own roots may be off."""


def dyadic(noun):
    """Return a model with every float in it rounded to a multiple of 1 / PARTS."""
    if isinstance(noun, float):
        return round(noun * PARTS) / PARTS
    if isinstance(noun, tuple):
        return tuple(map(dyadic, noun))
    if is_dataclass(noun):
        return replace(noun, **{each.name: dyadic(getattr(noun, each.name)) for each in fields(noun)})
    return noun


def agrees(block, point):
    """Assert that both say the same of a point: degrees, outputs, and where these come from."""
    found = exactly(block, point)
    opinion = oracle.evaluate(block, point)
    assert tuple(degree for _, degree in found.rules) == opinion.rules
    assert {(variable, term): degree for variable, term, degree in found.terms} == dict(opinion.terms)
    halved = {each.variable for each in block.defuzzifications if each.method is Method.COA}
    for each in found.outputs:
        assert (each.origin is Origin.RULES) == (
            opinion.active[each.variable]
            or each.variable not in [own.variable for own in block.defuzzifications]
        )
        other = opinion.outputs[each.variable]
        assert (
            abs(each.value - other) < Fraction(1, 10**30) if each.variable in halved else each.value == other
        )


@pytest.mark.parametrize("seed", range(30))
def test_any_rule_base_gives_what_the_oracle_gives(seed):
    norms = seed % 3 == 0
    block = dyadic(random_base(seed, 1 + seed % 9, norms=norms))
    random = Random(seed)  # noqa: S311  nothing secret
    for _ in range(4):
        agrees(block, {each.name: Fraction(random.randint(-6 * 64, 14 * 64), 64) for each in block.inputs})


@pytest.mark.parametrize("seed", range(12))
def test_points_on_breakpoints_give_what_the_oracle_gives(seed):
    block = block_of(random_text(seed, ANY))
    for point in random_points([each.name for each in block.inputs], seed, 40):
        agrees(block, point)


def test_decimals_are_what_was_written():
    (block,) = fcl.read_file(ROOT / "scenarios/cone/schedule.fcl").blocks
    (name,) = (each.name for each in block.inputs)
    found = exactly(block, {name: Fraction(3, 20)})
    assert [each.value for each in found.outputs][1] == Fraction(23, 2)
    assert sum(degree for _, _, degree in found.terms) == 1
