"""The statements of a text, one after the other: what a comment can belong to."""

from bisect import bisect_left
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import count

from fcl_sim.fcl import tree
from fcl_sim.fcl.tokens import Scan, Token

HEAD, END, OPTIONS, VERBATIM = "head", "end", "options", "verbatim"
"""Keys of the heading of a section or block, of its END, of OPTIONS, and of a stretch that is not FCL."""
TYPE, END_TYPE, STRUCT, END_STRUCT = "type", "end type", "struct", "end struct"
"""Keys of what surrounds structure types, and of what surrounds the members of one."""


@dataclass(frozen=True, slots=True)
class Statement:
    """Characters `start` to `end` (exclusive) of a text.

    `section` numbers the sections and blocks of the text. `key` tells what is
    unique in its section: HEAD, END, the keyword of a setting; else it is empty.
    The options of a block belong to the block, with keys from `options0` on.
    Each structure type is a section of its own, its members have their names as
    keys; TYPE belongs to the first one behind it, END_TYPE to the last before it.
    """

    start: int
    end: int
    section: int
    key: str


@dataclass(frozen=True, slots=True)
class _Opened:
    start: int
    section: int
    key: str


def outline(scan: Scan, syntax: tree.Tree) -> tuple[Statement, ...]:
    """Return the statements of a text that was read without an error, in its order.

    A section's heading and its END are statements, OPTIONS with all it holds is
    one, and so is each stretch between function blocks that is not FCL.
    """
    tokens = _Tokens(scan)
    opened = sorted(_opened(tokens, syntax), key=lambda each: each.start)
    ends = [tokens.before(each.start).end for each in opened[1:]]
    if opened:
        ends.append(tokens.before(len(scan.source.text) + 1).end)
    foreign = {each.start: each.end for each in syntax.verbatim}
    return tuple(
        Statement(each.start, foreign.get(each.start, end), each.section, each.key)
        for each, end in zip(opened, ends, strict=True)
    )


class _Tokens:
    """The tokens of a text, by their place."""

    def __init__(self, scan: Scan) -> None:
        self._tokens = scan.tokens[:-1]
        self._starts = [each.start for each in self._tokens]

    def before(self, offset: int) -> Token:
        """Return the last token that begins before `offset`."""
        return self._tokens[bisect_left(self._starts, offset) - 1]

    def closing(self, start: int, limit: int) -> Token | None:
        """Return the last token END… between two offsets."""
        for at in range(bisect_left(self._starts, limit) - 1, bisect_left(self._starts, start) - 1, -1):
            if self._tokens[at].key.startswith("END"):
                return self._tokens[at]
        return None


def _opened(tokens: _Tokens, syntax: tree.Tree) -> Iterator[_Opened]:
    end = len(syntax.source.text) + 1
    stretches = [each.start for each in syntax.verbatim if not _is_inside(each.start, syntax)]
    openings = [each.opening.start for each in syntax.blocks]
    openings += [each.opening.start for each in syntax.types]
    limits = sorted([*stretches, *openings, end])
    numbers = count()
    for types in syntax.types:
        start = types.opening.start
        limit = next(each for each in limits if each > start)
        yield from _structures(tokens, types, (start, limit), numbers)
    for start in stretches:
        yield _Opened(start, next(numbers), VERBATIM)
    for block in syntax.blocks:
        limit = next(each for each in limits if each > block.opening.start)
        yield from _block(tokens, block, limit, numbers)


def _is_inside(start: int, syntax: tree.Tree) -> bool:
    """Return whether a stretch is that of options."""
    parts = (each for block in syntax.blocks for each in block.sections)
    return any(isinstance(each, tree.Options) and each.start == start for each in parts)


def _block(tokens: _Tokens, block: tree.Block, limit: int, numbers: Iterator[int]) -> Iterator[_Opened]:
    number = next(numbers)
    yield _Opened(block.opening.start, number, HEAD)
    closing = tokens.closing(block.opening.start, limit)
    if closing is not None:
        yield _Opened(closing.start, number, END)
        limit = closing.start
    starts = [_opening(tokens, each) for each in block.sections]
    options = count()
    for section, start, after in zip(block.sections, starts, [*starts[1:], limit], strict=False):
        if isinstance(section, tree.Options):
            yield _Opened(start, number, f"{OPTIONS}{next(options)}")
        elif isinstance(section, tree.Structures):
            yield from _structures(tokens, section, (start, after), numbers)
        else:
            yield from _section(tokens, section, (start, after), next(numbers))


def _section(
    tokens: _Tokens, section: tree.Section, extent: tuple[int, int], number: int
) -> Iterator[_Opened]:
    yield _Opened(extent[0], number, HEAD)
    for start, key in _statements(tokens, section):
        yield _Opened(start, number, key)
    end = tokens.closing(*extent)
    if end is not None:
        yield _Opened(end.start, number, END)


def _structures(
    tokens: _Tokens, types: tree.Structures, extent: tuple[int, int], numbers: Iterator[int]
) -> Iterator[_Opened]:
    starts = [_struct(each) for each in types.structures]
    limit = extent[1]
    ends = tokens.closing(*extent) if types.opening.key == "TYPE" else None
    if ends is not None:
        limit = ends.start
    number = next(numbers)
    if types.opening.key == "TYPE":
        yield _Opened(extent[0], number, TYPE)
    for structure, start, after in zip(types.structures, starts, [*starts[1:], limit], strict=False):
        number = number if start == starts[0] else next(numbers)
        yield _Opened(start, number, STRUCT)
        for at, key in _declarations(structure.members):
            yield _Opened(at, number, key)
        end = tokens.closing(start, after)
        if end is not None:
            yield _Opened(end.start, number, END_STRUCT)
    if ends is not None:
        yield _Opened(ends.start, number, END_TYPE)


def _struct(structure: tree.Structure) -> int:
    """Return where a structure type begins: with its name, or with STRUCT."""
    start = structure.keyword.start
    return start if structure.name is None else min(start, structure.name.start)


def _opening(tokens: _Tokens, section: tree.Section) -> int:
    if isinstance(section, tree.Options):
        return tokens.before(section.start).start
    return section.opening.start


def _statements(tokens: _Tokens, section: tree.Section) -> Iterator[tuple[int, str]]:
    """Yield where the statements of a section begin, and the keyword of each setting."""
    match section:
        case tree.Declarations():
            yield from ((at, "") for at, _ in _declarations(section.variables))
        case tree.Fuzzify() | tree.Defuzzify():
            for term in section.terms:
                yield tokens.before(term.name.start).start, ""
        case tree.RuleBlock():
            for rule in section.rules:
                yield rule.start, ""
    if isinstance(section, tree.Fuzzify | tree.Defuzzify | tree.RuleBlock):
        for setting in section.settings:
            yield setting.keyword.start, setting.key


def _declarations(variables: Sequence[tree.Declaration]) -> Iterator[tuple[int, str]]:
    """Yield where declarations begin, and their first name: several names may have one type."""
    last: object = None
    for each in variables:
        if each.type is None or each.type is not last:
            yield each.name.start, each.name.key
        last = each.type
