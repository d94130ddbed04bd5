"""Controllers once more, literally: the parts of the ISA form one by one."""

from math import inf, sqrt

from tests.loop.block_bench import Case


def reader(samples, told):
    """Return what port `name` carries at scan k: a signal, or the number that was told."""
    return lambda name, k: samples[name][k] if name in samples else told[name]


class Rate:
    """The derivative behind its filter, written with the pole of the filter."""

    def __init__(self):
        self.value, self.before = 0.0, None

    def begin(self, w):
        self.value, self.before = 0.0, w

    def step(self, w, lag, cycle):
        self.value = lag / (lag + cycle) * self.value + (w - self.before) / (lag + cycle)
        self.before = w


DEFAULTS = {
    "Ti": inf,
    "Td": 0.0,
    "N": 10.0,
    "Tt": 0.0,
    "low": -inf,
    "high": inf,
    "automatic": 1.0,
    "reset": 0.0,
    "feedforward": 0.0,
}


def isa(b=1.0, c=0.0, initial=0.0, back=False, **told):
    def law(samples, times, cycle):
        of = reader(samples, DEFAULTS | told)
        rate, outputs, integral, v, last_gain = Rate(), [], initial, None, None
        for k in range(len(times)):
            r, y, gain = of("setpoint", k), of("measurement", k), of("Kc", k)
            ti, td = of("Ti", k), max(of("Td", k), 0.0)
            ti = ti if ti > 0 else inf
            start = k == 0 or of("reset", k) != 0
            if start:
                rate.begin(c * r - y)
                integral = initial
            else:
                rate.step(c * r - y, td / of("N", k), cycle)
                integral += last_gain * (b - 1) * r - gain * (b - 1) * r
            parts = gain * (b * r - y) + gain * td * rate.value + of("feedforward", k)
            low, high = of("low", k), of("high", k)
            if of("automatic", k):
                added = gain / ti * (r - y) * cycle
                if back and not start:
                    given = samples["tracked"][k - 1] if "tracked" in samples else outputs[-1]
                    tracking = of("Tt", k) or (sqrt(ti * td) if td else ti)
                    integral += (given - v) * min(1.0, cycle / tracking)
                without, within = parts + integral, parts + integral + added
                if not back and added > 0 and within > high:
                    added = high - without if without < high else 0.0
                if not back and added < 0 and within < low:
                    added = low - without if without > low else 0.0
                integral += added
                v = parts + integral
                outputs.append(min(max(v, low), high))
            else:
                still = outputs[-1] if k else initial
                v = min(max(samples["manual"][k] if "manual" in samples else still, low), high)
                outputs.append(v)
                integral = v - parts
            last_gain = gain
        return outputs

    return law


def velocity(b=1.0, c=0.0, initial=0.0, increments=False, **told):
    def law(samples, times, cycle):
        of = reader(samples, DEFAULTS | told)
        rate, outputs, before = Rate(), [], None
        for k in range(len(times)):
            r, y, gain, f = (of(name, k) for name in ("setpoint", "measurement", "Kc", "feedforward"))
            ti, td = of("Ti", k), max(of("Td", k), 0.0)
            moved = gain / ti * (r - y) * cycle if ti > 0 else 0.0
            start, last_rate = k == 0 or of("reset", k) != 0, rate.value
            if start:
                rate.begin(c * r - y)
            else:
                rate.step(c * r - y, td / of("N", k), cycle)
                moved += (
                    gain * ((b * r - y) - before[0]) + gain * td * (rate.value - last_rate) + f - before[1]
                )
            base = 0.0 if increments else initial if start else outputs[-1]
            wanted = base + moved
            if not of("automatic", k):
                wanted = samples["manual"][k] if "manual" in samples else base
            outputs.append(min(max(wanted, of("low", k)), of("high", k)))
            before = (b * r - y, f)
        return outputs

    return law


