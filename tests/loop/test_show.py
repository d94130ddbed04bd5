import re
from dataclasses import replace

from fcl_sim.loop import layout
from fcl_sim.loop.diagram import Wire
from fcl_sim.loop.show import tape_text, wiring_text
from fcl_sim.loop.tape import lower
from fcl_sim.loop.wiring import wire
from tests.loop.diagrams import crane, timing


def wiring():
    diagram = crane(timing=timing())
    return wire(replace(diagram, aliases={"controller.power": Wire("controller.rules.power", -1.0)}))


def test_a_wiring_is_shown_in_its_order_of_execution():
    assert wiring_text(wiring()).startswith(
        "blocks, in their order of execution\n"
        "  1  controller.speed <- differentiator\n"
        "       input = -crane.distance\n"
        "       filter = 0.05 s\n"
        "  2  controller.predicted <- sum\n"
        "       distance = 1 * crane.distance\n"
        "       speed = -6 s * controller.speed\n"
        "  3  controller.rules.power <- fuzzy container_crane_25\n"
        "       distance = controller.predicted\n"
        "       angle = crane.angle\n"
        "\n"
        "plant crane: Container crane, trolley with hanging load\n"
        "  power = controller.rules.power, held between writes\n"
        "  wind stays at 0 m/s\n"
        "  integrated by dormand_prince, one scan every 0.05 s\n"
        "\n"
        "signals\n"
    )


def test_every_signal_is_shown_with_its_unit_and_what_it_stands_for():
    shown = wiring_text(wiring()).partition("signals\n")[2]
    assert re.findall(r"^  (\S+) +\[", shown, re.MULTILINE) == list(wiring().units)
    assert shown.endswith("  controller.power        [kW] = -controller.rules.power")


def test_a_tape_shows_where_every_signal_and_every_row_stands():
    tape = lower(wiring())
    text = tape_text(tape)
    for name, slot in tape.slots.items():
        assert f"  m{slot:<4} {name}, recorded in column {tape.recorded.column(slot)}\n" in text
    assert "controller.predicted <- sum(crane.distance, controller.speed)" in text
    assert text.count("parameters at f") == int(tape.ints[layout.ROWS])


def test_every_word_of_the_head_is_shown_by_its_name():
    tape = lower(wiring())
    head = re.findall(r"^  i\d+ +(-?\d+) (\w+)$", tape_text(tape).partition("head\n")[2], re.MULTILINE)
    assert [name for _, name in head] == sorted(
        (name for _, name in head), key=lambda name: getattr(layout, name)
    )
    assert [int(value) for value, _ in head] == tape.ints[: layout.HEAD].tolist()
