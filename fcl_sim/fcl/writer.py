"""Model → canonical FCL of the 2000 edition (5.4.1), with the comments of the text that it was read from."""

import re
from collections.abc import Iterator, Sequence
from itertools import takewhile

from fcl_sim.fcl.comments import NO_COMMENTS, Comments
from fcl_sim.fcl.outline import END, HEAD, OPTIONS, VERBATIM
from fcl_sim.fcl.write_declarations import declarations, structures
from fcl_sim.fcl.write_lines import Line, text_of
from fcl_sim.fcl.write_sections import defuzzify, fuzzify, rule_block
from fcl_sim.model import FunctionBlock, Structure

_IDENTIFIER = re.compile(r"[^\W\d]\w*")
_KEYWORD = "FUNCTION_BLOCK"


def write(
    blocks: FunctionBlock | Sequence[FunctionBlock], comments: Comments = NO_COMMENTS, *, terse: bool = False
) -> str:
    """Return function blocks as FCL that reads back as equal ones.

    `comments` are those of the text that the blocks were read from: each is
    written with the statement that it belongs to. Such a text also says what
    stands together, and, unless the result is to be `terse`, which settings are
    written although the same is taken without them.
    """
    several = (blocks,) if isinstance(blocks, FunctionBlock) else blocks
    shared = _shared(several)
    lines = list(structures(shared, comments))
    foreign = comments.numbers(VERBATIM)
    for block in several:
        head = comments.number(block.span)
        while foreign and head is not None and foreign[0] < head:
            lines.append(_verbatim(comments, foreign.pop(0)))
        lines += _block(block, block.structures[len(shared) :], comments, terse=terse)
    lines += [_verbatim(comments, each) for each in foreign]
    return text_of(lines, comments)


def _shared(blocks: Sequence[FunctionBlock]) -> tuple[Structure, ...]:
    """Return the structure types with which all blocks begin: they can stand outside, where all see them."""
    kinds = zip(*(each.structures for each in blocks), strict=False)
    return tuple(each[0] for each in takewhile(lambda each: each.count(each[0]) == len(each), kinds))


def _block(
    block: FunctionBlock, types: Sequence[Structure], comments: Comments, *, terse: bool
) -> Iterator[Line]:
    head = comments.part(block.span, HEAD)
    yield Line(code=(_heading(block, comments),), number=head, blank=True)
    yield from structures(types, comments)
    yield from declarations(block, comments)
    inputs = {each.name: each for each in block.inputs}
    for fuzzification in block.fuzzifications:
        variable = inputs.get(fuzzification.variable)
        yield from fuzzify(fuzzification, variable, comments, terse=terse)
    for defuzzification in block.defuzzifications:
        yield from defuzzify(defuzzification, comments, terse=terse)
    for each in block.rule_blocks:
        yield from rule_block(each, comments, terse=terse)
    yield from _options(block, comments)
    yield Line(code=("END_FUNCTION_BLOCK",), number=comments.part(block.span, END), blank=True)


def _heading(block: FunctionBlock, comments: Comments) -> str:
    """Return the heading; one without a name stays so where the name taken is no identifier (S11)."""
    head = comments.part(block.span, HEAD)
    if head is not None and not _IDENTIFIER.fullmatch(block.name):
        statement = comments.statements[head]
        if statement.end - statement.start == len(_KEYWORD):
            return _KEYWORD
    return f"{_KEYWORD} {block.name}"


def _options(block: FunctionBlock, comments: Comments) -> Iterator[Line]:
    """Yield the options, word for word (S4)."""
    for at, text in enumerate(block.options):
        lines = f"OPTIONS{text}END_OPTIONS".split("\n")
        yield Line(code=tuple(lines), number=comments.part(block.span, f"{OPTIONS}{at}"), blank=True)


def _verbatim(comments: Comments, number: int) -> Line:
    """Return a stretch between function blocks that is not FCL, as it is written."""
    statement = comments.statements[number]
    text = comments.source.text[statement.start : statement.end].replace("\r\n", "\n").rstrip()
    return Line(code=tuple(text.split("\n")), number=number, blank=True)
