"""The block diagram of a loop: everything is in it, and nothing lies upon anything else."""

from dataclasses import replace
from itertools import combinations

import pytest

from fcl_sim.loop.diagram import Wire
from fcl_sim.loop.wiring import wire
from fcl_sim.report import style
from fcl_sim.report.canvas import Line
from fcl_sim.report.vector import svg
from fcl_sim.report.wiring import LATE, alt, draw, picture
from fcl_sim.report.wiring_layout import HINTED, PAD, READ, WRITTEN, laid_out, text_width
from tests.loop.block_loops import node
from tests.loop.diagrams import crane, timing


def small():
    return wire(crane(timing=timing(latency=10**7)))


def large():
    """Twenty-five blocks: chains, branches, a circle through the last scan, signals that go a long way."""
    loop = crane(timing=timing())
    nodes = [
        node("old", "unit_delay", {"input": "back"}, initial="0 m"),
        node("back", "sum", {"old": "old", "seen": "crane.distance"}, old=0.5, seen=1),
        node("meter", "integrator", {"input": "crane.power"}, method="forward"),
        node("gust", "noise", sigma="1 kW"),
        node("late", "fault", {"input": "-back"}, kind="delayed", delay="100 ms"),
    ]
    for number in range(12):
        source = {"input": f"chain_{number - 1}" if number else "late"}
        nodes.append(node(f"chain_{number}", "gain", source, gain=2))
    for number in range(5):
        wires = {"back": "back", f"chain_{2 * number}": f"chain_{2 * number}", "late": "late"}
        nodes.append(node(f"meeting_{number}", "sum", wires, **dict.fromkeys(wires, 1)))
    return wire(replace(loop, nodes=(*nodes, *loop.nodes)))


def delayed():
    """The plant read by a dead time, so that the controller sees it late; its angle is read both ways."""
    loop = crane(timing=timing())
    late = [
        node("measured", "dead_time", {"input": "crane.distance"}, time="3 s"),
        node("sway", "unit_delay", {"input": "-crane.angle"}, initial="0 deg"),
    ]
    rules = replace(loop.nodes[-1], inputs={**loop.nodes[-1].inputs, "distance": Wire("measured")})
    return wire(replace(loop, nodes=(*late, rules), aliases={}))


def lines(drawing):
    """Yield every straight piece of a wire: signal, whether it lies, its height or place, from, to."""
    for signal, height, left, right in drawing.passing:
        yield signal, True, height, left, right
    for path in drawing.paths:
        heights = (path.start, *path.ends)
        yield path.signal, True, path.start, path.left, path.track
        yield path.signal, False, path.track, min(heights), max(heights)
        for each in path.ends:
            entered = [
                box.left
                for box in drawing.boxes
                for index, port in enumerate(box.entries)
                if port.signal == path.signal and box.entry(index) == each and box.left >= path.right
            ]
            yield path.signal, True, each, path.track, min(entered, default=path.right)


@pytest.mark.parametrize("make", [small, large, delayed])
def test_no_two_boxes_meet_and_no_wire_runs_through_one(make):
    drawing = laid_out(make())
    for one, other in combinations(drawing.boxes, 2):
        apart = one.left + one.width <= other.left or other.left + other.width <= one.left
        assert apart or one.bottom < other.top or other.bottom < one.top
    for signal, lies, at, low, high in lines(drawing):
        for box in drawing.boxes:
            across, down = (box.left, box.left + box.width), (box.top, box.bottom)
            inside = down if lies else across
            along = across if lies else down
            through = inside[0] < at < inside[1] and low < along[1] - 1e-9 and high > along[0] + 1e-9
            assert not through, (signal, box.title)


@pytest.mark.parametrize("make", [small, large, delayed])
def test_no_two_signals_share_a_line(make):
    pieces = list(lines(laid_out(make())))
    for one, other in combinations(pieces, 2):
        if one[0] != other[0] and one[1] == other[1] and abs(one[2] - other[2]) < 0.2:
            assert one[4] <= other[3] or other[4] <= one[3], (one, other)


