"""Areas under norms of the Open Level: the formulae place by place, and how far a polyline lies from them."""

from dataclasses import replace
from random import Random

import numpy as np

from fcl_sim.engine.assemble import assemble
from fcl_sim.engine.entries import evaluate_once
from fcl_sim.engine.precision import LREAL
from fcl_sim.model import Accumulation, Activation, Degree, Method, RuleBlock, Variable
from tests.engine.bases import block, output, points, rule

LOW, HIGH = 0.0, 10.0
TOLERANCE = 1e-6
NEAR = 1e-9
"""Where a term or the accumulation jumps, places this near to a vertex are not looked at."""

T_NORMS = {
    Activation.MIN: np.minimum,
    Activation.PROD: lambda a, b: a * b,
    Activation.BDIF: lambda a, b: np.maximum(0.0, a + b - 1.0),
    Activation.HPROD: lambda a, b: np.where(a + b > 0.0, a * b / (a + b - a * b), 0.0),
    Activation.EPROD: lambda a, b: a * b / (2.0 - (a + b - a * b)),
    Activation.DPROD: lambda a, b: np.where(np.maximum(a, b) == 1.0, np.minimum(a, b), 0.0),
    Activation.NMIN: lambda a, b: np.where(a + b > 1.0, np.minimum(a, b), 0.0),
}
S_NORMS = {
    Accumulation.MAX: np.maximum,
    Accumulation.BSUM: lambda a, b: a + b,
    Accumulation.NSUM: lambda a, b: a + b,
    Accumulation.SUM: lambda a, b: a + b,
    Accumulation.ASUM: lambda a, b: a + b * (1.0 - a),
    Accumulation.HSUM: lambda a, b: 1.0 - T_NORMS[Activation.HPROD](1.0 - a, 1.0 - b),
    Accumulation.ESUM: lambda a, b: (a + b) / (1.0 + a * b),
    Accumulation.DSUM: lambda a, b: np.where(np.minimum(a, b) == 0.0, np.maximum(a, b), 1.0),
    Accumulation.NMAX: lambda a, b: np.where(a + b < 1.0 - 1e-13, np.maximum(a, b), 1.0),
}


def base_of(terms, concluded, activation, accumulation, method=Method.COG):
    """Return y with `terms`; rule i concludes on a term with a weight, to the degree that d i brings in."""
    rules = tuple(rule(str(n), Degree(f"d{n}"), ("y", *then)) for n, then in enumerate(concluded))
    made = RuleBlock(name="r", activation=activation, accumulation=accumulation, rules=rules)
    area = replace(output("y", *terms, method=method, default=99.0), range=(LOW, HIGH))
    return block({}, (area,), made, more_inputs=tuple(Variable(f"d{n}") for n in range(len(concluded))))


def polyline(base, degrees, precision=LREAL):
    program = assemble(base, precision)
    memory = program.initial.copy()
    memory[: len(degrees)] = degrees
    evaluate_once(program, memory)
    first, end = memory[program.layout.areas["y"] :][:2].astype(int)
    return memory[first:end].reshape(-1, 2).astype(float)


def true_degrees(terms, concluded, degrees, activation, accumulation, xs):
    by_name = {term.name: term.shape.points for term in terms}
    total = np.zeros_like(xs)
    with np.errstate(divide="ignore", invalid="ignore"):
        for (name, weight), degree in zip(concluded, degrees, strict=True):
            if weight * degree > 0.0:
                mu = np.interp(xs, [p.x for p in by_name[name]], [p.degree for p in by_name[name]])
                part = weight * T_NORMS[activation](np.float64(degree), mu)
                total = S_NORMS[accumulation](total, part)
    return total


def errors(terms, concluded, degrees, activation, accumulation, precision=LREAL):
    """Return how far the polyline lies from the truth at many places."""
    near = NEAR if precision is LREAL else 1e-4
    line = polyline(base_of(terms, concluded, activation, accumulation), degrees, precision)
    xs = np.linspace(LOW, HIGH, 7919)
    if not len(line):
        return true_degrees(terms, concluded, degrees, activation, accumulation, xs)
    places = np.searchsorted(line[:, 0], xs)
    beside = [line[np.clip(places + shift, 0, len(line) - 1), 0] for shift in (-1, 0)]
    xs = xs[(np.abs(xs - beside[0]) > near) & (np.abs(xs - beside[1]) > near)]
    true = true_degrees(terms, concluded, degrees, activation, accumulation, xs)
    if accumulation is Accumulation.BSUM:
        true = np.minimum(1.0, true)
    if accumulation is Accumulation.NSUM:
        aside = 1e-12 if precision is LREAL else 1e-5  # vertices are rounded, the truth jumps beside them
        corners = np.concatenate([xs, *(line[:, 0] + beside for beside in (-aside, 0.0, aside))])
        true /= max(1.0, true_degrees(terms, concluded, degrees, activation, accumulation, corners).max())
    return np.abs(np.interp(xs, *line.T, left=0.0, right=0.0) - true)


BENDING = (Activation.HPROD, Activation.EPROD)
"""Activations that make curves of straight lines; NMAX is not followed under them."""


def random_area_errors(seed: int) -> tuple[str, np.ndarray]:
    """Return what was accumulated how, and how far its polyline lies from the truth at many places."""
    random = Random(seed)  # noqa: S311  nothing secret
    activation = random.choice([each for each in Activation if each is not Activation.DPROD])
    followed = activation not in {*BENDING, Activation.NMIN}
    accumulation = random.choice([each for each in Accumulation if followed or each is not Accumulation.NMAX])
    terms = []
    for number in range(random.randint(1, 3)):
        xs = sorted(random.sample(range(41), random.randint(2, 5)))
        degrees = [random.choice((0.0, 1.0, random.uniform(1e-9, 1.0))) for _ in xs]
        terms.append(points(f"t{number}", *zip([x / 4 for x in xs], degrees, strict=True)))
    concluded = tuple(
        (random.choice(terms).name, random.choice((1.0, 0.5))) for _ in range(random.randint(1, 8))
    )
    fired = tuple(random.uniform(0.01, 1.0) for _ in concluded)
    found = errors(tuple(terms), concluded, fired, activation, accumulation)
    return f"{activation} {accumulation}", found
