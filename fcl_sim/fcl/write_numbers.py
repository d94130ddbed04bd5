"""Numbers of the model → literals (IEC 61131-3 B.1.2)."""

from decimal import Decimal
from math import isnan

from fcl_sim.model import DataType

_LARGEST = {DataType.LINT: 2**63 - 1, DataType.ULINT: 2**64 - 1}
"""Where the limit of a type is no number of binary64, and what is written for its neighbour."""


def number(value: float | str) -> str:
    """Return the shortest literal that reads back as `value`, or the name of the variable that holds it.

    Between 1e-4 and 1e16 it has no exponent; elsewhere it has one where that is shorter.
    """
    if isinstance(value, str):
        return value
    if isnan(value):
        return "nan"
    shortest = repr(float(value))
    plain = format(Decimal(shortest), "f").removesuffix(".0")
    mantissa, exponent_mark, exponent = shortest.partition("e")
    if not exponent_mark:
        return plain
    fraction = mantissa if "." in mantissa else f"{mantissa}.0"
    scientific = f"{fraction}E{int(exponent)}"
    return min(plain, scientific, key=len)


def constant(value: float, data_type: DataType) -> str:
    """Return the initial value of a variable of a type."""
    if data_type is DataType.BOOL:
        return "TRUE" if value else "FALSE"
    if data_type in {DataType.REAL, DataType.LREAL}:
        return number(value)
    return str(min(int(value), _LARGEST.get(data_type, int(value))))