@pytest.mark.parametrize("make", [small, large, delayed])
def test_every_block_stands_once_behind_its_sources_and_every_wire_arrives(make):
    wiring = make()
    drawing = laid_out(wiring)
    titles = [box.title for box in drawing.boxes if box.kind not in {READ, WRITTEN}]
    assert titles == [f"{number}  {each.name}" for number, each in enumerate(wiring.order, start=1)]
    sources = {port.signal: box for box in drawing.boxes for port in box.exits}
    for box in drawing.boxes:
        for index, port in enumerate(box.entries):
            if port.signal:
                assert sources[port.signal].column < box.column
                ends = [end for path in drawing.paths if path.signal == port.signal for end in path.ends]
                assert box.entry(index) in ends


@pytest.mark.parametrize("make", [small, large, delayed])
def test_texts_have_room_in_their_boxes(make):
    drawing = laid_out(make())
    for box in drawing.boxes:
        assert text_width(box.title) * HINTED <= box.width - 2 * PAD + 1e-9
        for left, right in zip(box.entries, box.exits, strict=False):
            both = text_width(left.text, style.SMALL) + text_width(right.text, style.SMALL)
            assert both * HINTED <= box.width - 2 * PAD
        assert box.left >= 0
        assert box.left + box.width <= drawing.width
        assert box.bottom <= drawing.height


def test_signals_are_told_with_their_units_signs_and_the_last_scan():
    written = svg(draw(large())).decode()
    for text in ("crane", "read", "written", "power [kW]", "[m]", "unit_delay"):
        assert f">{text}<" in written
    assert all(text in alt(large()) for text in ("−input of back", "input ← last back"))
    assert ">written 10 ms later<" in svg(draw(small())).decode()


def test_the_same_wiring_gives_the_same_bytes():
    assert svg(draw(large())) == svg(draw(large()))


def test_the_alternative_text_tells_every_block_in_order_with_what_it_reads_and_gives():
    told = alt(small())
    assert told.startswith("Block diagram. crane (read) gives distance [m], angle [deg]")
    assert "1 controller.speed (differentiator) reads −input of crane.distance and gives [m/s]; 2 con" in told
    assert told.endswith("crane (written 10 ms later) reads power of controller.rules.power.")
    assert picture(small(), "A crane").caption.startswith("A crane: blocks in the order")


def test_what_is_read_of_the_last_scan_comes_from_the_plant_by_a_dashed_wire():
    drawing = laid_out(delayed())
    ports = [port for box in drawing.boxes for port in box.entries if port.late]
    assert [(port.text, port.signal) for port in ports] == [
        ("input (last)", "crane.distance"),
        ("−input (last)", "crane.angle"),
    ]
    assert drawing.late == {"crane.distance"}
    dashed = [
        each for each in draw(delayed()).axes[0].marks if isinstance(each, Line) and each.dashes == LATE
    ]
    assert len(dashed) == 4


def test_a_constant_stands_with_its_value_where_it_is_read():
    loop = crane(timing=timing())
    nodes = (
        node("calm", "constant", value="12.5 kW"),
        node("both", "sum", {"calm": "calm", "rest": "calm"}, calm=1, rest=1),
    )
    drawing = laid_out(wire(replace(loop, nodes=(*nodes, *loop.nodes))))
    (box,) = [each for each in drawing.boxes if each.title.endswith("both")]
    value = "12.5\N{NO-BREAK SPACE}kW"
    assert [port.text for port in box.entries] == [f"calm = {value}", f"rest ← calm = {value}"]
    assert not any("calm" in each.title for each in drawing.boxes)
    widest = max(text_width(port.text, style.SMALL) for port in box.entries)
    assert box.width > HINTED * widest + 2 * PAD
