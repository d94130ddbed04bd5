"""CSV → cells, each with its place; parted by commas, semicolons or tabs."""

import re
from collections.abc import Iterator

from fcl_sim.diagnostics import Source, Span
from fcl_sim.matrix.matrix import Word

_QUOTED = r'[ \t]*"((?:[^"]|"")*)"[ \t]*'


def lines_of(source: Source) -> Iterator[list[Word]]:
    """Yield the cells of each line, none where all are empty. A quoted cell stays on its line."""
    sign = _sign(source.text)
    cell = re.compile(rf"(?:{_QUOTED}|([^{sign}\n]*))({sign}|$)")
    for number, start in enumerate(source.line_starts, start=1):
        found: list[Word] = []
        line, at = source.line_text(number), 0
        while match := cell.match(line, at):
            raw = match[1].replace('""', '"') if match[1] is not None else match[2]
            found.append(Word(raw.strip(), Span(source, start + at, start + max(match.start(3), at + 1))))
            if not match[3]:
                break
            at = match.end()
        yield found if any(each.text for each in found) else []


def _sign(text: str) -> str:
    """Return what parts cells: what there is most of."""
    return max(",;\t", key=text.count)
