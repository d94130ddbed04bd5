"""Integer arithmetic of a PLC: degrees 0..10000, division as chosen, intermediates of 32 bits.

Values are int64 here, so that whatever leaves 32 bits is seen instead of
wrapping around.
"""

from fcl_sim.jit import inlined

FULL = 10_000
"""The degree 1."""

TRUNCATE, ROUND = 0, 1
"""What becomes of a quotient: cut off towards zero; or the nearest, halves away from zero."""

INT_LEAST, INT_MOST = -(2**15), 2**15 - 1
DINT_LEAST, DINT_MOST = -(2**31), 2**31 - 1


@inlined
def quotient(dividend: int, divisor: int, rounding: int) -> int:
    """Return `dividend` divided by a positive `divisor`."""
    size = abs(dividend)
    whole = size // divisor
    rest = size - whole * divisor
    if rounding == ROUND and rest >= divisor - rest:
        whole += 1
    return whole if dividend >= 0 else -whole


@inlined
def scaled(part: int, factor: int, whole: int, rounding: int) -> int:
    """Return `part` times `factor` divided by a positive `whole`: multiplied first, divided once."""
    return quotient(part * factor, whole, rounding)


@inlined
def fits_int(value: int) -> bool:
    """Return whether `value` is an INT, of 16 bits."""
    return INT_LEAST <= value <= INT_MOST


@inlined
def fits_dint(value: int) -> bool:
    """Return whether `value` is a DINT, of 32 bits."""
    return DINT_LEAST <= value <= DINT_MOST
