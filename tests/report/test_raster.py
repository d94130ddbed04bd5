"""Maps as pixels and lines: every cell in its place and colour, paper where there is no number."""

import io

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from matplotlib.image import imread

from fcl_sim.report import raster
from fcl_sim.report.style import HEAT, PAPER


def pixels(png: bytes) -> np.ndarray:
    """Return red, green and blue (rows, columns, 3) of 0 to 255."""
    return np.round(imread(io.BytesIO(png))[..., :3] * 255.0).astype(int)


def rgb(colour: str) -> list[int]:
    return [int(colour[at : at + 2], 16) for at in (1, 3, 5)]


def test_the_lowest_row_of_values_is_at_the_foot_and_each_cell_has_its_width():
    shown = pixels(
        raster.cells(np.array([0.0, 1.0, 4.0]), np.array([0.0, 1.0, 2.0]), EDGES, (0.0, 1.0), (8, 4))
    )
    assert shown[-1, 0].tolist() == rgb(HEAT[0])
    assert shown[0, 0, :3].tolist() == rgb(HEAT[-1])
    assert [tuple(each) for each in shown[-1]].count(tuple(rgb(HEAT[0]))) == 2


EDGES = np.array([[0.0, 1.0], [1.0, 0.0]])


def test_what_is_no_number_has_the_colour_of_the_paper():
    shown = pixels(
        raster.cells(
            np.arange(3.0), np.arange(3.0), np.array([[np.nan, 1.0], [0.0, np.inf]]), (0.0, 1.0), (4, 4)
        )
    )
    assert shown[-1, 0].tolist() == shown[0, -1].tolist() == rgb(PAPER)
    assert rgb(PAPER) not in (shown[0, 0].tolist(), shown[-1, -1].tolist())


@given(arrays(np.float64, (3, 4), elements=st.floats(-1e6, 1e6)))
def test_a_larger_value_is_never_darker(values):
    shown = pixels(raster.cells(np.arange(5.0), np.arange(4.0), values, (-1e6, 1e6), (4, 3)))
    grey = shown[::-1].sum(axis=2).ravel()[np.argsort(values, axis=None)]
    assert (np.diff(grey) >= 0).all()


def test_the_scale_has_every_colour_from_the_foot_to_the_top():
    shown = pixels(raster.scale((1, raster.SHADES)))[::-1, 0]
    assert shown[0].tolist() == rgb(HEAT[0])
    assert shown[-1].tolist() == rgb(HEAT[-1])
    assert (np.diff(shown.sum(axis=1)) >= 0).all()


@given(st.floats(0.1, 0.9))
def test_a_line_of_equal_height_lies_where_the_plane_has_it(level):
    x, y = np.linspace(0.0, 1.0, 5), np.linspace(0.0, 2.0, 7)
    (line,) = raster.contours(x, y, np.broadcast_to(x, (7, 5)), [level])
    assert line[:, 0] == pytest.approx(level)
    assert sorted(line[[0, -1], 1]) == [0.0, 2.0]


def test_there_is_no_line_through_what_is_no_number():
    values = np.array([[0.0, np.nan, 0.0], [1.0, np.nan, 1.0]])
    assert raster.contours(np.arange(3.0), np.arange(2.0), values, [0.5]) == []


@pytest.mark.parametrize("plateau", [-1.0, 0.0, 1.0])
def test_rounding_on_a_plateau_draws_no_lines_on_it(plateau):
    x, y = np.linspace(-2.0, 2.0, 41), np.linspace(0.0, 1.0, 21)
    noise = np.random.default_rng(1).uniform(-1e-15, 1e-15, (21, 41))
    ramp = np.clip(np.broadcast_to(x, (21, 41)), -1.0, 1.0)
    values = np.where(np.abs(x) < 0.5, 0.0, ramp) + noise
    inside = {-1.0: x < -1.0, 0.0: np.abs(x) < 0.5, 1.0: x > 1.0}[plateau]
    lines = raster.contours(x, y, values, [-1.0, -0.75, 0.0, 0.75, 1.0])
    assert len(lines) == 3
    for line in lines:
        assert np.ptp(line[:, 0]) == pytest.approx(0.0, abs=1e-9)
        assert not np.interp(line[:, 0], x, inside.astype(float)).any() or plateau == 0.0
