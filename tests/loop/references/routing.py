"""Blocks that choose among signals and share one out once more, in plain Python."""

from math import dist, inf
from statistics import median

from fcl_sim.units import parse_quantity
from tests.loop.block_bench import Case


def chosen(level, then, otherwise):
    def law(samples, times, cycle):
        first, second = (samples.get(name, [value] * len(times)) for name, value in (then, otherwise))
        return [a if u >= level else b for u, a, b in zip(samples["when"], first, second, strict=True)]

    return law


def choice(pick):
    def law(samples, times, cycle):
        return [pick(each) for each in zip(*(samples[port] for port in "123"), strict=True)]

    return law


def by_index(samples, times, cycle):
    outputs = []
    for k, index in enumerate(samples["index"]):
        port = str(min(max(round(index + 1e-12), 0), 2) + 1)
        outputs.append(samples[port][k])
    return outputs


def shared(elements):
    def law(samples, times, cycle):
        outputs = {}
        for name, (begin, end, first, last) in elements.items():
            parts = [min(max((u - begin) / (end - begin), 0.0), 1.0) for u in samples["input"]]
            outputs[name] = [(1.0 - part) * first + part * last for part in parts]
        return outputs

    return law


def memberships(prototypes, fuzzifier, ports):
    """Return fuzzy c-means as Bezdek writes it: a point at prototypes belongs to these alone."""

    def at(point):
        distances = [dist(point, each) for each in prototypes.values()]
        if 0.0 in distances:
            return [(each == 0.0) / distances.count(0.0) for each in distances]
        power = 2.0 / (fuzzifier - 1.0)
        return [1.0 / sum((mine / each) ** power for each in distances) for mine in distances]

    def law(samples, times, cycle):
        points = zip(*(samples[port] for port in ports), strict=True)
        return dict(zip(prototypes, zip(*map(at, points), strict=True), strict=True))

    return law


def rows(**given):
    return {name: tuple(parse_quantity(each) for each in row) for name, row in given.items()}


THREE = {"1": "wave", "2": "stairs", "3": "-ramp"}
ELEMENTS = {"cooling": (-2.0, 0.0, 100.0, 0.0), "heating": (-0.5, 1.5, 3.0, 20.0)}
WRITTEN = rows(
    cooling=("-2 m", "0 m", "100 %", "0 %"),
    heating=("-50 cm", "1.5 m", "3 kW", "20000 W"),
)
PLACES = {"low": (-2.0, 0.5), "middle": (0.0, 0.0), "high": (1.0, 1.0), "again": (0.0, 0.0)}
MARKS = rows(low=("-2 m", "50 cm"), middle=("0 m", "0 m"), high=("1 m", "1 m"), again=("0 m", "0 m"))


def selector(law, by, **inputs):
    return Case(block="selector", inputs={**inputs, **THREE}, parameters={"by": by}, law=law)


def classifier(law, inputs, tolerance=1e-12, **parameters):
    return Case(block="classifier", inputs=inputs, parameters=parameters, law=law, tolerance=tolerance)


CASES = [
    Case(
        block="switch",
        inputs={"when": "flag", "then": "wave", "otherwise": "-ramp"},
        law=chosen(0.5, ("then", inf), ("otherwise", inf)),
    ),
    Case(
        block="switch",
        inputs={"when": "wave", "otherwise": "stairs"},
        parameters={"level": "-50 cm", "then": "3 m"},
        law=chosen(-0.5, ("then", 3.0), ("otherwise", inf)),
    ),
    Case(
        block="switch",
        inputs={"when": "-stairs", "level": "wave"},
        parameters={"then": "2 kW", "otherwise": "-500 W"},
        law=lambda samples, times, cycle: [
            2.0 if u >= level else -0.5 for u, level in zip(samples["when"], samples["level"], strict=True)
        ],
    ),
    selector(choice(min), "min"),
    selector(choice(max), "max"),
    selector(choice(median), "median"),
    Case(
        block="selector",
        inputs={"1": "wave", "2": "stairs", "3": "-ramp", "4": "-ramp"},
        parameters={"by": "median"},
        law=lambda samples, times, cycle: [
            median(each) for each in zip(*(samples[port] for port in "1234"), strict=True)
        ],
    ),
    selector(by_index, "index", index="ratio"),
    Case(
        block="distribute",
        inputs={"input": "wave"},
        parameters={"elements": WRITTEN},
        law=shared(ELEMENTS),
        tolerance=1e-13,
    ),
    classifier(memberships(PLACES, 2.0, "12"), {"1": "wave", "2": "stairs"}, prototypes=MARKS),
    classifier(
        memberships(PLACES, 1.25, "12"), {"1": "wave", "2": "-ramp"}, prototypes=MARKS, fuzzifier="1.25"
    ),
    classifier(
        memberships({"a": (0.0,), "b": (3.0,)}, 4.0, "1"),
        {"1": "stairs"},
        prototypes=rows(a=("0 m",), b=("3 m",)),
        fuzzifier="4",
    ),
]
