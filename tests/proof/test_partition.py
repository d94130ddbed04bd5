"""Terms that add up to 1 are left in peace; the one base point that keeps them from it is found."""

from random import Random

import pytest

from fcl_sim.diagnostics.page import frame
from fcl_sim.proof.partition import off_one
from fcl_sim.proof.space import axes_of
from fcl_sim.proof.universe import Universe
from tests.proof.bases import block_of


def partition(seed, size):
    """Return the base points of triangles that meet at the same places."""
    random = Random(seed)  # noqa: S311  nothing secret
    peaks = sorted(random.sample(range(0, 100, 4), size))
    lines = []
    for place, peak in enumerate(peaks):
        below = [(peaks[place - 1], 0)] if place else []
        above = [(peaks[place + 1], 0)] if place + 1 < size else []
        lines.append([*below, (peak, 1), *above])
    return lines


def found(lines):
    """Return what is said of an input with these terms."""
    terms = "\n".join(
        f"    TERM t{number} := {' '.join(map(str, line))};" for number, line in enumerate(lines)
    )
    text = frame(complete=True)
    head, _, rest = text.partition("FUZZIFY temp\n")
    more = rest.partition("END_FUZZIFY")[2]
    rules = f"{head}FUZZIFY temp\n{terms}\nEND_FUZZIFY{more}"
    block = block_of(rules.replace("temp IS cold", "temp IS t0").replace("temp IS hot", "temp IS t1"))
    (axis, *_), (own, *_) = axes_of(block, Universe()), block.fuzzifications
    return off_one(axis, own)


@pytest.mark.parametrize("seed", range(6))
def test_a_partition_is_left_in_peace(seed):
    assert found(partition(seed, 3 + seed % 4)) is None


@pytest.mark.parametrize("seed", range(12))
def test_the_base_point_that_was_moved_is_named_with_where_it_was(seed):
    random = Random(seed)  # noqa: S311  nothing secret
    lines = partition(seed, 6)
    number, place = random.randrange(6), random.randrange(2)
    x, degree = lines[number][place]
    lines[number][place] = (x + random.choice((-1, 1)), degree)
    off = found(lines)
    # At an end of the axis the two terms that meet may each be meant.
    assert {off.slip.place, off.slip.better} == {x, lines[number][place][0]}


def test_terms_that_overlap_as_they_like_are_left_in_peace():
    assert found([[(0, 1), (40, 0)], [(20, 0), (50, 1), (90, 0)], [(70, 0), (100, 1)]]) is None


def test_two_terms_alone_say_nothing_of_what_they_should_be():
    assert found([[(0, 1), (60, 0)], [(0, 0), (100, 1)]]) is None
