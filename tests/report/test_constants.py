"""Every constant is told, with its unit and where it is from, and so is every setting of a block."""

from dataclasses import replace

import pytest

from fcl_sim.diagnostics import Source, Span
from fcl_sim.loop.diagram import Node, Wire
from fcl_sim.plant import State
from fcl_sim.report import document
from fcl_sim.report.constant_rows import block_rows, plant_rows
from fcl_sim.report.constants import told
from fcl_sim.scenario.model import PlantSetup
from fcl_sim.toml.tree import Entry
from fcl_sim.units import Quantity, parse_unit
from tests.report.synthetic import outcome, run

SPACE = "\N{NO-BREAK SPACE}"


@pytest.fixture
def base(tmp_path):
    return run(tmp_path).diagram


def test_a_plant_is_told_whole_with_units_meanings_sources_and_start(base):
    mass, position = plant_rows(base.plant)
    assert (mass["name"], mass["value"], mass["meaning"]) == ("load_mass", f"20{SPACE}t", "container")
    assert (mass["source"], mass["assumed"], mass["kind"]) == ("[A]", True, "parameter")
    assert (position["name"], position["value"], position["kind"]) == ("position", f"−25{SPACE}m", "start")


def test_a_value_of_the_scenario_is_no_assumption_of_the_plant(base):
    mass = plant_rows(replace(base.plant, parameters={"load_mass": 40.0}))[0]
    assert (mass["value"], mass["assumed"]) == (f"40{SPACE}t", False)
    assert mass["source"] == f"set by the scenario; by itself 20{SPACE}t, [A]"


def test_what_no_scenario_gives_is_told_all_the_same(base):
    bare = replace(base.plant, parameters={}, start={}, inputs={})
    assert [(each["name"], each["value"]) for each in plant_rows(bare)] == [
        ("load_mass", f"20{SPACE}t"),
        ("position", f"−25{SPACE}m"),
        ("power", f"0{SPACE}kW"),
    ]


def late(base):
    time = Quantity(3.0, parse_unit("s"))
    delay = Node(
        name="measured", type="dead_time", inputs={"input": Wire("crane.distance")}, parameters={"time": time}
    )
    product = Node(name="product", type="product", inputs={"1": Wire("measured")})
    return replace(base, nodes=(*base.nodes, delay, product))


def test_a_block_is_told_with_what_is_given_and_what_its_type_has(base):
    rules, delay = block_rows(late(base))
    assert rules["given"][:2] == ["function block = crane", "arithmetic = LREAL"]
    assert (delay["name"], delay["type"], delay["given"]) == ("measured", "dead_time", [f"time = 3{SPACE}s"])
    assert delay["left"] == f"between = linear, shortest = 0{SPACE}s, initial = 0"


def test_a_long_list_is_told_by_its_ends():
    assert told(tuple(float(each) for each in range(40))) == "[0, 1, … 37 more …, 39]"
    assert told((True, {"a": 1.5})) == "[true, a: 1.5]"


def test_the_document_has_them_for_every_run(tmp_path, base):
    given = replace(run(tmp_path), diagram=late(base))
    (variant,) = document([outcome(tmp_path, given)])["scenarios"][0]["variants"]
    (mass,) = variant["plant"]["constants"]
    assert (mass["value"], mass["unit"], mass["source"], mass["assumed"]) == (20.0, "t", "[A]", True)
    assert variant["plant"]["states"][0]["value"] == -25.0
    delay = variant["blocks"][1]
    assert (delay["given"], delay["wired"]) == ({"time": "3 s"}, {"input": "crane.distance"})


def setup(start):
    """Return a scenario's plant that writes its start values so."""
    place = Span(Source("x.toml", ""), 0, 0)
    entry = {name: Entry(value, place, place) for name, value in start.items()}
    model = Entry("crane", place, place)
    return PlantSetup(model=model, name="crane", parameters={}, start=entry, inputs={}, span=place)


def test_a_value_is_told_in_the_unit_in_which_the_scenario_writes_it(base):
    plant = replace(base.plant, start={"position": -7.5})
    assert plant_rows(plant, setup({"position": "-750 cm"}))[1]["value"] == f"−750{SPACE}cm"
    assert plant_rows(plant, setup({"position": "-7 m"}))[1]["value"] == f"−7.5{SPACE}m"


def test_a_computed_value_is_told_without_the_digits_of_its_machine(base):
    plant = replace(base.plant, start={"position": -1e-3 / 3.0})
    assert plant_rows(plant)[1]["value"] == f"−0.000333333333{SPACE}m"


def cells(base, values):
    """Return a plant with so many states that differ in number and value alone."""
    states = tuple(State(f"cell_{place}", "degC", value, "belt") for place, value in enumerate(values))
    model = replace(
        base.plant.model, declaration=replace(base.plant.model.declaration, states=states, parameters=())
    )
    return replace(base.plant, model=model, start={}, parameters={})


@pytest.mark.parametrize(
    ("values", "value", "meaning"),
    [
        ([30.0 + 10.0 * each for each in range(12)], "30 degC … 140 degC", "belt, 12 values in equal steps"),
        ([30.0] * 12, "30 degC", "belt, each"),
        ([30.0, 35.0, 20.0, 80.0, 31.0, 40.0], "20 degC … 80 degC", "belt, 6 values between these"),
    ],
)
def test_the_cells_of_a_belt_share_a_row(base, values, value, meaning):
    cell, *_ = plant_rows(cells(base, values))
    assert cell["name"] == f"cell_0 … cell_{len(values) - 1}"
    assert (cell["value"].replace(SPACE, " "), cell["meaning"]) == (value, meaning)


def test_a_cell_that_the_scenario_sets_stands_alone(base):
    plant = replace(cells(base, [30.0] * 20), start={"cell_9": 50.0})
    assert [each["name"] for each in plant_rows(plant)][:3] == [
        "cell_0 … cell_8",
        "cell_9",
        "cell_10 … cell_19",
    ]
