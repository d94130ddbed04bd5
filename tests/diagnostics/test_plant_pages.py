"""The examples about plants, in a plant of a tank."""

import ast

import pytest

from fcl_sim.diagnostics import InputFault
from fcl_sim.diagnostics.page import pages
from fcl_sim.plant.catalog import load

PAGES = [each for each in pages().values() if each.code.startswith("PLT") and each.language == "python"]

TANK = """\
from fcl_sim.plant import *

PLANT = Plant(
    name="tank",
    title="A tank",
    states=(State("level", "m", 1.0, "level"),),
    inputs=(Input("inflow", "m3/s", "inflow"),),
    outputs=(Output("level", "m", "level"),),
    parameters=(Parameter("area", "m2", 2.0, "area", "own figure"),),
)


def dynamics(t, x, u, p, mode, dx):
    dx[0] = u[0] / p[0]


def outputs(t, x, u, p, mode, y):
    y[0] = x[0]
"""


def named(statement):
    """Return the name that a statement of a module defines, its text where it defines none."""
    if isinstance(statement, ast.FunctionDef):
        return statement.name
    return ast.unparse(statement.targets[0] if isinstance(statement, ast.Assign) else statement)


def framed(example, replaced=()):
    """Return the tank with the definitions of an example in the place of those of the same name, or added."""
    given = ast.parse(example).body
    lost = {named(each) for each in given} | set(replaced)
    body = [each for each in ast.parse(TANK).body if named(each) not in lost]
    return ast.unparse(ast.Module([*body, *given], []))


@pytest.fixture
def codes(tmp_path):
    """Return the codes of what is wrong with the text of a plant."""

    def found(text):
        path = tmp_path / "tank.py"
        path.write_text(text, encoding="utf-8")
        try:
            load(path).functions.ready()
        except InputFault as fault:
            return {each.code for each in fault.diagnostics}
        return set()

    return found


def test_the_frame_of_the_examples_is_sound(codes):
    assert codes(TANK) == set()


@pytest.mark.parametrize("told", PAGES, ids=lambda told: told.code)
def test_a_bad_example_has_its_finding_and_no_other_and_the_mended_one_has_none(told, codes):
    mended = {named(each) for each in ast.parse(told.mended).body}
    assert codes(framed(told.bad, mended)) == {told.code}
    assert codes(framed(told.mended)) == set()
