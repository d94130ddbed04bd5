"""Concept's blocks in a loop: bit for bit the library's instances, through the tape; what they refuse."""

import numpy as np
import pytest

from fcl_sim import concept
from fcl_sim.concept.values import FUZ_MD_INT, FUZ_MD_REAL
from fcl_sim.diagnostics import InputFault
from fcl_sim.loop.blocks import BLOCKS, FAMILIES
from fcl_sim.loop.blocks.concept_row import integer_block, real_block
from fcl_sim.loop.diagram import Diagram, Node, PlantNode, Wire
from fcl_sim.loop.run import run
from fcl_sim.loop.wiring import wire
from fcl_sim.units import parse_quantity
from tests.loop.diagrams import plant_of, timing

COUNTS = """
PLANT = Plant(
    name="plc",
    title="Signals of a PLC, all over the range of their types",
    states=(State("nothing", "1", 0.0, "stays"),),
    inputs=(),
    outputs=(
        *(Output(f"int{i}", "1", "an INT") for i in range(4)),
        *(Output(f"degree{i}", "1", "a degree in INT, at times beyond 0 and 10000") for i in range(4)),
        *(Output(f"real{i}", "1", "a REAL") for i in range(4)),
        *(Output(f"part{i}", "1", "a degree in REAL, at times beyond 0 and 1") for i in range(4)),
        Output("flag", "1", "0 or 1"),
        Output("enable", "1", "seldom 0"),
        Output("n", "1", "-1 to 9"),
        Output("length", "m", "a length"),
    ),
    parameters=(),
)


def dynamics(t, x, u, p, mode, dx):
    dx[0] = 0.0


def outputs(t, x, u, p, mode, y):
    for i in range(4):
        wild = sin(7919.0 * (i + 1.3) * t + i)
        tame = 0.5 + 0.51 * sin(6101.0 * (i + 0.7) * t + i)
        y[i] = floor(32767.0 * wild + 0.5)
        y[4 + i] = floor(10000.0 * tame)
        y[8 + i] = exp(80.0 * wild) if i == 3 else 1e3 * wild
        y[12 + i] = tame
    y[16] = 1.0 if sin(977.0 * t) > 0.0 else 0.0
    y[17] = 0.0 if sin(1409.0 * t) > 0.9 else 1.0
    y[18] = floor(4.5 + 5.49 * sin(3301.0 * t))
    y[19] = t
"""

SCAN, SECONDS = 0.02, 8.0


@pytest.fixture(scope="module")
def plc(tmp_path_factory):
    return plant_of(tmp_path_factory.mktemp("plc"), COUNTS, "plc")


def loop(plc, *nodes, seconds=SECONDS):
    return Diagram(plant=PlantNode(name="plc", model=plc), nodes=nodes, timing=timing(1e3 * SCAN, seconds))


def block(name, type_, /, inputs=None, **pins):
    """Return a block; pins are numbers, or signals of the plant, with a sign; `inputs` are whole names."""
    wires = {
        pin: Wire(f"plc.{each.removeprefix('-')}", -1.0 if each[0] == "-" else 1.0)
        for pin, each in pins.items()
        if isinstance(each, str) and pin != "rounding"
    }
    wires |= {pin: Wire(each) for pin, each in (inputs or {}).items()}
    numbers = {pin: parse_quantity(each) for pin, each in pins.items() if isinstance(each, int | float)}
    chosen = {"rounding": pins["rounding"]} if "rounding" in pins else {}
    return Node(name=name, type=type_, inputs=wires, parameters=numbers | chosen)


def pins(stem, *values):
    return {f"{stem}{i}": each for i, each in enumerate(values, 1)}


def cycled(count, *signals):
    return [signals[i % len(signals)] for i in range(count)]


def structure(name):
    """Return the wires from the structure that the block `name` gives."""
    return {str(i): f"{name}.MD.{member}" for i, member in enumerate(FUZ_MD_INT._fields, 1)}


INT_POINTS = (-30_000, -4000, -3999, 0, 17, 5000, 5003, 30_000, 32_767)
REAL_POINTS = (-900.5, -0.1, 0.0, 0.3, 1.0, 77.7, 500.0, 501.0, 900.0)
BOTH = {
    "INT": ("int", "degree", INT_POINTS, {"rounding": "truncate"}),
    "REAL": ("real", "part", REAL_POINTS, {}),
}


