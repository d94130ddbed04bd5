"""Delays once more, in plain Python."""

from math import ceil, floor, fsum

from tests.loop.block_bench import Case


def one_scan_late(initial):
    return lambda samples, times, cycle: [initial, *samples["input"][:-1]]


def at(signal, when, initial):
    """Return a signal at a time in scans, on straight lines between its samples."""
    below, above = (signal[i] if i >= 0 else initial for i in (floor(when), ceil(when)))
    return below + (when - floor(when)) * (above - below)


def delayed(scans, initial=0.0):
    def law(samples, times, cycle):
        return [at(samples["input"], k - scans, initial) for k in range(len(times))]

    return law


def held_and_delayed(scans):
    def law(samples, times, cycle):
        return [at(samples["input"], floor(k - scans), 0.0) for k in range(len(times))]

    return law


def varying(shortest, longest, initial=0.0):
    def law(samples, times, cycle):
        late = [min(max(theta, shortest), longest) / cycle for theta in samples["time"]]
        return [at(samples["input"], round(k - each, 9), initial) for k, each in enumerate(late)]

    return law


def mean(scans):
    def law(samples, times, cycle):
        u = samples["input"]
        windows = [u[max(0, k + 1 - scans) : k + 1] for k in range(len(u))]
        return [fsum(each) / len(each) for each in windows]

    return law


def held(scans):
    return lambda samples, times, cycle: [samples["input"][k - k % scans] for k in range(len(times))]


INPUT = {"input": "wave"}


def dead_time(law, tolerance=0.0, **parameters):
    return Case(block="dead_time", inputs=INPUT, parameters=parameters, law=law, tolerance=tolerance)


CASES = [
    Case(block="unit_delay", inputs={"input": "-wave"}, law=one_scan_late(0.0)),
    Case(
        block="unit_delay", inputs={"input": "wave"}, parameters={"initial": "250 cm"}, law=one_scan_late(2.5)
    ),
    dead_time(delayed(0), time="0 s"),
    dead_time(delayed(1), time="20 ms"),
    dead_time(delayed(15, 2.5), time="300 ms", initial="250 cm"),
    dead_time(delayed(0.25), 1e-14, time="5 ms"),
    dead_time(delayed(1.5, 2.5), 1e-14, time="30 ms", initial="250 cm"),
    dead_time(held_and_delayed(0.25), time="5 ms", between="hold"),
    dead_time(held_and_delayed(7.75), time="155 ms", between="hold"),
    Case(
        block="dead_time",
        inputs={"input": "-wave", "time": "moment"},
        parameters={"longest": "0.6 s", "initial": "1 m"},
        law=varying(0.0, 0.6, 1.0),
        tolerance=1e-8,
    ),
    Case(
        block="dead_time",
        inputs={"input": "wave", "time": "moment"},
        parameters={"shortest": "0.2 s", "longest": "0.51 s"},
        law=varying(0.2, 0.51),
        tolerance=1e-8,
    ),
    Case(block="moving_average", inputs=INPUT, parameters={"scans": 7}, law=mean(7), tolerance=1e-14),
    Case(
        block="moving_average",
        inputs={"input": "-wave"},
        parameters={"duration": "0.3 s"},
        law=mean(15),
        tolerance=1e-14,
    ),
    Case(block="moving_average", inputs=INPUT, parameters={"scans": 1}, law=mean(1)),
    Case(block="sample_hold", inputs=INPUT, parameters={"duration": "60 ms"}, law=held(3)),
    Case(block="sample_hold", inputs=INPUT, parameters={"scans": 1}, law=held(1)),
    Case(block="sample_hold", inputs={"input": "-wave"}, parameters={"scans": 50}, law=held(50)),
]
