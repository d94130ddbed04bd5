"""The block diagram of a loop: everything is in it, and nothing lies upon anything else."""

from dataclasses import replace
from functools import cache
from itertools import combinations

import pytest

from fcl_sim.loop.diagram import Wire
from fcl_sim.loop.wiring import wire
from fcl_sim.plant.catalog import shipped_bench
from fcl_sim.report import style
from fcl_sim.report.canvas import Line, Text
from fcl_sim.report.lettering import text_width
from fcl_sim.report.placed import placed
from fcl_sim.report.style import HINTED
from fcl_sim.report.vector import svg
from fcl_sim.report.wiring import LATE, alt, pictures
from fcl_sim.report.wiring_boxes import CONTINUED, GOES_ON, PAD, READ, WRITTEN
from fcl_sim.report.wiring_rows import rows
from fcl_sim.scenario.binder import bind
from fcl_sim.scenario.reader import read
from tests.loop.block_loops import node
from tests.loop.diagrams import crane, timing
from tests.report.legible import clashes, cut


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


def huge():
    """Two hundred blocks with long names: a lattice in which each reads two of the layer before."""
    loop = crane(timing=timing())
    nodes = []
    for layer in range(20):
        for place in range(10):
            name = f"a_block_with_a_long_name_{layer}_{place}"
            before = [f"a_block_with_a_long_name_{layer - 1}_{(place + each) % 10}" for each in (0, 3)]
            wires = {"one": before[0], "other": before[1]} if layer else {"seen": "crane.distance"}
            nodes.append(node(name, "sum", wires, **dict.fromkeys(wires, 1)))
    return wire(replace(loop, nodes=(*nodes, *loop.nodes)))


def wide():
    """Sixty blocks that each read the plant, and one that reads them all."""
    loop = crane(timing=timing())
    nodes = [node(f"seen_{number}", "gain", {"input": "crane.angle"}, gain=2) for number in range(60)]
    wires = {each.name: each.name for each in nodes[:30]}
    nodes.append(node("all", "sum", wires, **dict.fromkeys(wires, 1)))
    return wire(replace(loop, nodes=(*nodes, *loop.nodes)))


MADE = [small, large, delayed, huge, wide]


@cache
def shipped():
    """Return the wiring of every shipped scenario, by its name."""
    files = [
        each
        for each in sorted((shipped_bench() / "scenarios").glob("*/*.toml"))
        if not each.name.endswith((".controller.toml", ".baseline.toml"))
    ]
    return {f"{each.parent.name}/{each.stem}": wire(bind(read(each), "base")) for each in files}


def drawings():
    """Yield every row of every wiring: those made here and the shipped ones."""
    for wiring in (*(make() for make in MADE), *shipped().values()):
        yield from rows(wiring)


def lines(drawing):
    """Yield every straight piece of a wire: signal, whether it lies, its height or place, from, to."""
    for signal, height, left, right in drawing.passing:
        yield signal, True, height, left, right
    for path in drawing.paths:
        yield path.signal, True, path.start, path.left, path.track
        yield path.signal, False, path.track, *path.span
        for each in path.ends:
            yield path.signal, True, each.height, path.track, each.right


def test_no_two_boxes_meet_and_no_wire_runs_through_one():
    for drawing in drawings():
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


def test_no_two_signals_share_a_line():
    for drawing in drawings():
        found = {}
        for piece in lines(drawing):
            found.setdefault((piece[1], round(piece[2] / 0.2)), []).append(piece)
        for (lies, at), pieces in found.items():
            for one, other in combinations([*pieces, *found.get((lies, at + 1), [])], 2):
                if one[0] != other[0] and abs(one[2] - other[2]) < 0.2:
                    assert one[4] <= other[3] or other[4] <= one[3], (one, other)


@pytest.mark.parametrize("make", MADE)
def test_every_block_stands_once_behind_its_sources_and_every_wire_arrives(make):
    wiring = make()
    boxes = [box for row in rows(wiring) for box in row.boxes]
    titles = [box.title for box in boxes if box.kind not in {READ, WRITTEN, CONTINUED}]
    expected = [f"{number}  {each.name}" for number, each in enumerate(wiring.order, start=1)]
    assert sorted(titles) == sorted(expected)
    for row in rows(wiring):
        sources = {port.signal: box for box in row.boxes for port in box.exits}
        for box in row.boxes:
            for index, port in enumerate(box.entries):
                if port.signal:
                    source = sources[port.signal]
                    assert source.left + source.width < box.left
                    (end,) = [
                        end
                        for path in row.paths
                        for end in path.ends
                        if (path.signal, end.height, end.right) == (port.signal, box.entry(index), box.left)
                    ]
                    assert end.enters


