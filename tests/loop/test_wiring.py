"""What does not fit together is refused, by name and with what would be right."""

from dataclasses import replace

import pytest

from fcl_sim.diagnostics import InputFault
from fcl_sim.loop.blocks.setting import Text
from fcl_sim.loop.diagram import Node, Wire
from fcl_sim.loop.wiring import wire
from fcl_sim.units import parse_quantity
from tests.loop.diagrams import crane, timing


@pytest.fixture
def diagram():
    return crane(timing=timing())


def with_node(diagram, name, **changes):
    nodes = tuple(replace(node, **changes) if node.name == name else node for node in diagram.nodes)
    return replace(diagram, nodes=nodes)


def refusal(diagram):
    with pytest.raises(InputFault) as caught:
        wire(diagram)
    return str(caught.value)


def test_the_crane_fits_together_in_the_order_of_its_signals(diagram):
    shuffled = replace(diagram, nodes=diagram.nodes[::-1])
    wiring = wire(shuffled)
    assert [node.name for node in wiring.order] == [
        "controller.speed",
        "controller.predicted",
        "controller.rules",
    ]
    assert wiring.units["controller.speed"].symbol == "m/s"
    assert wiring.units["controller.rules.power"].symbol == "kW"


def test_an_unknown_signal_is_refused_with_who_reads_it_the_nearest_name_and_what_there_is(diagram):
    inputs = {"distance": Wire("controler.predicted"), "angle": Wire("crane.angle")}
    assert refusal(with_node(diagram, "controller.rules", inputs=inputs)) == (
        "error[WIR102]: there is no signal called `controler.predicted`, "
        "which `distance` of `controller.rules` reads\n"
        "  hint: did you mean `controller.predicted`? there are controller.predicted, "
        "controller.rules.power, controller.speed, "
        "crane.angle, crane.distance, crane.force, crane.position, crane.power … (3 more)"
    )


def test_a_signal_that_two_drive_is_refused_with_both(diagram):
    twin = replace(diagram.nodes[0], name="crane.angle")
    assert "there are two signals called `crane.angle`: of the plant `crane` and of `crane.angle`" in refusal(
        replace(diagram, nodes=(*diagram.nodes, twin))
    )
    aliases = {"controller.speed": Wire("crane.speed")}
    assert (
        "there are two signals called `controller.speed`: "
        "of the connection from `crane.speed` and of `controller.speed`"
    ) in refusal(replace(diagram, aliases=aliases))


def test_an_input_must_be_connected_unless_the_plant_declares_it_optional(diagram):
    plant = replace(diagram.plant, inputs={})
    told = refusal(replace(diagram, plant=plant))
    assert "the plant's input `crane.power` is not connected" in told
    assert "crane.wind" not in told


def test_an_input_left_unconnected_is_no_signal(diagram):
    assert "crane.wind" not in wire(diagram).units
    inputs = {"distance": Wire("crane.wind"), "angle": Wire("crane.angle")}
    assert "there is no signal called `crane.wind`" in refusal(
        with_node(diagram, "controller.rules", inputs=inputs)
    )
    blown = replace(diagram.plant, inputs={**diagram.plant.inputs, "wind": Wire("crane.speed")})
    assert wire(replace(diagram, plant=blown)).units["crane.wind"].symbol == "m/s"


def test_a_unit_of_another_kind_is_refused(diagram):
    inputs = {"distance": Wire("crane.angle"), "angle": Wire("crane.angle")}
    assert refusal(with_node(diagram, "controller.rules", inputs=inputs)) == (
        "error[WIR201]: `distance` of `controller.rules` is in m, and `crane.angle` is in deg\n"
        "  hint: the two are different kinds of quantity: is this the signal you mean?"
    )


def test_a_dimensioned_signal_into_a_variable_without_a_unit_is_refused(diagram):
    assert "`angle` of `controller.rules` has no unit, and `crane.angle` is in deg" in refusal(
        with_node(diagram, "controller.rules", units={"distance": "m", "power": "kW"})
    )


def test_terms_of_a_sum_that_do_not_add_up_are_refused(diagram):
    gains = {"distance": parse_quantity(1.0), "speed": parse_quantity("-6 s2")}
    text = refusal(with_node(diagram, "controller.predicted", parameters=gains))
    assert "error[WIR201]: `controller.predicted`: the terms do not add up" in text


def test_the_plant_is_given_its_own_unit(diagram):
    units = {"distance": "m", "angle": "deg", "power": "W"}
    text = refusal(with_node(diagram, "controller.rules", units=units))
    assert "`crane.power` takes kW, and `controller.rules.power` is in W" in text
    assert "put a `gain` between them that converts W to kW" in text


def test_an_input_of_the_plant_that_is_not_connected_is_refused(diagram):
    text = refusal(replace(diagram, plant=replace(diagram.plant, inputs={})))
    assert "the plant's input `crane.power` is not connected" in text


def test_a_parameter_outside_what_is_possible_is_refused(diagram):
    text = refusal(replace(diagram, plant=replace(diagram.plant, parameters={"cable_length": -1.0})))
    assert "`cable_length` of the plant `crane` is -1 m" in text
    assert "it must be at least 0.1 m" in text


def test_an_algebraic_loop_is_walked(diagram):
    first = Node(name="a", type="gain", inputs={"input": Wire("b")}, parameters={"gain": parse_quantity(1.0)})
    second = Node(
        name="b", type="gain", inputs={"input": Wire("a")}, parameters={"gain": parse_quantity(1.0)}
    )
    text = refusal(replace(diagram, nodes=(*diagram.nodes, first, second)))
    assert "these blocks wait for each other in every scan: `a` → `b` → `a`" in text


