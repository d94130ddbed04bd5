"""Text → model, all stages in one go."""

import gc
import re
import sys
from bisect import bisect_right
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import PurePath

from fcl_sim.diagnostics import Diagnostic, Place, Severity, Source, Span
from fcl_sim.diagnostics.codes import CODES
from fcl_sim.fcl.features import SLIPS
from fcl_sim.fcl.findings import in_order
from fcl_sim.fcl.parser import parse
from fcl_sim.fcl.resolver import resolve
from fcl_sim.fcl.scanner import scan
from fcl_sim.fcl.tokens import Scan
from fcl_sim.fcl.tree import Tree
from fcl_sim.model import FunctionBlock, Level, Note

LONGEST_TEXT = 8 * 1024 * 1024
"""In characters; 10,000 rules are one million."""

_FFLL = re.compile(
    r"^[ \t]*(\w+[ \t]+REAL[ \t]*;)[ \t]*\(\*[ \t]*RANGE[ \t]*\(", re.IGNORECASE | re.MULTILINE
)
"""A declaration without a colon whose range stands in a comment: FFLL takes it from there."""

UNNAMED = "unnamed"
"""The name of a function block without one, in a text that is no file."""

_CHARACTERS = frozenset(("FCL111", "FCL112", "FCL115"))
"""What the scanner says of single words: of no interest where the text is not FCL."""


@dataclass(frozen=True, slots=True)
class Reading:
    """What a text says. `blocks` is empty where one of the diagnostics is an error."""

    blocks: tuple[FunctionBlock, ...]
    diagnostics: tuple[Diagnostic, ...]

    @property
    def errors(self) -> tuple[Diagnostic, ...]:
        """The findings for which there are no blocks."""
        return tuple(each for each in self.diagnostics if each.is_error)


def read(text: str, name: str = "<text>") -> Reading:
    """Return the function blocks of an FCL text (S16), and everything that is to be said about it.

    `name` is what the user calls the text; a function block without a name is
    called by its stem (S11). No text raises an exception.
    """
    source = Source(name, text)
    if len(text) > LONGEST_TEXT:
        message = f"this text has {len(text)} characters; {LONGEST_TEXT} are read at most"
        too_long = Diagnostic(code="FCL102", message=message, places=(Place(Span(source, 0, 0)),))
        return Reading((), (too_long,))
    foreign = _FFLL.search(text)
    if foreign is not None:
        return Reading((), (_refuse_ffll(source, foreign),))
    with _uncollected():
        return _read(source)


@contextmanager
def _uncollected() -> Iterator[None]:
    """Keep the collector of garbage away from what is being read.

    Reading makes many objects and drops few: to walk them again and again would
    make the time grow faster than the text.
    """
    collects = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if collects:
            gc.enable()


def _read(source: Source) -> Reading:
    scanned = scan(source)
    parsed = parse(scanned)
    resolved = resolve(parsed.tree, PurePath(source.name).stem if source.name != "<text>" else UNNAMED)
    characters = _outside(scanned.diagnostics, parsed.tree.verbatim)
    diagnostics = in_order((*characters, *parsed.diagnostics, *resolved.diagnostics))
    faulty = any(each.severity is Severity.ERROR for each in diagnostics)
    if faulty:
        return Reading((), diagnostics)
    stretches = sorted((each.start, each.end) for each in parsed.tree.verbatim)
    scanned_notes = (each for each in scanned.notes if not _is_within(each.span, stretches))
    noted = (*scanned_notes, *parsed.notes, *resolved.notes)
    notes = (*noted, *_line_comments(scanned), *_slips(diagnostics))
    return Reading(_annotated(parsed.tree, resolved.blocks, notes), diagnostics)


def _refuse_ffll(source: Source, declaration: re.Match[str]) -> Diagnostic:
    """Return the one message about a text of another language that only looks like FCL (S15a)."""
    return Diagnostic(
        code="FCL222",
        message="this is written for FFLL, whose language is not FCL",
        places=(Place(Span(source, declaration.start(1), declaration.end(1))),),
        hint="write `name: REAL;`, the range as `RANGE := (low .. high);`, "
        "and rules with variables: `IF variable IS term`",
    )


def _line_comments(scanned: Scan) -> list[Note]:
    """Return a note for each comment that goes to the end of its line: Table 11 asks for them."""
    return [
        Note("line comment", "//", Level.BASIC, Span(scanned.source, each.start, each.end))
        for each in scanned.comments
        if each.text.startswith("//")
    ]


def _slips(diagnostics: Sequence[Diagnostic]) -> list[Note]:
    """Return a note for each place where the text is read though the standard would have it otherwise."""
    return [
        Note(each.code, CODES[each.code], Level.OPEN, place.span)
        for each in diagnostics
        if each.code in SLIPS
        for place in each.places
        if not place.label
    ]


def _annotated(
    tree: Tree, blocks: Sequence[FunctionBlock], notes: Sequence[Note]
) -> tuple[FunctionBlock, ...]:
    """Return each function block with the notes up to the next one, in the order of the text."""
    starts = [each.opening.start for each in tree.blocks[1:]]
    parts: list[list[Note]] = [[] for _ in blocks]
    for note in sorted(notes, key=_start):
        parts[bisect_right(starts, _start(note))].append(note)
    return tuple(replace(block, notes=tuple(own)) for block, own in zip(blocks, parts, strict=True))


def _start(note: Note) -> int:
    return note.span.start if note.span else 0


def _outside(diagnostics: Sequence[Diagnostic], verbatim: Sequence[Span]) -> list[Diagnostic]:
    """Return what the scanner found, without the words of stretches that are not FCL."""
    stretches = sorted((each.start, each.end) for each in verbatim)
    kept = []
    for each in diagnostics:
        places = each.places
        if each.code in _CHARACTERS:
            places = tuple(place for place in places if not _is_within(place.span, stretches))
        if places:
            kept.append(
                Diagnostic(
                    code=each.code,
                    message=each.message,
                    severity=each.severity,
                    places=places,
                    hint=each.hint,
                )
            )
    return kept


def _is_within(span: Span | None, stretches: Sequence[tuple[int, int]]) -> bool:
    if span is None:
        return False
    at = bisect_right(stretches, (span.start, sys.maxsize)) - 1
    return at >= 0 and span.start < stretches[at][1]
