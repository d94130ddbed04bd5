"""The engine against the oracle on one rule base: what differs, and by how much at most."""

from collections.abc import Iterator, Mapping
from fractions import Fraction

import numpy as np

from fcl_sim.engine.assemble import assemble
from fcl_sim.engine.entries import evaluate_one
from fcl_sim.engine.program import Program
from fcl_sim.model import Defuzzification, FunctionBlock, Method
from tests import oracle
from tests.oracle import Opinion
from tests.oracle_areas import Area

LOW = Fraction(1, 10**9)
"""Areas and sums of degrees below this, ties and gaps nearer than this to one: not well posed (issue 4)."""
BOUND = 1e-12
"""Largest error of an output, in parts of its range."""

PREVIOUS = {"y": 7.25, "z": -3.5, "q": 0.625}

Error = tuple[str, float, float]
"""What was compared, the error, and what it may be."""


def infer(
    program: Program, values: Mapping[str, float], previous: Mapping[str, float] | None = None
) -> np.ndarray:
    """Return the instance memory after one evaluation."""
    memory = program.initial.copy()
    for place, name in enumerate(program.input_names):
        memory[place] = values[name]
    for place, name in enumerate(program.output_names, program.outputs_at):
        memory[place] = (previous or {}).get(name, memory[place])
    evaluate_one(program.ints, program.floats, memory)
    return memory


def errors(base: FunctionBlock, values: Mapping[str, float]) -> Iterator[Error]:
    """Yield every comparison of one evaluation with the oracle's opinion."""
    program = assemble(base)
    memory = infer(program, values, PREVIOUS)
    opinion = oracle.evaluate(base, values, PREVIOUS)
    for key, degree in opinion.terms.items():
        ours = Fraction(memory[program.layout.terms[key]])
        yield f"{key[0]} IS {key[1]}", float(abs(ours - degree)), float(2**-50 * degree)
    for label, ours, degree in zip(
        program.rule_labels, memory[program.degrees_at :], opinion.rules, strict=False
    ):
        yield f"rule {label}", float(abs(Fraction(ours) - degree)), 1e-14
    for key, degree in opinion.accumulated.items():
        if key in program.layout.accumulated:
            ours = Fraction(memory[program.layout.accumulated[key]])
            yield f"accumulated {key}", float(abs(ours - degree)), 1e-13
    defined = {each.variable: each for each in base.defuzzifications}
    for place, name in enumerate(program.output_names):
        if name in opinion.outputs and is_well_posed(defined.get(name), opinion, name):
            ours = Fraction(memory[program.outputs_at + place])
            active = memory[program.active_at + place] != 0.0
            yield f"{name} active", float(active != opinion.active[name]), 0.0
            what = f"{name} by {defined[name].method if name in defined else 'degree'}"
            scale, ulp = range_of(opinion, name)
            known = 1e-14 if name not in defined else 0.0  # of a degree, as of the rules' degrees
            yield what, float(abs(ours - opinion.outputs[name])), BOUND * scale + ulp + known


def range_of(opinion: Opinion, name: str) -> tuple[float, float]:
    """Return the width of an output's range, and what its largest number is rounded by."""
    if name in opinion.areas and opinion.active[name]:
        area = opinion.areas[name]
        ends = (area.low, area.high)
    else:
        ends = (*opinion.places.get(name, ()), opinion.outputs[name])
    return float(max(ends) - min(ends)), 2.0**-51 * float(max(map(abs, ends)))


def is_well_posed(output: Defuzzification | None, opinion: Opinion, name: str) -> bool:
    """Return whether an answer is settled by degrees that are known to 16 digits."""
    if output is None:
        return True
    if name in opinion.areas:
        area = opinion.areas[name]
        return area.height == 0 or (area.height >= LOW and not is_near_tie(output.method, area))
    degrees = [degree for (variable, _), degree in opinion.accumulated.items() if variable == name]
    top = max(degrees, default=Fraction(0))
    tied = output.method is not Method.COGS and any(0 < top - degree < LOW * top for degree in degrees)
    return top == 0 or (top >= LOW and not tied)


def is_near_tie(method: Method, area: Area) -> bool:
    """Return whether a maximum is nearly reached elsewhere, or half the area nearly at a gap."""
    if method is Method.COG:
        return False
    if method is not Method.COA:
        return any(0 < area.height - value < LOW * area.height for _, value in area.values)
    before, half = Fraction(0), area.content / 2
    for a, left, b, right in area.pieces:
        if left < LOW * area.height and 0 < abs(before - half) < LOW * half:
            return True
        before += (b - a) * (left + right) / 2
        if right < LOW * area.height and 0 < abs(before - half) < LOW * half:
            return True
    return False
