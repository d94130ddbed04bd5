"""A PNG of a picture has every row of it: no letter loses its top."""

import io
import json

import numpy as np
import pytest
from matplotlib.image import imread

from fcl_sim.report import typeset

DOT = 25.4 / typeset.PPI


def ruled(width, height) -> str:
    """Return a picture in mm with a line of half a millimetre across at every millimetre."""
    lines = "".join(f'<path d="M0 {y}.25H{width}V{y}.75H0Z" fill="#000000"/>' for y in range(int(height) - 1))
    head = f'width="{width}mm" height="{height}mm" viewBox="0 0 {width} {height}"'
    return f'<svg xmlns="http://www.w3.org/2000/svg" {head}>{lines}</svg>'


@pytest.mark.parametrize("width", [166.0, 97.3])
def test_every_line_of_a_picture_is_as_dark_as_the_others(width, tmp_path):
    heights = np.round(np.linspace(40.0, 41.3, 14), 2).tolist()
    names = [f"{number}.svg" for number in range(len(heights))]
    for name, height in zip(names, heights, strict=True):
        (tmp_path / name).write_text(ruled(width, height), encoding="utf-8")
    (tmp_path / "gallery.json").write_text(json.dumps(names), encoding="utf-8")
    for png, height in zip(typeset.pngs(tmp_path), heights, strict=True):
        drawn = imread(io.BytesIO(png))
        assert abs(drawn.shape[0] * DOT - height) < 2 * DOT
        assert abs(drawn.shape[1] * DOT - width) < 2 * DOT
        dark = 1.0 - drawn[..., 0].mean(axis=1)
        rows = (np.arange(dark.size) + 0.5) * height / dark.size
        lines = [dark[(rows > y) & (rows < y + 1)].sum() for y in range(int(height) - 1)]
        assert np.ptp(lines) < 0.5, height
