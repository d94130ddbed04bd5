"""The basic blocks once more, in plain Python."""

from itertools import accumulate, pairwise

from tests.loop.block_bench import Case


def weighted(first, second):
    def law(samples, times, cycle):
        return [0.0 + first * a + second * b for a, b in zip(samples["1"], samples["2"], strict=True)]

    return law


def difference(lag):
    def law(samples, times, cycle):
        u, y = samples["input"], [0.0]
        for before, now in pairwise(u):
            y.append(y[-1] + cycle / (lag + cycle) * ((now - before) / cycle - y[-1]))
        return y

    return law


def limited(low, high):
    return lambda samples, times, cycle: [min(max(each, low), high) for each in samples["input"]]


def limited_by_signals(samples, times, cycle):
    return [min(max(u, -2.0), high) for u, high in zip(samples["input"], samples["high"], strict=True)]


def backward(samples, times, cycle):
    return list(accumulate((cycle * each for each in samples["input"]), initial=1.5))[1:]


def forward(samples, times, cycle):
    return list(accumulate((cycle * each for each in samples["input"]), initial=1.5))[:-1]


def trapezoidal(samples, times, cycle):
    u = [0.0, *samples["input"]]
    areas = (cycle * (0.5 * (now + before)) for before, now in pairwise(u))
    return list(accumulate(areas, initial=0.0))[1:]


def held_and_reset(low, high):
    def law(samples, times, cycle):
        y, outputs = 0.1, []
        for u, reset, hold in zip(samples["input"], samples["reset"], samples["hold"], strict=True):
            if reset:
                y = 0.1
            elif not hold:
                y = y + cycle * u
            y = max(low, min(y, high))
            outputs.append(y)
        return outputs

    return law


INPUT = {"input": "wave"}
SWITCHES = {"input": "wave", "reset": "flag", "hold": "other_flag"}

CASES = [
    Case(
        block="sum",
        inputs={"1": "wave", "2": "-ramp"},
        parameters={"1": 2.0, "2": "0.5"},
        law=weighted(2.0, 0.5),
    ),
    Case(
        block="gain",
        inputs=INPUT,
        parameters={"gain": "3 kW/m"},
        law=lambda samples, times, cycle: [3.0 * each for each in samples["input"]],
    ),
    Case(block="differentiator", inputs=INPUT, law=difference(0.0)),
    Case(
        block="differentiator",
        inputs={"input": "-wave"},
        parameters={"filter": "50 ms"},
        law=difference(0.05),
    ),
    Case(block="limiter", inputs=INPUT, parameters={"low": "-50 cm", "high": "1 m"}, law=limited(-0.5, 1.0)),
    Case(block="limiter", inputs=INPUT, parameters={"high": "1 m"}, law=limited(float("-inf"), 1.0)),
    Case(
        block="limiter",
        inputs={"input": "wave", "high": "-ramp"},
        parameters={"low": "-2 m"},
        law=limited_by_signals,
    ),
    Case(block="integrator", inputs=INPUT, parameters={"initial": "1.5 m s"}, law=backward),
    Case(
        block="integrator", inputs=INPUT, parameters={"initial": "1.5 m s", "method": "forward"}, law=forward
    ),
    Case(block="integrator", inputs=INPUT, parameters={"method": "trapezoidal"}, law=trapezoidal),
    Case(
        block="integrator",
        inputs=SWITCHES,
        parameters={"initial": "0.1 m s", "low": "-0.05 m s", "high": "30 cm s"},
        law=held_and_reset(-0.05, 0.3),
    ),
]