def test_every_fault_is_reported_at_once(diagram):
    broken = with_node(diagram, "controller.speed", inputs={"input": Wire("crane.distanz")})
    broken = replace(broken, plant=replace(broken.plant, parameters={"load_mas": 1.0}))
    with pytest.raises(InputFault) as caught:
        wire(broken)
    assert {each.code for each in caught.value.diagnostics} == {"WIR102", "WIR104"}


def node(name, kind, inputs=None, **parameters):
    wires = {port: Wire(source) for port, source in (inputs or {}).items()}
    given = {key: parse_quantity(each) if each != "forward" else each for key, each in parameters.items()}
    return Node(name=name, type=kind, inputs=wires, parameters=given)


def beside(diagram, *nodes):
    return replace(diagram, nodes=(*diagram.nodes, *nodes))


def test_a_block_that_reads_the_last_scan_opens_an_algebraic_loop(diagram):
    wiring = wire(
        beside(
            diagram,
            node("next", "sum", {"late": "late", "speed": "crane.speed"}, late=1.0, speed="0.05 s"),
            node("late", "unit_delay", {"input": "next"}, initial="-25 m"),
        )
    )
    names = [each.name for each in wiring.order]
    assert names.index("late") < names.index("next")
    assert wiring.units["next"].symbol == "m"


def test_units_that_follow_from_each_other_ask_for_one_of_them(diagram):
    loop = node("a", "gain", {"input": "b"}, gain=1.0), node("b", "unit_delay", {"input": "a"})
    assert refusal(beside(diagram, *loop)) == (
        "error[WIR201]: the unit of `b` depends on itself\n  hint: give `initial` of `b` with its unit"
    )
    told = (
        node("a", "gain", {"input": "b"}, gain="1 s"),
        node("b", "unit_delay", {"input": "a"}, initial="1 m"),
    )
    assert "`b` is in m s, and its own parameters say m" in refusal(beside(diagram, *told))


@pytest.mark.parametrize(
    ("block", "told"),
    [
        (
            node("x", "limiter", {"input": "crane.distance"}, low="1 s"),
            "`low` of `x`: 1 s does not convert to m\n  hint: it is lower bound; write it in m",
        ),
        (
            node("x", "limiter", {"input": "crane.distance"}, low="2 m", high="1 m"),
            "error[WIR202]: `x`: `low` lies above `high`",
        ),
        (
            node("x", "limiter", {"input": "crane.distance", "high": "crane.angle"}),
            "`high` of `x` is in m, and `crane.angle` is in deg",
        ),
        (
            node("x", "integrator", {"input": "crane.speed", "reset": "crane.angle"}),
            "`reset` of `x` is in 1, and `crane.angle` is in deg",
        ),
        (
            node("x", "integrator", {"input": "crane.speed"}, initial="2 m", high="1 m"),
            "error[WIR202]: `x`: `initial` lies beyond the limits",
        ),
        (
            node("x", "dead_band", {"input": "crane.speed"}, width="-1 m/s"),
            "`width` of `x` is -1 m/s\n  hint: it must be at least 0: half the width of the band",
        ),
        (
            Node(name="x", type="python", parameters={"file": Text("x.py", ""), "outputs": {}}),
            "`outputs` of `x` is empty\n  hint: it is names of what it returns, each with its unit",
        ),
        (node("x", "product", {"1": "crane.speed"}), "error[WIR103]: `x` has fewer than 2 inputs"),
        (node("x", "dead_band", {"input": "crane.speed"}), "`x` needs its parameter `width`"),
        (node("x", "integrator", {}), "the input `input` of `x` is not connected"),
        (node("x", "limiter", {"inpt": "crane.speed"}), "did you mean `input`?"),
        (node("x", "limiter", {"input": "crane.speed"}, lo="1 m/s"), "has no parameter called `lo`"),
    ],
)
def test_what_a_block_does_not_declare_is_refused(diagram, block, told):
    assert told in refusal(beside(diagram, block))


def test_a_number_without_a_unit_is_blamed_and_not_its_partner_that_has_one(diagram):
    assert refusal(beside(diagram, node("x", "step", before="4 m/s", after=6))) == (
        "error[WIR201]: `after` of `x` has no unit, and `before` is 4 m/s\n"
        '  hint: write it with its unit: "6 m/s"'
    )


def test_an_input_of_the_plant_without_a_signal_is_told_with_unit_and_meaning(diagram):
    loose = replace(diagram, plant=replace(diagram.plant, inputs={}))
    drive = diagram.plant.model.declaration.inputs[0]
    assert refusal(loose).startswith(
        f"error[WIR103]: the plant's input `crane.{drive.name}` is not connected\n"
        f'  hint: it is in {drive.unit}: "{drive.meaning}"'
    )


def test_limits_follow_the_unit_of_what_they_limit(diagram):
    wiring = wire(beside(diagram, node("x", "limiter", {"input": "crane.distance"}, low="-50 cm")))
    assert wiring.settings["x"].values["low"] == -0.5
    area = wire(beside(diagram, node("x", "integrator", {"input": "crane.speed"}, high="50 cm")))
    assert area.settings["x"].values["high"] == 0.5
    assert area.units["x"].symbol == "m"
