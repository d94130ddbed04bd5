"""The page on characteristics (figure A.12): what the methods of FCL make of the same terms and rules."""

from collections.abc import Mapping, Sequence

import numpy as np

from fcl_sim.block import Block, loads
from fcl_sim.report import style
from fcl_sim.report.canvas import Axes, Figure, Line, Text, span
from fcl_sim.report.frame import draw_frame, ticks
from fcl_sim.report.relief import Relief, draw_relief
from fcl_sim.report.stretches import stretches
from fcl_sim.report.vector import svg

IMAGES = "images/characteristics"

HEAD = """\
# Characteristics

A rule base without memory is a curve over its input, or a surface over two (figure A.12 of IEC 61131-7).
The pictures show what the methods of FCL make of three terms and three or nine rules. `fcl-sim plot
FILE.fcl` draws those of any rule base; this page and its pictures are written by `python -m docs`, and a
test holds them current.

## Curves

![Six curves of u over e: straight, with flats, with gaps, of areas by several methods]({images}/curves.svg)

- **Terms that overlap fully** and singletons give straight lines from one peak to the next: any curve of
  straight pieces can be had so, and with evenly spaced singletons a linear controller.
- **Terms that overlap in part** give flat stretches where one term alone holds: a dead band around zero, or
  steps.
- **Terms with gaps** leave stretches in which no rule is active (hatched): DEFAULT, or with NC the value
  before, is given out. `fcl-sim run --coverage` tells whether a run went there.
- **Activation** by MIN cuts areas off, by PROD it scales them. Where the areas are of one form the
  difference is small.
- **CoG and CoA** of areas do not reach the ends of the output's range: the middle of an area lies inside of
  it.
- **LM and RM** take an edge of the highest plateau and jump where another rule becomes the strongest:
  nothing for an actuator that wears.

## Surfaces

![Six surfaces over e and de: creased, even, flat in parts, terraced, broken by LM]({images}/surfaces.svg)

The rules are those of a proportional and derivative controller:

    u
    e \\ de    negative  zero      positive
    negative  negative  negative  zero
    zero      negative  zero      positive
    positive  zero      positive  positive

PROD with BSUM or with terms that sum up to 1 is bilinear between the peaks, without the creases of MIN;
BDIF fires only where the degrees of both conditions add up to more than 1. A linear PI or PID controller is
a case of the first kind: the shipped scenarios in `scenarios/pi` hold it against the conventional one.

## Their rule bases

The curve of PROD and CoG, and the surface of PROD; the others differ in what the titles say.

```fcl
{curve}```

```fcl
{surface}```
"""

FULL = ("(-10, 1) (0, 0)", "(-10, 0) (0, 1) (10, 0)", "(0, 0) (10, 1)")
PART = ("(-7, 1) (-4, 0)", "(-7, 0) (-4, 1) (4, 1) (7, 0)", "(4, 0) (7, 1)")
GAPS = ("(-8, 1) (-6, 0)", "(-3, 0) (0, 1) (3, 0)", "(6, 0) (8, 1)")
SINGLETONS = ("-100", "20", "100")
AREAS = (
    "(-100, 0) (-60, 1) (-20, 0)",
    "(-60, 0) (0, 1) (60, 0)",
    "(20, 0) (60, 1) (100, 0)",
)
NAMES = ("negative", "zero", "positive")

Curves = Mapping[str, str]
"""Texts of rule bases by what they are called in a figure."""


def rule_base(
    inputs: Sequence[str], outputs: Sequence[str], method: str, rules: str = "", settings: str = "ACCU: MAX;"
) -> str:
    """Return a rule base of one input `e`, with three terms of each variable."""
    single = "".join(
        f"    RULE {k}: IF e IS {name} THEN u IS {name};\n" for k, name in enumerate(NAMES, start=1)
    )
    two = "de" in rules
    lines = [
        "FUNCTION_BLOCK characteristic",
        "VAR_INPUT e: LREAL; " + ("de: LREAL; " if two else "") + "END_VAR",
        "VAR_OUTPUT u: LREAL; END_VAR",
        *(_section("FUZZIFY", name, inputs, "") for name in (("e", "de") if two else ("e",))),
        _section("DEFUZZIFY", "u", outputs, f" METHOD: {method}; DEFAULT := 0;{_range(method)}"),
        f"RULEBLOCK rules {settings}\n{rules or single}END_RULEBLOCK",
        "END_FUNCTION_BLOCK",
    ]
    return "\n".join(lines) + "\n"


def _section(kind: str, name: str, terms: Sequence[str], more: str) -> str:
    told = " ".join(f"TERM {term} := {shape};" for term, shape in zip(NAMES, terms, strict=True))
    return f"{kind} {name} {told}{more} END_{kind}"


def _range(method: str) -> str:
    return "" if method == "CoGS" else " RANGE := (-100 .. 100);"


MATRIX = (
    ("negative", "negative", "zero"),
    ("negative", "zero", "positive"),
    ("zero", "positive", "positive"),
)
"""What the rules over two inputs conclude: rows are terms of `e`, columns those of `de`."""
LEVEL = ("-100", "0", "100")
NINE = "".join(
    f"    RULE {3 * i + k + 1}: IF e IS {NAMES[i]} AND de IS {NAMES[k]} THEN u IS {MATRIX[i][k]};\n"
    for i in range(3)
    for k in range(3)
)

