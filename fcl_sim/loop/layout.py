"""The tape's head: where everything of a run stands in its buffers.

A tape is one integer buffer `ints` and one float buffer `floats` that a run
does not change, and one float buffer `memory` that it works in. The first
words of `ints` are the numbers below; the rest of it are block rows, record
segments and programs, the rest of `floats` the scheme, scales and parameters.

`memory` begins with the signals that are checked each scan: the plant's
outputs, its inputs as written, the outputs of blocks; then, block by block, its
states, the constants that stand in for signals, what its late inputs read, or
the instance memory of a fuzzy block.
"""

STATES = 0
"""Number of states, a multiple of 4 (the last ones may be padding that stays 0)."""
TRUE_STATES = 1
PLANT_INPUTS = 2
PLANT_OUTPUTS = 3
EVENTS = 4
"""Number of events."""
DIRECTIONS_AT = 5
"""Where in `ints` the direction of each event stands, +1 or -1."""
SAMPLED = 6
"""1 where the plant does something at each scan."""
SCANS = 7
"""Number of scans, the one at the end not counted."""
MEASURED = 8
"""1 where blocks take the measured cycle time."""
ROWS = 9
"""Number of block rows."""
ROWS_AT = 10
WRITES_AT = 11
"""Where in `ints` the slot that each plant input is written from stands."""
WRITE_SIGNS_AT = 12
"""Where in `floats` the sign of each of them stands."""
SIGNALS = 13
"""Number of checked signals at the beginning of `memory`."""
SEGMENTS = 14
"""Number of stretches of `memory` that are recorded."""
SEGMENTS_AT = 15
"""Where in `ints` they stand, each as first slot and length."""
STAGES = 16
"""Rows of the integration scheme."""
ADAPTIVE = 17
"""1 where the scheme controls its step."""
SCHEME_AT = 18
"""Where in `floats` the scheme's table stands."""
SCALES_AT = 19
"""Where in `floats` the scale of each state stands, padding included."""
STEP_AT = 20
"""Where in `floats` stand the tolerance, the step of a fixed scheme and the cycle time (s), the exponent."""
PLANT_INPUTS_AT = 21
"""First slot of the plant's inputs in `memory`; its outputs begin at 0."""

ROWS_END = 22
"""Where in `ints` the block rows end."""
KEEPS = 23
"""Number of late inputs, which a block reads as the last scan left them."""
KEEPS_AT = 24
"""Where in `ints` they stand, each as slot, where in `floats` its sign stands, slot of what is kept."""

UNDER_WAY = 25
"""For a linear plant, which is moved exactly, how many writes can be on their way; else 0."""
DELAY = 26
"""Nanoseconds until a write arrives in the last states of a linear plant."""

HEAD = 27
"""Words of the head."""

RTOL, FIXED_STEP, CYCLE, EXPONENT = 0, 1, 2, 3
"""Offsets from STEP_AT; the exponent is that of step control, -1 / order."""

# A block row in `ints`: these words, the slots of the inputs, the block's words.
# In `floats` from PARAMETERS on: the sign of each input (with the gain, where a
# block has one), then the block's numbers (`loop.row`).
OPCODE, ROW_LENGTH, OUTPUT, STATE, PARAMETERS, INPUTS, FIRST_INPUT = 0, 1, 2, 3, 4, 5, 6

# How a run ends.
FINISHED = 0
NOT_FINITE = 1
"""A signal is NaN or infinite; `index` is its slot."""
BLEW_UP = 2
"""A state is NaN or infinite, or its error cannot be bounded; `index` is the state."""
STEP_TOO_SMALL = 3
"""The step that the tolerance needs has vanished; `index` is the worst state."""
CHATTERS = 4
"""Too many events at one time; `index` is the last event."""
BUDGET_SPENT = 5
"""Too many steps between two writes; `index` is the worst state."""
RUN_BUDGET_SPENT = 7
"""Too many steps in a run; `index` is the worst state."""
OUTSIDE = 6
"""Not an end: a block in Python is to be executed; `index` is where its row begins."""
