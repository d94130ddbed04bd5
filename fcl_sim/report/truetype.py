"""A TrueType font → which letters it has, and how wide each is, without a library that draws.

After the tables `cmap`, `hhea` and `hmtx` of the OpenType specification 1.9.
"""

import struct
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

UNICODE = {(3, 10): 12, (3, 1): 4}
"""Platform and encoding of the maps that are read, the wider one first, and the format each has."""

Numbers = NDArray[np.int64]


@dataclass(frozen=True, slots=True)
class Font:
    """The glyph of each letter, by code point, and how wide each glyph (n,) is in units of the font."""

    glyphs: Mapping[int, int]
    advances: Numbers

    def advance(self, letter: str) -> int:
        """Return the width of a letter; of one that the font lacks that of glyph 0, a box."""
        return int(self.advances[self.glyphs.get(ord(letter), 0)])


def read(file: Path) -> Font:
    """Return what a font file says; ValueError where it has no map of Unicode."""
    data = file.read_bytes()
    tables = {tag: data[start : start + length] for tag, start, length in _directory(data)}
    (measured,) = struct.unpack_from(">H", tables[b"hhea"], 34)
    (count,) = struct.unpack_from(">H", tables[b"maxp"], 4)
    widths = np.frombuffer(tables[b"hmtx"], ">u2", 2 * measured)[::2].astype(np.int64)
    rest = np.full(count - measured, widths[-1])  # the others are as wide as the last that is measured
    return Font(dict(_glyphs(tables[b"cmap"])), np.concatenate([widths, rest]))


def _directory(data: bytes) -> Iterator[tuple[bytes, int, int]]:
    (count,) = struct.unpack_from(">H", data, 4)
    for number in range(count):
        tag, _, start, length = struct.unpack_from(">4sIII", data, 12 + 16 * number)
        yield tag, start, length


def _glyphs(table: bytes) -> Iterator[tuple[int, int]]:
    """Yield code points with their glyphs, of the widest map of Unicode there is."""
    (count,) = struct.unpack_from(">H", table, 2)
    rows = [struct.unpack_from(">HHI", table, 4 + 8 * number) for number in range(count)]
    starts = {(platform, encoding): start for platform, encoding, start in rows}
    for kind, form in UNICODE.items():
        if kind in starts and struct.unpack_from(">H", table, starts[kind]) == (form,):
            part = table[starts[kind] :]
            return _by_groups(part) if form == 12 else _by_segments(part)
    raise ValueError("the font has no map of Unicode")


def _by_groups(part: bytes) -> Iterator[tuple[int, int]]:
    """Yield what format 12 has: groups of code points in a row with glyphs in a row."""
    (count,) = struct.unpack_from(">I", part, 12)
    for number in range(count):
        first, last, glyph = struct.unpack_from(">III", part, 16 + 12 * number)
        yield from zip(range(first, last + 1), range(glyph, glyph + last - first + 1), strict=True)


def _by_segments(part: bytes) -> Iterator[tuple[int, int]]:
    """Yield what format 4 has: segments with a distance from letter to glyph, or with a list of glyphs."""
    count = struct.unpack_from(">H", part, 6)[0] // 2
    words = np.frombuffer(part[14 : 14 + 2 * (len(part) // 2 - 7)], ">u2").astype(np.int64)
    ends, starts, deltas, offsets = (
        words[at : at + count] for at in (0, *range(count + 1, 4 * count + 1, count))
    )
    for number in range(count):
        base = 3 * count + 1 + number + int(offsets[number]) // 2 - int(starts[number])
        for code in range(int(starts[number]), int(ends[number]) + 1):
            found = code if not offsets[number] else int(words[base + code])
            glyph = (found + int(deltas[number])) % 0x10000 if found else 0
            if glyph:
                yield code, glyph