def blocks_of(number, further):
    """Return blocks of every kind and of several widths in INT or in REAL, and errors of all kinds."""
    value, degree, points, _ = BOTH[number]
    values, degrees = [f"{value}{i}" for i in range(4)], [f"{degree}{i}" for i in range(4)]
    t = "STI" if number == "INT" else "STR"
    for count in (2, 3, 5, 9, 10):
        given = pins("S", *(*points, points[-1])[:count])
        yield block(f"aterm{count}", f"FUZ_ATERM_{number}", X=values[0], EN="enable", **given, **further)
        yield block(f"struct{count}", f"FUZ_ATERM_{t}", X=values[1], EN="enable", **given, **further)
    yield block(
        "ordered", f"FUZ_ATERM_{number}", X=values[0], **pins("S", values[1], 0, values[2]), **further
    )
    for count in (2, 3, 4, 5):
        given = pins("S", *cycled(count, *values[1:], "-" + values[1]))
        yield block(f"sterm{count}", f"FUZ_STERM_{number}", X=values[0], **given, **further)
    for kind, stem in (("MIN", "IN"), ("MAX", "IN"), ("PROD", "MD"), ("SUM", "MD")):
        for count in (2, 5, 32):
            given = pins(stem, *cycled(count, *degrees))
            yield block(f"{kind}{count}", f"FUZ_{kind}_{number}", EN="enable", **given, **further)
        given = pins(stem, *values[:3], "-" + values[3])
        yield block(f"{kind}wild", f"FUZ_{kind}_{number}", **given, **further)
    for pairs in (2, 4, 9, 10):
        given = cycled(2 * pairs, degrees[0], values[0], degrees[1], points[3], degrees[2], values[3])
        yield block(f"defuz{pairs}", f"DEFUZ_{number}", EN="enable", **pins("MDiSi", *given), **further)
    yield block(
        "odd", f"DEFUZ_{number}", **pins("MDiSi", degrees[0], 0, degrees[1], 1, degrees[2]), **further
    )
    for name, zero in (("zeroed", "flag"), ("held", 0)):
        given = pins("MDiSi", "flag", points[-1], 0, points[0])
        yield block(name, f"DEFUZ_{number}", ZERO_Y=zero, **given, **further)
    for terms, count in ((5, 5), (3, 4), (9, 9), (9, 2), (5, 10)):
        given = pins("S", *(*points, points[-1])[:count])
        name = f"of{terms}by{count}"
        yield block(name, f"DEFUZ_{t}", structure(f"struct{terms}"), ZERO_Y="flag", **given, **further)
    short = {"1": "plc.n", "2": f"plc.{degrees[0]}", "3": f"plc.{degrees[1]}"}
    yield block("short", f"DEFUZ_{t}", short, **pins("S", *points[:4]), **further)


def replayed(node, trace):
    """Yield what an instance of the library gives, scan by scan, on what the block has read."""
    kind = concept.BLOCKS[node.type]
    given = {pin: each.value for pin, each in node.parameters.items() if pin != "rounding"}
    instance = getattr(concept, node.type)(
        inputs=sum(
            pin.startswith(kind.stem) and pin[len(kind.stem) :].isdigit() for pin in {*given, *node.inputs}
        ),
        **({"rounding": node.parameters["rounding"]} if "rounding" in node.parameters else {}),
    )
    whole = kind.number == "INT"
    for scan in range(trace.time.size):
        read = {pin: each.sign * trace[each.source][scan] for pin, each in node.inputs.items()} | given
        members = [read.pop(str(i), 0) for i in range(1, 11)]
        call = {
            pin: int(value) if whole else value for pin, value in read.items() if pin not in {"EN", "ZERO_Y"}
        }
        if "ZERO_Y" in kind.leading:
            call["ZERO_Y"] = bool(read.get("ZERO_Y", 0))
        if "MD.n" in kind.leading:
            members[0] = int(members[0])
            call["MD"] = FUZ_MD_INT(*map(int, members)) if whole else FUZ_MD_REAL(*members)
        instance(EN=bool(read.get("EN", 1)), **call)
        words = [word for each in instance.outputs.values() for word in np.atleast_1d(each).tolist()]
        number = 0 if instance.event is None else [*concept.Event].index(instance.event) + 1
        yield [*words, float(instance.ENO), -number if instance.ENO else number]


