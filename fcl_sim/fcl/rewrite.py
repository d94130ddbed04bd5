"""Text → canonical text: read, written back with its comments, read again."""

from fcl_sim.diagnostics import InputFault, Source
from fcl_sim.fcl.basic import to_basic_level
from fcl_sim.fcl.comments import gather_comments
from fcl_sim.fcl.parser import parse
from fcl_sim.fcl.reading import read
from fcl_sim.fcl.scanner import scan
from fcl_sim.fcl.writer import write


def rewrite(source: Source, *, basic: bool = False) -> str:
    """Return the canonical form of a text, which says the same and has all its comments.

    `basic` asks for the Basic Level (Table 8). Raises InputFault with the errors
    of a text that has any, or with the places that the Basic Level cannot say.
    """
    reading = read(source.text, source.name)
    if reading.errors:
        raise InputFault(reading.errors)
    blocks = reading.blocks
    span = blocks[0].span
    scanned = scan(span.source if span else source)
    comments = gather_comments(scanned, parse(scanned).tree)
    if basic:
        blocks = tuple(to_basic_level(each) for each in blocks)
    text = write(blocks, comments, terse=basic)
    if read(text, source.name).blocks != blocks:
        raise RuntimeError(f"what was written of {source.name} does not say what was read")
    return text
