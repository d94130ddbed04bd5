"""What numba refuses of a plant's code is told in terms of the plant's file."""

import pytest

from fcl_sim.jit import compiled
from fcl_sim.plant.catalog import load
from fcl_sim.plant.places import PlantFile
from fcl_sim.plant.uncompiled import uncompiled
from tests.plant.tanks import refusal, written

compiling = pytest.mark.skipif(not compiled(), reason="NUMBA_DISABLE_JIT: nothing is compiled")


def compile_all(path):
    load(path).functions.ready()


@compiling
def test_a_function_that_is_not_decorated_is_named_where_it_is_called(tmp_path):
    assert refusal(tmp_path, ("@kernel\n", ""), use=compile_all) == (
        "plants/tank.py:17:13: error[PLT302]: "
        "`dynamics` cannot be compiled: `rate` is called and is not decorated with @kernel\n"
        "  17 |     dx[0] = rate(x[1], p[0])\n"
        "     |             ^^^^^^^^^^^^^^^^\n"
        "  hint: write @kernel on a line of its own before `def rate`; it is imported from fcl_sim.plant"
    )


@compiling
@pytest.mark.parametrize(
    ("line", "told"),
    [
        ('print(f"{x[0]:.2f}")', "format spec in f-strings not supported yet"),
        ("import math", "Use of unsupported opcode (IMPORT_NAME) found"),
        ("y[0] = x.size.level if t < 0.0 else 0.0", "Unknown attribute 'level' of type int64"),
    ],
)
def test_what_numba_refuses_is_shown_at_its_line(tmp_path, line, told):
    assert refusal(tmp_path, ("    y[0] = x[0]\n", f"    y[0] = x[0]\n    {line}\n"), use=compile_all) == (
        f"plants/tank.py:24:5: error[PLT302]: `outputs` cannot be compiled: {told}\n"
        f"  24 |     {line}\n"
        f"     |     {'^' * len(line)}\n"
        "  hint: a plant is written in numba's subset of Python: numbers, arrays, math, loops and branches"
    )


def test_what_numba_gives_no_line_for_is_shown_at_its_function(tmp_path):
    path = written(tmp_path)
    function = load(path).functions.outputs.function
    error = ValueError("The 'with' construct is not supported.. Raised from None")
    text = str(uncompiled("outputs", function, error, PlantFile(path))).replace(str(path), "plants/tank.py")
    assert text.startswith(
        "plants/tank.py:22:1: error[PLT302]: "
        "`outputs` cannot be compiled: The 'with' construct is not supported\n"
    )