LOOP = {"setpoint": "stairs", "measurement": "wave"}
SWITCHED = LOOP | {"automatic": "flag", "reset": "other_flag"}
ADAPTED = LOOP | {"Kc": "ratio", "Ti": "moment", "Td": "moment"}
PI = {"Kc": "2 kW/m", "Ti": "0.5 s"}
PI_LIMITED = PI | {"low": "-3000 W", "high": "4 kW"}
IN_METRES = {"Kc": 2.0, "Ti": "0.5 s", "low": "-3 m", "high": "4 m"}
PID = PI_LIMITED | {"Td": "100 ms", "N": 5.0, "b": 0.4, "c": 0.7, "initial": "1 kW"}


def case(block, law, inputs, **parameters):
    return Case(block=block, law=law, inputs=inputs, parameters=parameters, tolerance=1e-9)


LAW = {"Kc": 2.0, "Ti": 0.5, "low": -3.0, "high": 4.0, "Td": 0.1}
WEIGHTS = {"N": 5.0, "b": 0.4, "c": 0.7, "initial": 1.0}
BACK = {"anti_windup": "back_calculation"}

CASES = [
    case("pid", isa(Kc=-2.0), LOOP, Kc="-2 kW/m"),
    case("pid", isa(Kc=2.0, Ti=0.5), LOOP | {"measurement": "-wave"}, **PI),
    case("pid", isa(Kc=2.0, Ti=0.5, low=-3.0, high=4.0), LOOP, **PI_LIMITED),
    case("pid", isa(**LAW, **WEIGHTS), LOOP, **PID),
    case("pid", isa(**LAW, **WEIGHTS, back=True), LOOP, **PID, **BACK),
    case("pid", isa(**LAW, **WEIGHTS, back=True, Tt=0.3), LOOP, **PID, **BACK, Tt="300 ms"),
    case("pid", isa(**LAW, **WEIGHTS, back=True, Tt=0.001), LOOP, **PID, **BACK, Tt="1 ms"),
    case(
        "pid",
        isa(Kc=2.0, Ti=0.5, low=-3.0, high=4.0, back=True),
        LOOP | {"tracked": "ramp", "automatic": "flag"},
        **IN_METRES,
        **BACK,
    ),
    case("pid", isa(**LAW, **WEIGHTS), SWITCHED, **PID),
    case(
        "pid",
        isa(**LAW, **WEIGHTS),
        SWITCHED | {"manual": "ramp", "feedforward": "stairs"},
        **IN_METRES,
        **WEIGHTS | {"initial": "1 m", "Td": "0.1 s"},
    ),
    case(
        "pid",
        isa(b=0.3, c=1.0, low=-3.0),
        ADAPTED | {"high": "-ramp"},
        b=0.3,
        c=1.0,
        low="-3 m",
    ),
    case("pid", isa(low=-3.0, high=4.0, back=True), ADAPTED, low="-3 m", high="4 m", **BACK),
    case("pid_velocity", velocity(Kc=-2.0), LOOP, Kc="-2 kW/m"),
    case("pid_velocity", velocity(Kc=2.0, Ti=0.5), LOOP | {"measurement": "-wave"}, **PI),
    case("pid_velocity", velocity(**LAW, **WEIGHTS), LOOP, **PID),
    case(
        "pid_velocity",
        velocity(**LAW, **WEIGHTS, increments=True),
        SWITCHED,
        **PID,
        gives="increment",
    ),
    case("pid_velocity", velocity(**LAW, **WEIGHTS), SWITCHED, **PID),
    case(
        "pid_velocity",
        velocity(**LAW, **WEIGHTS),
        SWITCHED | {"manual": "ramp", "feedforward": "stairs"},
        **IN_METRES,
        **WEIGHTS | {"initial": "1 m", "Td": "0.1 s"},
    ),
    case(
        "pid_velocity",
        velocity(b=0.3, c=1.0, low=-3.0),
        ADAPTED | {"high": "-ramp"},
        b=0.3,
        c=1.0,
        low="-3 m",
    ),
]
