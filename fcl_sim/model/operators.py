"""Algorithms named by keywords: Tables 1, 3, 4 and 5."""

from enum import StrEnum


class AndOperator(StrEnum):
    """Algorithm of AND (Table 3)."""

    MIN = "MIN"
    PROD = "PROD"
    BDIF = "BDIF"


class OrOperator(StrEnum):
    """Algorithm of OR (Table 3)."""

    MAX = "MAX"
    ASUM = "ASUM"
    BSUM = "BSUM"


class Activation(StrEnum):
    """Algorithm of activation (Table 4); of no effect on singletons."""

    MIN = "MIN"
    PROD = "PROD"


class Accumulation(StrEnum):
    """Algorithm of accumulation (Table 5)."""

    MAX = "MAX"
    BSUM = "BSUM"
    NSUM = "NSUM"


class Method(StrEnum):
    """Method of defuzzification (Tables 1 and 2)."""

    COG = "CoG"
    COGS = "CoGS"
    COA = "CoA"
    LM = "LM"
    RM = "RM"
