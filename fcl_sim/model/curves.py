"""Smooth membership functions of the Open Level (Table 10), in one convention whatever the text wrote."""

from dataclasses import dataclass
from enum import StrEnum


class CurveKind(StrEnum):
    """Formulae of μ(x), before the height; in brackets the parameters in their order.

    `s(x; g, t) = 1 / (1 + exp(-g (x - t)))` is the logistic function, and
    `e(x; m, d) = exp(-(x - m)² / (2 d²))` the Gaussian one.
    """

    GAUSSIAN = "GAUSS"
    """[mean m, deviation d]: `e(x; m, d)`."""
    GAUSSIAN_PRODUCT = "GAUSS2"
    """[m1, d1, m2, d2]: `a b` with `a = e(x; m1, d1)` for x < m1, else 1; `b = e(x; m2, d2)` for x > m2,
    else 1."""
    BELL = "GBELL"
    """[half width w, slope b, centre c]: `1 / (1 + |(x - c) / w|^(2 b))`."""
    SIGMOID = "SIGM"
    """[gain g, inflection t]: `s(x; g, t)`."""
    SIGMOID_DIFFERENCE = "DSIGM"
    """[g1, t1, g2, t2]: `max(0, s(x; g1, t1) - s(x; g2, t2))`."""
    SIGMOID_DISTANCE = "SigmoidDifference"
    """[g1, t1, g2, t2]: `|s(x; g1, t1) - s(x; g2, t2)|`."""
    SIGMOID_PRODUCT = "SigmoidProduct"
    """[g1, t1, g2, t2]: `s(x; g1, t1) s(x; g2, t2)`."""
    COSINE = "COSINE"
    """[half width w, centre c]: `(1 + cos(π (x - c) / w)) / 2` for |x - c| ≤ w, else 0."""
    Z_SHAPE = "ZShape"
    """[start a, end b], a < b: 1 up to a, 0 from b on; with u = (x - a) / (b - a), `1 - 2 u²` up to the
    middle and `2 (1 - u)²` behind it."""
    S_SHAPE = "SShape"
    """[start a, end b], a < b: 1 minus the Z shape of the same parameters."""
    PI_SHAPE = "PiShape"
    """[a, b, c, d]: the S shape of [a, b] times the Z shape of [c, d]."""
    SPIKE = "Spike"
    """[centre c, width w]: `exp(-|10 (x - c) / w|)`."""
    CONCAVE = "Concave"
    """[inflection i, end e]: rising for i ≤ e, `(e - i) / (2 e - i - x)` for x < e, else 1; falling for
    i > e, `(i - e) / (i - 2 e + x)` for x > e, else 1."""


@dataclass(frozen=True, slots=True)
class Curve:
    """A smooth membership function: `height` times the formula of its kind.

    `parameters` stand in the order that the kind documents, in the unit of the
    variable; a text is the name of the input variable that holds one.
    `height` lies in (0, 1].
    """

    kind: CurveKind
    parameters: tuple[float | str, ...]
    height: float = 1.0
