"""The one style of all figures: sizes, colours, strokes."""

FONT = "DejaVu Sans"

WIDTH = 166.0
"""Width of a figure in mm: the text column of the report."""

INK = "#1b1f24"
FAINT = "#5c6670"
GRID = "#e6e8eb"
PAPER = "#ffffff"
BAND = "#e3edf5"
BOUND = "#3f5f7f"
VIOLATION = "#f5c3a6"
VIOLATION_EDGE = "#c2540a"
UNDEFINED = "#eceef0"

COLOURS = ("#0b5fa5", "#d55e00", "#00805f", "#b0568c", "#8a6d00", "#3a9bd0", "#4d4d4d")
"""Runs and terms in turn, after Okabe and Ito, darkened to 3:1 on white."""

Dashes = tuple[float, ...]
"""Stroke, gap, ... in multiples of the width; none where it is solid."""

DASHES: tuple[Dashes, ...] = (
    (),
    (5, 1.6),
    (1.2, 1.2),
    (6, 1.5, 1.2, 1.5),
    (2.5, 1.2),
    (6, 1.5, 1.2, 1.5, 1.2, 1.5),
)
"""Strokes in turn, so that runs differ in grey as well; coprime with the colours."""

AGES = ("#8d959e", "#6b747d", "#4a525a", "#30373d", INK)
"""Colours of a way, from its begin to its end."""

HEAT = ("#3d6590", "#5a94a8", "#8fbfae", "#cfdfae", "#fbf3c9")
"""Colours of a map: they rise evenly in grey too, and are light enough to draw over."""

FIRING = ("#e8f0f7", "#8fb4d6", "#2f6ca5", "#0f3358")
"""Colours of a degree: the darker, the more a rule fires."""

WARMTH = ("#dceaf5", "#f5d9a8", "#dd7f3c")
"""Colours from cold to hot: they fall evenly in grey too, and are light enough to write on."""

LEADS = "#ffc533"
"""Light on ink: seen on any of these, in grey too."""

TALLEST = 212.0
"""Height in mm that a heading, a paragraph and a caption leave for a figure on a page."""

LEAST = 6.0
"""Points of the smallest letters on paper."""
SMALL = 6.4
NORMAL = 7.2

HINTED = 1.08
"""Drawn on few pixels, text may be so much wider than measured."""


def stroke(index: int) -> tuple[str, Dashes]:
    """Return colour and dashes of the run, or the term, number `index`."""
    return COLOURS[index % len(COLOURS)], DASHES[index % len(DASHES)]