@pytest.mark.parametrize(
    ("number", "further"),
    [("INT", {"rounding": "truncate"}), ("INT", {"rounding": "round"}), ("INT", {}), ("REAL", {})],
    ids=["truncated", "rounded", "as it comes", "REAL"],
)
def test_every_block_through_the_tape_gives_bit_for_bit_what_the_library_gives(plc, number, further):
    nodes = tuple(blocks_of(number, further))
    with np.errstate(over="ignore"):
        trace = run(loop(plc, *nodes))
        replays = {node.name: np.array(list(replayed(node, trace)), dtype=float) for node in nodes}
    assert trace.fault is None
    seen = set()
    for node in nodes:
        names = [name for name in trace.names if name.partition(".")[0] == node.name]
        ours = np.array([trace[name] for name in names]).T
        assert ours.tobytes() == replays[node.name].tobytes(), node.name
        assert (np.unique(ours[:, :-2], axis=0).shape[0] > 1) == ours[:, -2].any(), node.name
        seen |= set(ours[:, -1])
    assert {node.type for node in nodes} == {
        name for name, kind in concept.BLOCKS.items() if kind.number == number
    }
    assert seen == {0, 1, 2, 3, 4, -2}


def test_the_family_is_the_librarys_table_row_for_row():
    (family,) = (each for each in FAMILIES if each.name == "concept")
    rows = family.table[: len(concept.TABLE)]
    assert [each.name for each in rows] == [each.name for each in concept.TABLE]
    for block_type, kind in zip(rows, concept.TABLE, strict=True):
        assert block_type.kernel is (integer_block if kind.number == "INT" else real_block)
        own = {each.name for each in block_type.parameters} | ({"MD"} if block_type.group else set())
        assert own - {"rounding"} == {word.partition(".")[0] for word in kind.inputs(32)}
        assert [each.name for each in block_type.outputs] == [*kind.outputs, "ENO", "event"]
        assert ("rounding" in own) == (kind.number == "INT")


def test_a_block_that_is_not_enabled_leaves_its_outputs(plc):
    trace = run(loop(plc, block("max", "FUZ_MAX_INT", EN="enable", IN1="degree0", IN2="degree1")))
    off = np.flatnonzero(trace["plc.enable"] == 0.0)
    assert off.size > 5
    assert off[0] > 0
    assert np.array_equal(trace["max.OUT"][off], trace["max.OUT"][off - 1])
    assert np.array_equal(trace["max.ENO"], trace["plc.enable"])


def test_an_error_is_entered_once_for_the_scans_it_lasts(plc):
    ramp = block("ordered", "FUZ_ATERM_INT", X=0, S1="flag", S2=1)
    warned = block("warned", "DEFUZ_STI", {"1": "plc.flag", "2": "plc.flag"}, S1=0, S2=1)
    trace = run(loop(plc, ramp, warned))
    number = trace["ordered.event"]
    assert set(number) == {0, 3}
    starts = [int(trace.ticks[i]) for i in range(number.size) if number[i] and (i == 0 or not number[i - 1])]
    told = [each.tick for each in trace.events if each.block == "ordered"]
    assert told == starts
    assert {each.name for each in trace.events} == {
        concept.Event.INPUT_VALUE_OUT_OF_RANGE,
        concept.Event.WRONG_NUMBER_OF_INPUTS,
    }
    assert [each.tick for each in trace.events] == sorted(each.tick for each in trace.events)
    assert all(each.warning == (each.block == "warned") for each in trace.events)
    assert set(trace["warned.ENO"]) == {1.0}


@pytest.mark.parametrize(
    ("node", "reason"),
    [
        (
            block("b", "FUZ_MIN_INT", IN1=5, IN2="part0"),
            "`plc.part0` gives 0.5 to `IN2` of `b`, which is INT, a whole number from -32768 to 32767",
        ),
        (
            block("b", "FUZ_MIN_REAL", {"IN1": "big"}, IN2=1),
            "`big` gives 5e+38 to `IN1` of `b`, which is REAL, up to 3.40282e+38 either way",
        ),
        (
            block("b", "DEFUZ_STR", {"1": "plc.part0", "2": "plc.part1"}, S1=0, S2=1),
            "`plc.part0` gives 0.5 to `1` of `b`, which is INT, a whole number from -32768 to 32767",
        ),
        (
            block("b", "from_int", {"input": "big"}),
            "`big` gives 5e+38 to `input` of `b`, which is INT, a whole number from -32768 to 32767",
        ),
    ],
    ids=["INT", "REAL", "n of a structure", "from_int"],
)
def test_a_value_that_is_not_of_the_data_type_ends_the_run(plc, node, reason):
    big = Node(
        name="big",
        type="gain",
        inputs={"input": Wire("plc.part0")},
        parameters={"gain": parse_quantity(1e39)},
    )
    trace = run(loop(plc, big, node))
    assert trace.time.size == 0
    assert trace.fault.reason == reason
    assert trace.fault.signal == reason.split("`")[1]


