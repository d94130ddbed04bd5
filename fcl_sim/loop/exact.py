"""Advance a linear plant between two writes: exactly, whatever the length, its inputs late by a dead time.

The inputs are constant between the moments at which writes arrive, and they
are states themselves, the last ones: x' = M x, so that x(t + h) = x + F x with
F = exp(M h) - 1. F is computed by scaling and squaring, its Taylor series to
the power 16 and F(2 h) = 2 F(h) + F(h)^2; in this form slow motions lose no
digits to the 1. A scan has the same few lengths again and again, so the last
ones are remembered; under jitter each is computed anew.

After Moler & Van Loan, Nineteen dubious ways to compute the exponential of a
matrix, 2003, methods 1 and 3; Van Loan 1978 for the inputs as states.
"""

from math import fabs

from fcl_sim.jit import flat, inlined, u
from fcl_sim.loop.layout import (
    BLEW_UP,
    DELAY,
    PLANT_INPUTS,
    STAGES,
    STATES,
    TRUE_STATES,
    UNDER_WAY,
)
from fcl_sim.loop.step import derive
from fcl_sim.loop.work import INDEX, PROGRESS, STATUS, Floats, Ints, Plant, Work, row_of, rows_size

REMEMBERED = 4
"""Lengths whose F is kept."""
SMALL, POWER, MOST_SQUARINGS = 0.5, 16, 1100
"""The series is taken of a matrix of at most this norm, to this power: what is left out is below 1e-20."""

COUNT, FIRST, OLDEST, LENGTHS = PROGRESS, PROGRESS + 1, PROGRESS + 2, PROGRESS + 3
TICKS = LENGTHS + REMEMBERED
"""Further words of `progress`: writes under way, and where in their ring the first stands; which
length is forgotten next; the lengths; the nanosecond of each write in the ring. In `rows`, behind
the derivatives: an F for each length, two matrices to work in, the values of each write in the ring."""


def exact_words(ints: Ints) -> tuple[int, int]:
    """Return how many words it needs in `progress` and in `rows`."""
    size, ring = int(ints[TRUE_STATES]), int(ints[UNDER_WAY])
    if ring == 0:
        return 0, 0
    return TICKS + ring - PROGRESS, (REMEMBERED + 2) * size * size + ring * int(ints[PLANT_INPUTS])


@inlined
def matrix_at(ints: Ints, which: int) -> int:
    """Return where in `rows` a matrix begins: one of those remembered, then those to work in."""
    size = ints[u(TRUE_STATES)]
    at: int = rows_size(ints[u(STAGES)], ints[u(STATES)]) + which * size * size
    return at


@flat
def send(work: Work, tick: int) -> None:
    """Put what was written to the plant's inputs at `tick` on its way."""
    ints, progress, count = work.ints, work.progress, work.ints[u(PLANT_INPUTS)]
    place = (progress[u(FIRST)] + progress[u(COUNT)]) % ints[u(UNDER_WAY)]
    progress[u(TICKS + place)] = tick
    progress[u(COUNT)] += 1
    at = matrix_at(ints, REMEMBERED + 2) + place * count
    for i in range(count):
        work.rows[u(at + i)] = work.held[u(i)]


@flat
def receive(work: Work, tick: int) -> None:
    """Let everything arrive that was written so long before `tick`."""
    ints, progress, count = work.ints, work.progress, work.ints[u(PLANT_INPUTS)]
    while progress[u(COUNT)] > 0 and progress[u(TICKS + progress[u(FIRST)])] + ints[u(DELAY)] <= tick:
        at = matrix_at(ints, REMEMBERED + 2) + progress[u(FIRST)] * count
        for i in range(count):
            work.x[u(ints[u(TRUE_STATES)] - count + i)] = work.rows[u(at + i)]
        progress[u(FIRST)] = (progress[u(FIRST)] + 1) % ints[u(UNDER_WAY)]
        progress[u(COUNT)] -= 1


