"""The letters of figures: how wide a text is, and how it is broken or cut to fit."""

import re
from functools import cache, lru_cache
from importlib.util import find_spec
from pathlib import Path

from fcl_sim.report import truetype
from fcl_sim.report.style import NORMAL

ASCENT, DESCENT = 0.76, 0.24
"""What letters take above and below their line, in parts of their size."""
CAPITALS = 0.73
STEP = 1.16
"""From line to line."""

EM = 2048
"""Units of the font in its size."""


def fonts() -> Path:
    """Return the folder of the fonts that figures are set in, matplotlib's, without loading that."""
    found = find_spec("matplotlib")
    if found is None or found.origin is None:
        raise ModuleNotFoundError("matplotlib, which has the fonts of figures, is not installed")
    return Path(found.origin).parent / "mpl-data" / "fonts" / "ttf"


@cache
def _font(*, bold: bool) -> truetype.Font:
    return truetype.read(fonts() / ("DejaVuSans-Bold.ttf" if bold else "DejaVuSans.ttf"))


@lru_cache(maxsize=4096)
def _advance(letter: str, *, bold: bool) -> float:
    """Return the width of a letter in parts of its size."""
    return _font(bold=bold).advance(letter) / EM


def known(letter: str) -> bool:
    """Return whether the font of figures has a letter."""
    return ord(letter) in _font(bold=False).glyphs


@lru_cache(maxsize=4096)
def text_width(text: str, size: float = NORMAL, *, bold: bool = False) -> float:
    """Return the width of one line of text in mm."""
    return sum(_advance(each, bold=bold) for each in text) * size / 72.0 * 25.4


def wrapped(text: str, width: float, size: float = NORMAL) -> str:
    """Break text into lines of at most `width` mm: at blanks; a word longer than a line after `.`, `_`, `/`.

    Where that does not help it is broken anywhere, a number too.
    """
    lines: list[str] = []
    line = ""
    for word in WORD.findall(text):
        is_long = text_width(word.lstrip(), size) > width
        for piece in PIECE.findall(word) if is_long else (word,):
            if line and text_width(line + piece, size) > width:
                lines.append(line.rstrip())
                line = ""
            line += piece if line else piece.lstrip()
            while text_width(line, size) > width and len(line) > 1:
                cut = max(1, int(len(line) * width / text_width(line, size)) - 1)
                lines.append(line[:cut])
                line = line[cut:]
    return "\n".join([*lines, line.rstrip()])


WORD = re.compile(r" *[^ ]+")
"""A word with the blanks before it."""

PIECE = re.compile(r".*?(?:[_/,]|\.(?!\d))|.+")
"""A part of a word up to where it may be broken, the blanks before it included; no number is."""


def cut(text: str, width: float, size: float = NORMAL) -> str:
    """Return text of at most `width` mm: what is too long loses its middle to an ellipsis."""
    if text_width(text, size) <= width:
        return text
    kept = len(text)
    while kept > 2:
        kept = min(kept - 1, int(kept * width / max(text_width(text[:kept], size), 1e-9)))
        shorter = text[: (kept + 1) // 2] + "…" + text[len(text) - kept // 2 :]
        if text_width(shorter, size) <= width:
            return shorter
    return "…"
