"""The crane of Annex C in other Python libraries; runs in an environment of theirs, with none of ours.

Reads one request per line, {"peer", "areas", "points"}, and answers with the
seconds of processor time that the points took, one call each, and their values.
"""

import json
import sys
import time
import warnings
from collections.abc import Callable
from io import StringIO
from typing import Any

Evaluate = Callable[[float, float], float]

DISTANCE = {
    "zero": ((-5, 0), (0, 1), (5, 0)),
    "close": ((0, 0), (5, 1), (10, 0)),
    "medium": ((5, 0), (10, 1), (22, 0)),
    "far": ((10, 0), (22, 1), (30, 1)),
}
ANGLE = {
    "neg_big": ((-90, 1), (-50, 1), (-5, 0)),
    "neg_small": ((-50, 0), (-5, 1), (0, 0)),
    "zero": ((-5, 0), (0, 1), (5, 0)),
    "pos_small": ((0, 0), (5, 1), (50, 0)),
    "pos_big": ((5, 0), (50, 1), (90, 1)),
}
PLACES = {"neg_high": -27, "neg_medium": -9, "zero": 0, "pos_medium": 9, "pos_high": 27}
WIDTH, LIMIT, SAMPLES = 18, 36, 1000
RULES = (
    ("far", "zero", "pos_medium"),
    ("far", "neg_small", "pos_high"),
    ("far", "neg_big", "pos_medium"),
    ("medium", "neg_small", "neg_medium"),
    ("close", "pos_small", "pos_medium"),
    ("zero", "zero", "zero"),
)


def pyfuzzylite(*, areas: bool) -> Evaluate:
    """Return the crane in pyfuzzylite: Mamdani with its centroid, or constants with its weighted average."""
    import fuzzylite as fl

    def points(name: str, pairs: Any) -> Any:
        return fl.Discrete(name, fl.Discrete.to_xy([x for x, _ in pairs], [y for _, y in pairs]))

    def variable(name: str, terms: dict[str, Any], low: float, high: float) -> Any:
        made = [points(each, pairs) for each, pairs in terms.items()]
        return fl.InputVariable(name=name, minimum=low, maximum=high, terms=made)

    if areas:
        terms = [fl.Triangle(name, x - WIDTH, x, x + WIDTH) for name, x in PLACES.items()]
        defuzzifier = fl.Centroid(SAMPLES)
    else:
        terms = [fl.Constant(name, x) for name, x in PLACES.items()]
        defuzzifier = fl.WeightedAverage()
    power = fl.OutputVariable(
        name="power",
        minimum=-LIMIT,
        maximum=LIMIT,
        aggregation=fl.Maximum(),
        defuzzifier=defuzzifier,
        default_value=0.0,
        terms=terms,
    )
    distance, angle = variable("distance", DISTANCE, -10, 30), variable("angle", ANGLE, -90, 90)
    rules = [fl.Rule.create(f"if distance is {d} and angle is {a} then power is {p}") for d, a, p in RULES]
    block = fl.RuleBlock(
        conjunction=fl.Minimum(), implication=fl.Minimum(), activation=fl.General(), rules=rules
    )
    engine = fl.Engine(input_variables=[distance, angle], output_variables=[power], rule_blocks=[block])
    for rule in rules:
        rule.load(engine)

    def evaluate(d: float, a: float) -> float:
        distance.value, angle.value = d, a
        engine.process()
        return float(power.value)

    return evaluate


def simpful(*, areas: bool) -> Evaluate:
    """Return the crane in simpful: Mamdani with its centroid, or crisp outputs with Sugeno's average."""
    import simpful as sf

    system = sf.FuzzySystem(show_banner=False, verbose=False)

    def variable(name: str, terms: dict[str, Any], low: float, high: float) -> None:
        sets = [sf.FuzzySet(points=[[x, y] for x, y in pairs], term=each) for each, pairs in terms.items()]
        system.add_linguistic_variable(name, sf.LinguisticVariable(sets, universe_of_discourse=[low, high]))

    variable("distance", DISTANCE, -10, 30)
    variable("angle", ANGLE, -90, 90)
    if areas:
        triangles = {name: ((x - WIDTH, 0), (x, 1), (x + WIDTH, 0)) for name, x in PLACES.items()}
        variable("power", triangles, -LIMIT, LIMIT)
    else:
        for name, x in PLACES.items():
            system.set_crisp_output_value(name, x)
    system.add_rules([f"IF (distance IS {d}) AND (angle IS {a}) THEN (power IS {p})" for d, a, p in RULES])

    def evaluate(d: float, a: float) -> float:
        system.set_variable("distance", d)
        system.set_variable("angle", a)
        if areas:
            return float(system.Mamdani_inference(["power"], subdivisions=SAMPLES)["power"])
        return float(system.Sugeno_inference(["power"])["power"])

    return evaluate


def scikit_fuzzy(*, areas: bool) -> Evaluate:
    """Return the crane in scikit-fuzzy, which has no singletons: always with areas."""
    import numpy as np
    from skfuzzy import control as fc
    from skfuzzy import interp_membership

    if not areas:
        raise NotImplementedError

    def variable(kind: Any, name: str, terms: dict[str, Any], low: float, high: float) -> Any:
        made = kind(np.linspace(low, high, SAMPLES + 1), name)
        for each, pairs in terms.items():
            xs, ys = zip(*pairs, strict=True)
            made[each] = interp_membership(np.array(xs, float), np.array(ys, float), made.universe)
        return made

    distance = variable(fc.Antecedent, "distance", DISTANCE, -10, 30)
    angle = variable(fc.Antecedent, "angle", ANGLE, -90, 90)
    triangles = {name: ((x - WIDTH, 0), (x, 1), (x + WIDTH, 0)) for name, x in PLACES.items()}
    power = variable(fc.Consequent, "power", triangles, -LIMIT, LIMIT)
    rules = [fc.Rule(distance[d] & angle[a], power[p]) for d, a, p in RULES]
    simulation = fc.ControlSystemSimulation(fc.ControlSystem(rules))

    def evaluate(d: float, a: float) -> float:
        simulation.input["distance"], simulation.input["angle"] = d, a
        simulation.compute()
        return float(simulation.output["power"])

    return evaluate


PEERS = {"scikit-fuzzy": scikit_fuzzy, "pyfuzzylite": pyfuzzylite, "simpful": simpful}


def main() -> None:
    """Answer requests until there are no more."""
    warnings.simplefilter("ignore")
    answers, sys.stdout = sys.stdout, StringIO()  # simpful talks
    made: dict[tuple[str, bool], Evaluate] = {}
    for line in sys.stdin:
        request = json.loads(line)
        key = request["peer"], request["areas"]
        if key not in made:
            made[key] = PEERS[key[0]](areas=key[1])
        evaluate, values = made[key], []
        begin = time.process_time()
        for distance, angle in request["points"]:
            values.append(evaluate(distance, angle))
        seconds = time.process_time() - begin
        print(json.dumps({"seconds": seconds, "values": values}), file=answers, flush=True)


if __name__ == "__main__":
    main()
