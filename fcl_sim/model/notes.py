"""Notes: what a text uses beyond the Basic Level, and where (clause 6)."""

from dataclasses import dataclass, field
from enum import StrEnum

from fcl_sim.diagnostics import Span


class Level(StrEnum):
    """Conformance levels (6.2); OPEN is everything that Tables 8 and 9 do not list."""

    BASIC = "Basic"
    EXTENSION = "Extension"
    OPEN = "Open"


@dataclass(frozen=True, slots=True)
class Note:
    """A feature of the text: `code` says of which kind, `feature` what is written.

    The reader's vocabulary of codes is in `fcl.features`; a slip that is read
    nevertheless has the code of its finding.
    """

    code: str
    feature: str
    level: Level
    span: Span | None = field(default=None, compare=False, repr=False)
