"""`python -m tests.proof.mutants [NAME...]`: what sees the mutants of the shipped complete rule bases.

A mutant whose law is another, by samples, is either no sound rule base any more, which `check` finds, or
a sound one of another law, which no look at one text can tell. `diff` is to find every one, with a place
at which it differs. Prints for each rule base how many are seen, by which finding, and what is wrong.
"""

import sys
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from fcl_sim import fcl
from fcl_sim.block import Block
from fcl_sim.engine.assemble import assemble
from fcl_sim.model import FunctionBlock
from fcl_sim.proof.apart import apart
from fcl_sim.proof.prove import prove
from fcl_sim.proof.universe import Universe, declared
from fcl_sim.verify.mutants import Mutant, mutants
from fcl_sim.verify.places import all_places
from tests.house.places import ROOT

COMPLETE = (
    "bath/valve_or",
    "cone/schedule",
    "crane/crane_completed",
    "crane/crane_precise",
    "exchanger/bilinear",
    "exchanger/precontrol",
    "pi/draft8",
    "pi/linear4",
    "pi/linear4_min",
    "pi/linear9",
    "pi/linear9_max",
    "pi/positional8",
    "vessel/figure7",
)


SAMPLES = 5000
SAME = 1e-9
"""The part of an output's largest value up to which two count as the same."""


@dataclass(frozen=True, slots=True)
class Seen:
    """What sees a mutant: the `codes` that a proof tells more than of the original, and `diff`.

    `sampled` is by how much samples differ, `shown` what is so at the place that `diff` names.
    """

    mutant: Mutant
    codes: tuple[str, ...]
    sampled: float
    shown: float


def seen(block: FunctionBlock, chosen: slice = slice(None)) -> Iterator[Seen]:
    """Yield what sees each mutant of a rule base."""
    universe = Universe(stretches=declared(block))
    before = {each.diagnostic.message for each in prove(block)}
    original = Block(block, assemble(block))
    points = samples(original)
    for mutant in list(mutants(block))[chosen]:
        own = Block(mutant.function_block, assemble(mutant.function_block))
        told = [each.diagnostic for each in prove(mutant.function_block)]
        codes = tuple(each.code for each in told if each.message not in before)
        places = [
            each.largest.at for each in apart(original, own, universe, 0.0, coarse=True) if each.largest
        ]
        shown = max((most_apart(original, own, each) for each in places), default=0.0)
        yield Seen(mutant, codes, most_apart(original, own, points), shown)


def samples(block: Block) -> dict[str, np.ndarray]:
    """Return points all over the breakpoints of the inputs, and a little beyond."""
    random = np.random.default_rng(1)
    found = {}
    for each in block.function_block.fuzzifications:
        ends = all_places(each.terms)
        room = 0.1 * (ends[-1] - ends[0])
        found[each.variable] = random.uniform(ends[0] - room, ends[-1] + room, SAMPLES)
    return {each: found.get(each, random.uniform(0.0, 1.0, SAMPLES)) for each in block.inputs}


def most_apart(one: Block, other: Block, points) -> float:
    """Return by how much two blocks differ most at points, as part of what the first gives there."""
    ours, theirs = one.evaluate(points), other.evaluate(points)
    found = 0.0
    for name, values in ours.items():
        difference = np.nan_to_num(np.abs(theirs[name] - values), nan=np.inf).max()
        found = max(found, float(difference / (np.abs(values).max() or 1.0)))
    return found if found > SAME else 0.0


def report(name: str, found: Sequence[Seen]) -> Iterator[str]:
    """Yield the lines on the mutants of a rule base."""
    other = [each for each in found if each.sampled or each.shown]
    told = [each for each in other if each.codes]
    yield (
        f"{name}: {len(found)} mutants, {len(other)} of another law; of these check sees {len(told)}, "
        f"diff {sum(bool(each.shown) for each in other)}"
    )
    for kind in dict.fromkeys(each.mutant.kind for each in found):
        own = [each for each in other if each.mutant.kind is kind]
        seeing = Counter(code for each in own for code in sorted(set(each.codes)))
        codes = ", ".join(f"{code} {count}" for code, count in sorted(seeing.items()))
        yield f"    {kind}: {sum(bool(each.codes) for each in own)} of {len(own)}  {codes}"
    for each in found:
        if each.sampled and not each.shown:
            yield f"    diff does not see {each.mutant}"
        if each.codes and each not in other:
            yield f"    told with the same law: {each.mutant} {' '.join(each.codes)}"


def main(names: Sequence[str]) -> None:
    for name in names or COMPLETE:
        (block,) = fcl.read_file(ROOT / "scenarios" / f"{name}.fcl").blocks
        print("\n".join(report(name, list(seen(block)))), flush=True)  # noqa: T201  it is a program


if __name__ == "__main__":
    main(sys.argv[1:])
