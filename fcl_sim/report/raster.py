"""Numbers on a grid → a picture of coloured cells, and lines of equal height."""

import struct
import zlib
from collections.abc import Sequence
from functools import cache

import numpy as np
from contourpy import contour_generator
from numpy.typing import NDArray

from fcl_sim.loop.trace import Values
from fcl_sim.report import style

SHADES = 255
"""Colours of a map; one index is kept for the paper."""
NONE = SHADES

FLAT = 1e-9
"""What lies this near to a level, as a part of the values, lies on it: a plateau is no finer computed."""

Stops = tuple[str, ...]
"""Colours of a scale at even distances, from its foot to its top."""


def cells(
    x: Values,
    y: Values,
    values: Values,
    range_: tuple[float, float],
    size: tuple[int, int],
    stops: Stops = style.HEAT,
) -> bytes:
    """Return cells (m, n) between the edges `x` (n + 1,) and `y` (m + 1,) as a PNG of `size` pixels.

    The lowest row of values is that at the foot of the picture. What is not
    finite has that of the paper.
    """
    rows, columns = (_at(edges, count) for edges, count in ((y, size[1]), (x, size[0])))
    low, high = range_
    with np.errstate(invalid="ignore"):
        share = np.clip((values - low) / (high - low), 0.0, 1.0)
    shades = np.where(np.isfinite(values), np.nan_to_num(share) * (SHADES - 1) + 0.5, NONE).astype(np.uint8)
    return _png(shades[rows[::-1, None], columns[None, :]], stops)


def scale(size: tuple[int, int], stops: Stops = style.HEAT) -> bytes:
    """Return all colours from the foot to the top, as a PNG of `size` pixels."""
    steps = np.linspace(0.0, SHADES - 1.0, size[1]).round().astype(np.uint8)
    return _png(np.repeat(steps[::-1, None], size[0], axis=1), stops)


def contours(x: Values, y: Values, values: Values, levels: Sequence[float]) -> list[Values]:
    """Return the lines (k, 2) on which values (m, n) at `x` (n,) and `y` (m,) have one of the levels.

    There are none through places that are not finite, and none at the least and
    the largest value: a plateau at a level has a line where the surface rises from it.
    """
    finite = values[np.isfinite(values)]
    if not len(finite):
        return []
    low, high = float(finite.min()), float(finite.max())
    flat = FLAT * max(high - low, abs(low), abs(high))
    lines: list[Values] = []
    for level in levels:
        if low + flat < level < high - flat:
            even = np.where(np.abs(values - level) <= flat, level, values)
            made = contour_generator(x, y, np.ma.masked_invalid(even), name="serial")
            lines += [np.asarray(line, dtype=np.float64) for line in made.lines(level)]
    return lines


def shade(part: float) -> str:
    """Return the colour of a map at a part of its range, from 0 to 1."""
    at = 3 * round(min(max(part, 0.0), 1.0) * (SHADES - 1))
    return f"#{_palette(style.HEAT)[at : at + 3].hex()}"


def _at(edges: Values, count: int) -> NDArray[np.intp]:
    """Return in which cell the middle of each of `count` pixels lies."""
    middles = edges[0] + (np.arange(count) + 0.5) * ((edges[-1] - edges[0]) / count)
    found: NDArray[np.intp] = np.searchsorted(edges, middles, side="right") - 1
    return np.clip(found, 0, len(edges) - 2)


@cache
def _palette(stops: Stops) -> bytes:
    """Return the colours of a map and that of the paper, three bytes each."""
    colours = np.array([[int(each[at : at + 2], 16) for at in (1, 3, 5)] for each in stops], dtype=float)
    places = np.linspace(0.0, len(colours) - 1.0, SHADES)
    shades = [np.interp(places, np.arange(len(colours)), channel) for channel in colours.T]
    return np.stack(shades, axis=1).round().astype(np.uint8).tobytes() + bytes.fromhex(style.PAPER[1:])


def _png(pixels: NDArray[np.uint8], stops: Stops) -> bytes:
    """Return indices of colours (rows, columns), the uppermost row first, as PNG."""
    height, width = pixels.shape
    header = struct.pack(">IIBBBBB", width, height, 8, 3, 0, 0, 0)
    lines = np.concatenate([np.zeros((height, 1), np.uint8), pixels], axis=1).tobytes()
    parts = [(b"IHDR", header), (b"PLTE", _palette(stops)), (b"IDAT", zlib.compress(lines, 6))]
    return b"\x89PNG\r\n\x1a\n" + b"".join(_chunk(*each) for each in (*parts, (b"IEND", b"")))


def _chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