CURVES: Mapping[str, Curves] = {
    "Terms that overlap fully": {"CoGS": rule_base(FULL, SINGLETONS, "CoGS")},
    "Terms that overlap in part": {"CoGS": rule_base(PART, SINGLETONS, "CoGS")},
    "Terms with gaps": {"CoGS, DEFAULT 0": rule_base(GAPS, SINGLETONS, "CoGS")},
    "Activation": {
        "MIN, CoG": rule_base(FULL, AREAS, "CoG", settings="ACT: MIN; ACCU: MAX;"),
        "PROD, CoG": rule_base(FULL, AREAS, "CoG", settings="ACT: PROD; ACCU: MAX;"),
    },
    "Defuzzification by areas": {
        "CoG": rule_base(FULL, AREAS, "CoG"),
        "CoA": rule_base(FULL, AREAS, "CoA"),
    },
    "Defuzzification by maxima": {
        "LM": rule_base(FULL, AREAS, "LM"),
        "RM": rule_base(FULL, AREAS, "RM"),
    },
}
SURFACES: Mapping[str, str] = {
    "AND: MIN": rule_base(FULL, LEVEL, "CoGS", NINE, "AND: MIN; ACCU: MAX;"),
    "AND: PROD": rule_base(FULL, LEVEL, "CoGS", NINE, "AND: PROD; ACCU: BSUM;"),
    "AND: BDIF": rule_base(FULL, LEVEL, "CoGS", NINE, "AND: BDIF; ACCU: MAX;"),
    "Terms that overlap in part": rule_base(PART, LEVEL, "CoGS", NINE, "AND: MIN; ACCU: MAX;"),
    "Areas, MIN, CoG": rule_base(FULL, AREAS, "CoG", NINE, "AND: MIN; ACCU: MAX;"),
    "Maxima, LM": rule_base(FULL, AREAS, "LM", NINE, "AND: MIN; ACCU: MAX;"),
}

ACROSS = 3
GAP, LEFT, TITLE, BELOW = 5.0, 11.0, 8.5, 9.0
EDGE = 2.0
"""Room for half a label at the right."""
WIDE, HIGH = (style.WIDTH - ACROSS * LEFT - 2 * GAP - EDGE) / ACROSS, 30.0
LIMITS = (-10.0, 10.0)
RANGE = (-100.0, 100.0)
POINTS = 2001
TILES = 21


def curves() -> bytes:
    """Return the curves, six drawings side by side and below one another, as SVG."""
    rows = -(-len(CURVES) // ACROSS)
    figure = Figure(rows * (TITLE + HIGH + BELOW))
    for index, (title, texts) in enumerate(CURVES.items()):
        row, column = divmod(index, ACROSS)
        left, top = column * (LEFT + WIDE + GAP) + LEFT, row * (TITLE + HIGH + BELOW) + TITLE
        axes = figure.place(left, top, WIDE, HIGH, title)
        axes.x, axes.y = LIMITS, (-110.0, 110.0)
        draw_frame(axes, ticks(*LIMITS, 4), ticks(*RANGE, 4), ("e", ""))
        axes.add(Text(0.0, 1.0, title, shift=(0.0, 4.6), parts=True))
        _draw_curves(axes, texts)
    return svg(figure, alone=True)


def _draw_curves(axes: Axes, texts: Curves) -> None:
    x = np.linspace(*LIMITS, POINTS)
    for number, (name, text) in enumerate(texts.items()):
        block, (colour, dashes) = loads(text), style.stroke(number)
        found = block.evaluation({"e": x})
        values = np.where(found.active["u"], found.outputs["u"], np.nan)
        axes.add(Line(x, values, colour, 1.2, dashes, z=4))
        for start, end in stretches(~found.active["u"]):
            ends = (float(x[start]), float(x[min(end, len(x) - 1)]))
            axes.add(span(axes, ends, style.UNDEFINED, hatched=True, z=1))
        left = 22.0 * number
        axes.add(
            Line(
                [left / WIDE, (left + 5.0) / WIDE],
                [1.0 + 2.0 / HIGH] * 2,
                colour,
                1.2,
                dashes,
                parts=True,
                free=True,
            )
        )
        axes.add(
            Text(0.0, 1.0, name, style.SMALL, style.FAINT, up="middle", shift=(left + 6.0, 2.0), parts=True)
        )


def surfaces() -> bytes:
    """Return the surfaces, six drawings side by side and below one another, as SVG."""
    rows = -(-len(SURFACES) // ACROSS)
    wide, high = (style.WIDTH - 2 * GAP) / ACROSS, 44.0
    figure = Figure(rows * (high + TITLE))
    for index, (title, text) in enumerate(SURFACES.items()):
        row, column = divmod(index, ACROSS)
        axes = figure.place(column * (wide + GAP), row * (high + TITLE) + 6.0, wide, high, title)
        axes.add(Text(0.0, 1.0, title, shift=(0.0, 1.0), parts=True))
        draw_relief(axes, _relief(loads(text)), RANGE)
    return svg(figure, alone=True)


def _relief(block: Block) -> Relief:
    x = np.linspace(*LIMITS, TILES)
    found = block.evaluate({"e": x[None, :], "de": x[:, None]})
    return Relief(x=x, y=x, values=found["u"], names=("e", "de", "u"))


def page() -> str:
    """Return the page."""
    return HEAD.format(images=IMAGES, curve=CURVES["Activation"]["PROD, CoG"], surface=SURFACES["AND: PROD"])


def images() -> dict[str, str]:
    """Return the figures by their path below docs/."""
    return {f"{IMAGES}/curves.svg": curves().decode(), f"{IMAGES}/surfaces.svg": surfaces().decode()}
