"""What a block reports when it runs: the manual's run-time errors, and overflow.

An error sets ENO to 0 (pp. 84, 86) and here leaves the outputs as they were,
of which the manual says nothing; with a warning the block runs and ENO stays 1
(p. 81). Kernels return a number: 0 for nothing, positive for an error,
negative for a warning.
"""

from enum import StrEnum

NOTHING = 0
TOO_MANY = 1
WRONG_NUMBER = 2
OUT_OF_RANGE = 3
OVERFLOWN = 4
WARNED_WRONG_NUMBER = -WRONG_NUMBER


class Event(StrEnum):
    """An event by its name; `OVERFLOW` is none of the manual's."""

    TOO_MANY_INPUTS = "E_EFB_TOO_MANY_INPUTS"
    WRONG_NUMBER_OF_INPUTS = "E_EFB_WRONG_NUMBER_OF_INPUTS"
    INPUT_VALUE_OUT_OF_RANGE = "E_EFB_INPUT_VALUE_OUT_OF_RANGE"
    OVERFLOW = "OVERFLOW"


NAMES = (
    Event.TOO_MANY_INPUTS,
    Event.WRONG_NUMBER_OF_INPUTS,
    Event.INPUT_VALUE_OUT_OF_RANGE,
    Event.OVERFLOW,
)
"""Events by their numbers, from 1."""


def event_of(number: int) -> Event | None:
    """Return the event that a kernel has reported by `number`."""
    return NAMES[abs(number) - 1] if number != NOTHING else None
