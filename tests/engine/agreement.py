"""The engine against the oracle on one rule base: what differs, and by how much at most."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from fcl_sim.engine.assemble import assemble
from fcl_sim.engine.entries import evaluate_once
from fcl_sim.engine.narrow import narrowed
from fcl_sim.engine.precision import LREAL, REAL, Precision
from fcl_sim.engine.program import Program
from fcl_sim.model import AndOperator, Defuzzification, FunctionBlock, Method
from tests import oracle
from tests.oracle import Opinion
from tests.oracle_areas import Area

LOW = Fraction(1, 10**9)
"""Areas and sums of degrees below this are not well posed."""


@dataclass(frozen=True)
class Bounds:
    """What errors may be in one arithmetic.

    `output` is in parts of the range, besides `ulp` in parts of its largest
    number; `term` in parts of the degree. Ties and gaps nearer than `near` to
    one are not well posed.
    """

    output: float
    ulp: float
    term: float
    rule: float
    accumulated: float
    near: Fraction


BOUNDS = {
    LREAL: Bounds(1e-12, 2.0**-51, 2.0**-50, 1e-14, 1e-13, LOW),
    REAL: Bounds(1e-5, 2.0**-22, 2.0**-21, 1e-6, 1e-6, Fraction(1, 10**4)),
}

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
    evaluate_once(program, memory)
    return memory


def errors(
    base: FunctionBlock, points: Iterable[Mapping[str, float]], precision: Precision = LREAL
) -> Iterator[Error]:
    """Yield every comparison of one evaluation for each point with the oracle's opinion.

    Rule base and inputs are those of the arithmetic: numbers rounded to it.
    """
    base = narrowed(base, precision)
    program = assemble(base, precision)
    for point in points:
        values = {name: float(precision.dtype(value)) for name, value in point.items()}
        yield from errors_at(base, program, values, precision)


def errors_at(
    base: FunctionBlock, program: Program, values: Mapping[str, float], precision: Precision
) -> Iterator[Error]:
    """Yield every comparison of one evaluation; rule base and inputs are rounded to the arithmetic."""
    bounds = BOUNDS[precision]
    memory = infer(program, values, PREVIOUS)
    opinion = oracle.evaluate(base, values, PREVIOUS)
    for key, degree in opinion.terms.items():
        ours = Fraction(float(memory[program.layout.terms[key]]))
        yield f"{key[0]} IS {key[1]}", float(abs(ours - degree)), bounds.term * float(degree)
    for label, ours, degree in zip(
        program.rule_labels, memory[program.degrees_at :], opinion.rules, strict=False
    ):
        yield f"rule {label}", float(abs(Fraction(float(ours)) - degree)), bounds.rule
    for key, degree in opinion.accumulated.items():
        if key in program.layout.accumulated:
            ours = Fraction(float(memory[program.layout.accumulated[key]]))
            bound = bounds.accumulated * max(1.0, float(degree))  # sums without a bound exceed 1
            yield f"accumulated {key}", float(abs(ours - degree)), bound
    defined = {each.variable: each for each in base.defuzzifications}
    for place, name in enumerate(program.output_names):
        if is_remainder(base, opinion, name, memory[program.degrees_at :], bounds.rule):
            continue
        if name in opinion.outputs and is_well_posed(defined.get(name), opinion, name, bounds.near):
            ours = Fraction(float(memory[program.outputs_at + place]))
            active = memory[program.active_at + place] != 0.0
            yield f"{name} active", float(active != opinion.active[name]), 0.0
            what = f"{name} by {defined[name].method if name in defined else 'degree'}"
            scale, largest = range_of(opinion, name)
            known = bounds.rule if name not in defined else 0.0  # of a degree, as of the rules' degrees
            bound = bounds.output * scale + bounds.ulp * largest + known
            yield what, float(abs(ours - opinion.outputs[name])), bound


def range_of(opinion: Opinion, name: str) -> tuple[float, float]:
    """Return the width of an output's range, and the size of its largest number."""
    if name in opinion.areas and opinion.active[name]:
        area = opinion.areas[name]
        ends = (area.low, area.high)
    else:
        ends = (*opinion.places.get(name, ()), opinion.outputs[name])
    return float(max(ends) - min(ends)), float(max(map(abs, ends)))


def is_well_posed(output: Defuzzification | None, opinion: Opinion, name: str, near: Fraction = LOW) -> bool:
    """Return whether an answer is settled by degrees that are known to so many digits."""
    if output is None:
        return True
    if name in opinion.areas:
        area = opinion.areas[name]
        return area.height == 0 or (area.height >= LOW and not is_near_tie(output.method, area, near))
    degrees = [degree for (variable, _), degree in opinion.accumulated.items() if variable == name]
    top = max(degrees, default=Fraction(0))
    tied = output.method is not Method.COGS and any(0 < top - degree < near * top for degree in degrees)
    return top == 0 or (top >= LOW and not tied)


def is_remainder(
    base: FunctionBlock, opinion: Opinion, name: str, ours: Sequence[float], rounding: float
) -> bool:
    """Return whether an output is concluded by nothing but a bounded difference that just misses to be more.

    What rounding makes of 0 = max(0, a + b - 1) is as large as the rounding of a
    and b; whether a rule is active hangs on it. That a degree is 0 by structure,
    of a term or by any other operator, stays to be met to the last bit.
    """
    rules = [(block, rule) for block in base.rule_blocks for rule in block.rules]
    concluding = [
        (block, opinion.rules[place], float(ours[place]))
        for place, (block, rule) in enumerate(rules)
        if any(each.variable == name for each in rule.conclusions)
    ]
    fired = [(block, exact, mine) for block, exact, mine in concluding if exact > 0 or mine > 0]
    return bool(fired) and all(
        exact == 0 and mine <= rounding and block.and_operator is AndOperator.BDIF
        for block, exact, mine in fired
    )


def is_near_tie(method: Method, area: Area, near: Fraction = LOW) -> bool:
    """Return whether a maximum is nearly reached elsewhere, or half the area nearly at a gap."""
    if method is Method.COG:
        return False
    if method is not Method.COA:
        return any(0 < area.height - value < near * area.height for _, value in area.values)
    before, half = Fraction(0), area.content / 2
    for a, left, b, right in area.pieces:
        if left < near * area.height and 0 < abs(before - half) < near * half:
            return True
        before += (b - a) * (left + right) / 2
        if right < near * area.height and 0 < abs(before - half) < near * half:
            return True
    return False