@inlined
def multiply(rows: Floats, size: int, one: int, other: int, result: int) -> None:
    """Set the matrix that begins at `result` to the product of two others."""
    for i in range(size):
        for j in range(size):
            total = 0.0
            for k in range(size):
                total += rows[u(one + i * size + k)] * rows[u(other + k * size + j)]
            rows[u(result + i * size + j)] = total


@flat
def scaled(plant: Plant, work: Work, h: float, at: int) -> int:
    """Set the matrix at `at` to M h / 2^s, small enough for the series; return s."""
    size, x, kept = work.ints[u(TRUE_STATES)], work.x, work.dx
    derivative = row_of(0, work.ints[u(STATES)])
    for i in range(size):
        kept[u(i)] = x[u(i)]
    norm = 0.0
    for j in range(size):
        for i in range(size):
            x[u(i)] = 1.0 if i == j else 0.0
        derive(plant, work, 0.0)
        column = 0.0
        for i in range(size):
            entry = h * work.rows[u(derivative + i)]
            work.rows[u(at + i * size + j)] = entry
            column += fabs(entry)
        norm = max(norm, column)
    for i in range(size):
        x[u(i)] = kept[u(i)]
    squarings = 0
    while norm > SMALL and squarings < MOST_SQUARINGS:
        norm *= 0.5
        squarings += 1
    for i in range(size * size):
        work.rows[u(at + i)] *= 0.5**squarings
    return squarings


@flat
def propagator(plant: Plant, work: Work, length: int) -> int:
    """Return where in `rows` F stands for a length in nanoseconds."""
    ints, progress, rows = work.ints, work.progress, work.rows
    for i in range(REMEMBERED):
        if progress[u(LENGTHS + i)] == length:
            return matrix_at(ints, i)
    which = progress[u(OLDEST)]
    progress[u(OLDEST)] = (which + 1) % REMEMBERED
    progress[u(LENGTHS + which)] = length
    size = ints[u(TRUE_STATES)]
    at, small, product = matrix_at(ints, which), matrix_at(ints, REMEMBERED), matrix_at(ints, REMEMBERED + 1)
    squarings = scaled(plant, work, length / 1e9, small)
    for i in range(size * size):
        rows[u(at + i)] = rows[u(small + i)] / POWER
    for power in range(POWER - 1, 0, -1):
        multiply(rows, size, small, at, product)
        for i in range(size * size):
            rows[u(at + i)] = (rows[u(small + i)] + rows[u(product + i)]) / power
    for _ in range(squarings):
        multiply(rows, size, at, at, product)
        for i in range(size * size):
            rows[u(at + i)] = 2.0 * rows[u(at + i)] + rows[u(product + i)]
    return at


@flat
def move(work: Work, at: int) -> bool:
    """Add F x to x; return whether all of it is finite. On failure `progress` says of what."""
    size, x, dx, rows = work.ints[u(TRUE_STATES)], work.x, work.dx, work.rows
    for i in range(size):
        total = 0.0
        for j in range(size):
            total += rows[u(at + i * size + j)] * x[u(j)]
        dx[u(i)] = total
    for i in range(size):
        x[u(i)] += dx[u(i)]
        if x[u(i)] * 0.0 != 0.0:
            work.progress[u(STATUS)] = BLEW_UP
            work.progress[u(INDEX)] = i
            return False
    return True


@flat
def advance_exactly(plant: Plant, work: Work, start: int, end: int) -> bool:
    """Advance x between two nanoseconds; return whether it could.

    What arrives at `end` itself does so in the piece that begins there: a scan
    reads before it writes.
    """
    ints, progress = work.ints, work.progress
    done = start
    while done < end:
        receive(work, done)
        until = end
        if progress[u(COUNT)] > 0:
            until = min(end, progress[u(TICKS + progress[u(FIRST)])] + ints[u(DELAY)])
        if not move(work, propagator(plant, work, until - done)):
            return False
        done = until
    return True