@pytest.mark.parametrize("make", MADE)
def test_what_is_read_in_a_row_below_is_marked_and_enters_it_by_its_name(make):
    above = set()
    for row in rows(make()):
        first, *rest = row.boxes
        entered = {each.signal for each in first.exits} if first.kind == CONTINUED else set()
        assert entered <= above
        assert {each.signal for box in rest for each in box.entries if each.signal} >= entered
        above |= {each.signal for box in row.boxes for each in box.exits if each.text.endswith(GOES_ON)}


def test_texts_have_room_in_their_boxes():
    for drawing in drawings():
        for box in drawing.boxes:
            assert text_width(box.title) * HINTED <= box.width - 2 * PAD + 1e-9
            for left, right in zip(box.entries, box.exits, strict=False):
                both = text_width(left.text, style.SMALL) + text_width(right.text, style.SMALL)
                assert both * HINTED <= box.width - 2 * PAD
            assert box.left >= 0
            assert box.left + box.width <= drawing.width
            assert box.bottom <= drawing.height


@pytest.mark.parametrize("make", MADE)
def test_no_letters_of_a_wiring_are_too_small_on_paper(make):
    for picture in pictures(make(), "A crane"):
        assert smallest(picture) >= style.LEAST


def test_no_letters_of_the_shipped_wirings_are_too_small_on_paper():
    assert len(shipped()) > 20
    for name, wiring in shipped().items():
        for picture in pictures(wiring, name):
            assert smallest(picture) >= style.LEAST, name
            assert clashes(picture.draw()) == []
            assert cut(picture.draw()) == []


def smallest(picture):
    """Return the points of the smallest letters of a picture on paper."""
    figure = picture.draw()
    assert picture.size == (figure.width, figure.height)
    shrunk = placed(picture, "", lambda *_: "file")["width"] / figure.width
    return shrunk * min(each.size for axes in figure.axes for each in axes.of(Text))


def test_signals_are_told_with_their_units_signs_and_the_last_scan():
    written = written_out(large())
    for text in ("crane", "read", "written", "power [kW]", "[m]", "unit_delay"):
        assert f">{text}<" in written
    assert all(text in alt(large()) for text in ("−input of back", "input ← last back"))
    assert ">written 10 ms later<" in written_out(small())


def test_the_same_wiring_gives_the_same_bytes():
    assert written_out(large()) == written_out(large())


def written_out(wiring):
    return "".join(svg(each.draw()).decode() for each in pictures(wiring, "A crane"))


def test_the_alternative_text_tells_every_block_in_order_with_what_it_reads_and_gives():
    told = alt(small())
    assert told.startswith("Block diagram. crane (read) gives distance [m], angle [deg]")
    assert "1 controller.speed (differentiator) reads −input of crane.distance and gives [m/s]; 2 con" in told
    assert told.endswith("crane (written 10 ms later) reads power of controller.rules.power.")
    (picture,) = pictures(small(), "A crane")
    assert picture.caption.startswith("A crane: blocks in the order")


def test_what_is_read_of_the_last_scan_comes_from_the_plant_by_a_dashed_wire():
    (drawing,) = rows(delayed())
    ports = [port for box in drawing.boxes for port in box.entries if port.late]
    assert [(port.text, port.signal) for port in ports] == [
        ("input (last)", "crane.distance"),
        ("−input (last)", "crane.angle"),
    ]
    assert drawing.late == {"crane.distance"}
    (picture,) = pictures(delayed(), "")
    assert len([each for each in picture.draw().axes[0].of(Line) if each.dashes == LATE]) == 4


def test_a_constant_stands_with_its_value_where_it_is_read():
    loop = crane(timing=timing())
    nodes = (
        node("calm", "constant", value="12.5 kW"),
        node("both", "sum", {"calm": "calm", "rest": "calm"}, calm=1, rest=1),
    )
    (drawing,) = rows(wire(replace(loop, nodes=(*nodes, *loop.nodes))))
    (box,) = [each for each in drawing.boxes if each.title.endswith("both")]
    value = "12.5\N{NO-BREAK SPACE}kW"
    assert [port.text for port in box.entries] == [f"calm = {value}", f"rest ← calm = {value}"]
    assert not any("calm" in each.title for each in drawing.boxes)
    widest = max(text_width(port.text, style.SMALL) for port in box.entries)
    assert box.width > HINTED * widest + 2 * PAD


def test_a_sheet_says_which_it_is_and_the_first_one_tells_what_stands_on_all():
    first, *others, last = pictures(large(), "A crane")
    count = 2 + len(others)
    assert first.caption.startswith(f"A crane, sheet 1 of {count}: blocks in the order of their execution")
    assert "A signal with ↓ is read in a row below" in first.caption
    assert last.caption == f"A crane, sheet {count} of {count}: the rows below those of the sheet before."
    assert (first.name, last.name) == ("wiring-1", f"wiring-{count}")
    assert first.alt == alt(large())
