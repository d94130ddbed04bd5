"""Sketches of the shipped plants: their state is where it belongs, in sight, and legible."""

import runpy
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fcl_sim.report import style
from fcl_sim.report.canvas import Shape
from fcl_sim.report.plant_sketches import PLANTS, sketches_of
from fcl_sim.report.sketch import Delayed, Group, Motion, Paint, Piece, Sketch, Tint
from fcl_sim.report.stills import draw, placed, signals_of
from tests.report.legible import clashes, cut
from tests.report.synthetic import run, trace

BENCH = Path(__file__).parents[2]


def of_plant(folder, name, value=88.88):
    """Return a run of a shipped plant all of whose signals stand at a value, the first one rising to it."""
    made = run(folder)
    declared = runpy.run_path(str(BENCH / "plants" / f"{name}.py"))["PLANT"]
    ends = [*declared.outputs, *declared.inputs]
    names = tuple(f"{name}.{each.name}" for each in ends)
    values = np.full((len(made.trace.ticks), len(names)), value)
    values[:, 0] = np.linspace(0.0, value, len(values))
    units = dict(zip(names, [each.unit for each in ends], strict=True))
    model = replace(made.diagram.plant.model, declaration=declared)
    node = replace(made.diagram.plant, name=name, model=model, parameters={})
    return replace(
        made,
        diagram=replace(made.diagram, plant=node),
        trace=replace(made.trace, names=names, units=units, values=values, fuzzy={}),
    )


@pytest.mark.parametrize("name", PLANTS)
def test_every_reading_of_a_still_is_in_sight_and_meets_no_other(tmp_path, name):
    made = of_plant(tmp_path, name)
    (sketch,) = sketches_of([made])
    figure = draw(sketch, made.trace, [0, 24, 48, 72, 96, 120])
    assert cut(figure) == []
    assert clashes(figure) == []


@pytest.mark.parametrize("name", PLANTS)
def test_every_piece_stays_in_what_is_shown(tmp_path, name):
    made = of_plant(tmp_path, name, 0.7)
    (sketch,) = sketches_of([made])
    points = [
        each
        for piece, points in placed(sketch.group, made.trace, 120)
        if piece.role not in {"ground", "mark"}
        for each in points
    ]
    low, high = np.min(points, axis=0), np.max(points, axis=0)
    assert (low >= np.array(sketch.low) - 1e-9).all()
    assert (high <= np.array(sketch.high) + 1e-9).all()


@pytest.mark.parametrize("name", ["bath", "exchanger", "oven", "vessel"])
def test_temperatures_are_told_in_numbers_beside_their_colour(tmp_path, name):
    (sketch,) = sketches_of([of_plant(tmp_path, name)])
    tints = {part.colour.value.signals[0] for part in pieces(sketch.group) if isinstance(part.colour, Tint)}
    assert tints
    assert tints <= {each.signal for each in sketch.readings}
    assert set(signals_of(sketch)) <= set(of_plant(tmp_path, name).trace.names)


def pieces(group):
    for part in group.parts:
        if isinstance(part, Group):
            yield from pieces(part)
        else:
            yield part


def still(colour, values):
    """Return what a still fills a square of a colour with when its signals stand at values."""
    names = ("p.a", "p.b", "p.c", "p.d")
    found = trace(names=names)
    numbers = np.broadcast_to(np.array(values, dtype=float), found.values.shape)
    square = Piece(((0.0, 0.0), (1.0, 0.0), (1.0, 1.0)), "fluid", colour=colour)
    sketch = Sketch(group=Group(parts=(square,)), low=(0.0, 0.0), high=(1.0, 1.0), about="A square.")
    (axes,) = draw(sketch, replace(found, values=numbers), [0]).axes
    (shape,) = axes.of(Shape)
    return shape.face


def grey(face):
    red, green, blue = (int(face[at : at + 2], 16) for at in (1, 3, 5))
    return 0.299 * red + 0.587 * green + 0.114 * blue


def test_what_is_warmer_is_darker_in_grey_too():
    shades = [still(Tint(Motion("p.a"), 20.0, 100.0), [each] * 4) for each in (0.0, 20.0, 60.0, 100.0, 200.0)]
    assert shades[0] == shades[1] == style.WARMTH[0]
    assert shades[3] == shades[4] == style.WARMTH[-1]
    assert grey(shades[1]) > grey(shades[2]) > grey(shades[3])


def test_a_painted_piece_has_the_colour_of_its_signals():
    paint = Paint(Motion("p.a"), Motion("p.b"), Motion("p.c"))
    assert still(paint, [182.0, 142.6, 104.5, 0.0]) == "#b68f68"
    assert still(paint, [300.0, -5.0, 0.0, 0.0]) == "#ff0000"
    assert still(paint, [float("nan")] * 4) == style.PAPER


@given(st.floats(0.1, 5.0), st.floats(0.0, 20.0), st.integers(0, 120))
def test_a_plug_flow_gives_what_entered_it_when_its_mass_had_not_gone_by(flow, mass, sample):
    found = trace(names=("p.entering", "p.flow", "p.c", "p.d"))
    time = found.time
    values = np.column_stack([np.sqrt(time), np.full_like(time, flow), time, time])
    then = max(time[sample] - mass / flow, 0.0)
    told = Delayed("p.entering", "p.flow", mass).at(replace(found, values=values), sample)
    assert told == pytest.approx(np.interp(then, time, np.sqrt(time)), abs=1e-9)
