"""Algorithms named by keywords: Tables 1, 3, 4 and 5, and those of the Open Level.

With a and b degrees, the T-norms of the Open Level are

    HPROD  Hamacher   a b / (a + b - a b), 0 for a = b = 0
    EPROD  Einstein   a b / (2 - (a + b - a b))
    DPROD  drastic    min(a, b) where max(a, b) = 1, else 0
    NMIN   nilpotent  min(a, b) where a + b > 1, else 0

and HSUM, ESUM, DSUM, NMAX are their S-norms by de Morgan's law:

    HSUM   (a + b - 2 a b) / (1 - a b), 1 for a = b = 1
    ESUM   (a + b) / (1 + a b)
    DSUM   max(a, b) where min(a, b) = 0, else 1
    NMAX   max(a, b) where a + b < 1, else 1
"""

from enum import StrEnum


class AndOperator(StrEnum):
    """Algorithm of AND (Table 3)."""

    MIN = "MIN"
    PROD = "PROD"
    BDIF = "BDIF"
    HPROD = "HPROD"
    EPROD = "EPROD"
    DPROD = "DPROD"
    NMIN = "NMIN"


class OrOperator(StrEnum):
    """Algorithm of OR (Table 3)."""

    MAX = "MAX"
    ASUM = "ASUM"
    BSUM = "BSUM"
    HSUM = "HSUM"
    ESUM = "ESUM"
    DSUM = "DSUM"
    NMAX = "NMAX"


class Activation(StrEnum):
    """Algorithm of activation (Table 4); of no effect on singletons."""

    MIN = "MIN"
    PROD = "PROD"
    BDIF = "BDIF"
    HPROD = "HPROD"
    EPROD = "EPROD"
    DPROD = "DPROD"
    NMIN = "NMIN"


class Accumulation(StrEnum):
    """Algorithm of accumulation (Table 5)."""

    MAX = "MAX"
    BSUM = "BSUM"
    NSUM = "NSUM"
    ASUM = "ASUM"
    SUM = "SUM"
    """The sum without a bound."""
    HSUM = "HSUM"
    ESUM = "ESUM"
    DSUM = "DSUM"
    NMAX = "NMAX"


class Method(StrEnum):
    """Method of defuzzification (Tables 1 and 2)."""

    COG = "CoG"
    COGS = "CoGS"
    COA = "CoA"
    LM = "LM"
    RM = "RM"
    MM = "MM"
    """Open Level: the mean of LM and RM."""
    SUM = "COGSS"
    """Open Level: the sum of the singletons' places, each times its degree."""


class Hedge(StrEnum):
    """What a hedge makes of a degree a (Open Level)."""

    VERY = "very"
    """a²"""
    EXTREMELY = "extremely"
    """2 a² for a ≤ 0.5, else 1 - 2 (1 - a)²"""
    SOMEWHAT = "somewhat"
    """√a"""
    SELDOM = "seldom"
    """√(a / 2) for a ≤ 0.5, else 1 - √((1 - a) / 2)"""
    ANY = "any"
    """1"""
    NOT = "not"
    """1 - a"""