def test_a_block_that_is_not_enabled_refuses_nothing(plc):
    off = Node(
        name="off", type="gain", inputs={"input": Wire("plc.flag")}, parameters={"gain": parse_quantity(0)}
    )
    given = {"EN": "off", "IN2": "plc.part0"}
    trace = run(loop(plc, off, block("b", "FUZ_MIN_INT", given, IN1=5)))
    assert trace.fault is None
    assert set(trace["b.OUT"]) == {0.0}


SLIPS = [
    (
        block("b", "FUZ_ATERM_INT", X="int0", S1=1, S2=2, S4=4),
        "`S4` is in use and `S3` is not",
        "write S3 = 0",
    ),
    (block("b", "FUZ_MIN_INT", IN1="int0", IN2=0.5), "`IN2` cannot be 0.5", "it is INT, a whole number"),
    (block("b", "FUZ_ATERM_INT", X="int0", S1=1, S2=40_000), "`S2` cannot be 40000", "it is INT"),
    (
        block("b", "FUZ_MIN_REAL", IN1="int0", IN2=1e39),
        "`IN2` cannot be 1e+39",
        "it is REAL, up to 3.40282e+38",
    ),
    (
        block("b", "DEFUZ_STI", {str(i): "plc.int0" for i in range(1, 12)}, S1=1, S2=2),
        "`MD` has 11 members, and the structure has 10",
        "n, then term1 to term9",
    ),
    (
        block("b", "FUZ_ATERM_INT", X="length", S1=1, S2=2),
        "`X` of `b` is in 1, and `plc.length` is in m",
        "different",
    ),
    (block("b", "FUZ_ATERM_REAL", X="length", S1=1, S2=2), "`S1` of `b`: 1 does not convert to m", "a point"),
    (block("b", "FUZ_ATERM_INT", X="int0", S1=1), "`b` needs its parameter `S2`: a point", ""),
]


@pytest.mark.parametrize(("node", "message", "hint"), SLIPS, ids=[each[1] for each in SLIPS])
def test_what_does_not_fit_is_refused_before_the_run(plc, node, message, hint):
    with pytest.raises(InputFault) as caught:
        wire(loop(plc, node))
    assert message in str(caught.value)
    assert hint in str(caught.value)


def test_a_value_and_its_places_may_have_a_unit_in_real(plc):
    term = block("term", "FUZ_STERM_REAL", X="length")
    points = {"S1": parse_quantity("0 m"), "S2": parse_quantity("200 cm")}
    term = Node(name="term", type=term.type, inputs=term.inputs, parameters=points)
    places = {
        "MDiSi2": parse_quantity("1 kW"),
        "MDiSi3": parse_quantity(0.5),
        "MDiSi4": parse_quantity("3000 W"),
    }
    mean = Node(name="mean", type="DEFUZ_REAL", inputs={"MDiSi1": Wire("term.MD")}, parameters=places)
    trace = run(loop(plc, term, mean))
    assert trace.units["mean.Y"] == "kW"
    degree = np.clip(trace["plc.length"] / 2.0, 0.0, 1.0)
    assert trace["term.MD"] == pytest.approx(degree, abs=1e-7)
    assert trace["mean.Y"] == pytest.approx((degree + 1.5) / (degree + 0.5), abs=1e-6)


def test_counts_hold_a_quantity_to_half_a_step_and_report_where_they_cannot(plc):
    step, offset = parse_quantity("0.2 mm"), parse_quantity("1 m")
    parameters = {"step": step, "offset": offset}
    counted = Node(name="counted", type="to_int", inputs={"input": Wire("plc.length")}, parameters=parameters)
    back = Node(name="back", type="from_int", inputs={"input": Wire("counted.OUT")}, parameters=parameters)
    trace = run(loop(plc, counted, back, seconds=12.0))
    length, fits = trace["plc.length"], trace["counted.overflow"] == 0.0
    assert trace.units["back"] == "mm"
    assert np.array_equal(fits, np.rint((length - 1.0) / 2e-4) <= 32_767)
    assert 0 < np.count_nonzero(~fits) < fits.size
    assert set(trace["counted.OUT"][~fits]) == {32_767.0}
    assert np.all(trace["counted.OUT"] == np.floor(trace["counted.OUT"]))
    assert np.abs(trace["back"][fits] - 1e3 * length[fits]).max() <= 0.1 + 1e-9


def test_every_pin_that_stretching_adds_is_optional_beyond_the_manuals_least():
    for kind in concept.TABLE:
        needed = [each.name for each in BLOCKS[kind.name].parameters if each.default is None]
        assert needed == [
            each for each in kind.inputs(kind.least) if each == "X" or each.startswith(kind.stem)
        ]
