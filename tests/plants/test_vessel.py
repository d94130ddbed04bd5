"""The receiver of compressed air against closed forms, and under figure 7 against its equations' roots."""

import numpy as np
import pytest
from scipy.optimize import fsolve

import fcl_sim
from fcl_sim import testbench
from fcl_sim.loop.diagram import Diagram, Node, PlantNode, Wire
from fcl_sim.loop.run import run
from fcl_sim.plant.catalog import find, shipped_bench
from fcl_sim.scenario.reader import read
from fcl_sim.units import parse_quantity
from tests.loop.diagrams import timing

FOLDER = shipped_bench() / "scenarios" / "vessel"
R, CP = 287.05, 1005.0
CV = CP - R
SEGMENTS = (
    (1.0, 12.0, "VE-1", "VE-2"),
    (2.0, 12.0, "VE-3", "VE-4"),
    (0.3, 12.0, "VE-5", "VE-6"),
    (0.3, 25.0, "VE-7", "VE-8"),
)


def alone(parameters: dict[str, float], *, valve: float, demand: float, seconds: float) -> Diagram:
    sources = {"valve": f"{valve} %", "demand": demand, "surroundings": "12 degC"}
    nodes = [
        Node(name=name, type="constant", parameters={"value": parse_quantity(value)})
        for name, value in sources.items()
    ]
    plant = PlantNode(
        name="vessel",
        model=find("vessel"),
        parameters=parameters,
        start={"pressure": 0.0, "temperature": 5.0},
        inputs={name: Wire(name) for name in sources},
    )
    return Diagram(plant=plant, nodes=tuple(nodes), timing=timing(1.0, seconds))


def test_an_insulated_vessel_fills_to_the_temperature_of_the_first_law():
    trace = run(alone({"wall": 0.0}, valve=20.0, demand=0.0, seconds=300.0))
    mass, kelvin = trace["vessel.mass"], trace["vessel.gas_temperature"] + 273.15
    entered = CP / CV * (40.0 + 273.15) * (mass - mass[0])
    assert mass[-1] > 1.5 * mass[0]
    assert np.abs(kelvin * mass / (mass[0] * kelvin[0] + entered) - 1.0).max() <= 1e-8


def test_a_draining_vessel_cools_as_a_reversible_adiabatic_expansion():
    diagram = alone({"wall": 0.0}, valve=-20.0, demand=0.0, seconds=200.0)
    plant = diagram.plant
    started = PlantNode(
        name=plant.name,
        model=plant.model,
        parameters=plant.parameters,
        start={"pressure": 100.0, "temperature": 20.0},
        inputs=plant.inputs,
    )
    trace = run(Diagram(plant=started, nodes=diagram.nodes, timing=diagram.timing))
    pressure = trace["vessel.gauge_pressure"] + 101.325
    kelvin = trace["vessel.gas_temperature"] + 273.15
    expected = kelvin[0] * (pressure / pressure[0]) ** (R / CP)
    assert np.abs(kelvin / expected - 1.0).max() <= 1e-8


def balance(
    opening: float, gauge: float, celsius: float, demand: float, surroundings: float
) -> tuple[float, float]:
    """What the vessel gains of mass (g/s) and of heat (kW) with the valve at `opening` per cent."""
    came = 2e-5 * max(opening, 0.0) * (150.0 - gauge)
    went = (2e-5 * max(-opening, 0.0) + 1e-4 * demand) * gauge
    heat = came * CP * (313.15 - celsius - 273.15) + 40.0 * (surroundings - celsius)
    return 1000.0 * (came - went), heat / 1000.0


@pytest.mark.parametrize(("demand", "surroundings", "pressure_id", "temperature_id"), SEGMENTS)
def test_the_bounds_of_the_scenario_lie_about_the_root_of_law_and_balance(
    demand, surroundings, pressure_id, temperature_id
):
    block = fcl_sim.load(FOLDER / "figure7.fcl")

    def unbalanced(point):
        gauge, celsius = point
        opening = block.evaluate({"temp": celsius, "pressure": gauge})["valve"].item()
        return balance(opening, gauge, celsius, demand, surroundings)

    root, _, found, _ = fsolve(unbalanced, (65.0, 18.0), full_output=True, xtol=1e-12)
    assert found == 1
    texts = {each.id: each for each in read(FOLDER / "direct.toml").requirements}
    for name, value in zip((pressure_id, temperature_id), root, strict=True):
        low, high = (
            float(str(entry.value).split()[0]) for entry in (texts[name].minimum, texts[name].maximum)
        )
        assert low < value < high
        assert (low + high) / 2 == pytest.approx(value, abs=1e-3)


def test_with_the_printed_base_points_and_weight_the_adapted_block_is_that_of_figure_7():
    random = np.random.default_rng(5)
    temp, pressure = random.uniform(-5.0, 40.0, 500), random.uniform(40.0, 120.0, 500)
    printed = fcl_sim.load(FOLDER / "figure7.fcl").evaluate({"temp": temp, "pressure": pressure})
    given = {"temp": temp, "pressure": pressure, "bp_warm1": 3.0, "bp_warm2": 27.0, "w_myrule1": 1.0}
    adapted = fcl_sim.load(FOLDER / "adapted.fcl").evaluate(given)
    assert np.array_equal(adapted["valve"], printed["valve"])


def test_the_adapted_weight_comes_to_the_one_with_which_the_wanted_pressure_is_at_rest():
    trace = testbench.run(FOLDER / "adapted.toml").trace
    block = fcl_sim.load(FOLDER / "adapted.fcl")
    for end, demand, surroundings in (
        (3600, 1.0, 12.0),
        (7200, 2.0, 12.0),
        (10800, 0.3, 12.0),
        (18000, 1.5, 25.0),
    ):

        def unbalanced(point, demand=demand, surroundings=surroundings):
            weight, celsius = point
            feet = {"bp_warm1": surroundings - 9.0, "bp_warm2": surroundings + 15.0}
            given = {"temp": celsius, "pressure": 64.0, **feet, "w_myrule1": weight}
            opening = block.evaluate(given)["valve"].item()
            return balance(opening, 64.0, celsius, demand, surroundings)

        root, _, found, _ = fsolve(unbalanced, (0.5, surroundings + 3.0), full_output=True, xtol=1e-12)
        assert found == 1
        assert trace["controller.weight"][end] == pytest.approx(root[0], abs=2e-3)
        assert trace["vessel.gas_temperature"][end] == pytest.approx(root[1], abs=0.01)
