"""Markdown → blocks as data: as much of it as a README needs; nothing in it is ever markup of the page.

Headings, paragraphs, lists, tables, code, and within a line code, bold, italic
and links, of which the words are kept. Whatever else there is stays as it is written.
"""

import re
from collections.abc import Iterator, Sequence
from itertools import groupby
from typing import Any

from fcl_sim.report.words import plain

Data = dict[str, Any]
Run = tuple[str, str]
"""Words and how they stand: `plain`, `code`, `bold` or `italic`."""

HEADING = re.compile(r"(#{1,6})\s+(.*?)\s*#*$")
ITEM = re.compile(r"(?:[-*+]|(\d+)[.)])\s+(.*)")
ROW = re.compile(r"\|(.*)\|\s*$")
RULE = re.compile(r"[\s|:-]+$")
FENCE = "```"
CODE = re.compile(r"(?: {4}|\t)(.*)")

WITHIN = re.compile(
    r"(?P<tick>`+)(?P<code>.+?)(?P=tick)(?!`)"
    r"|\*\*(?P<bold>.+?)\*\*"
    r"|(?<![\w*])\*(?P<italic>[^\s*][^*]*?)\*(?![\w*])"
    r"|!?\[(?P<link>[^\]]*)\]\([^)]*\)"
)


def blocks(text: str) -> list[Data]:
    """Return the blocks of a text in their order."""
    found: list[Data] = []
    lines = plain(text).split("\n")
    at = 0
    while at < len(lines):
        end, block = _block(lines, at)
        if block is not None:
            found.append(block)
        at = end
    return found


def _block(lines: Sequence[str], at: int) -> tuple[int, Data | None]:
    """Return where the block at a line ends, and the block; none where the line is empty."""
    line = lines[at]
    heading = HEADING.match(line)
    if not line.strip():
        return at + 1, None
    if heading:
        return at + 1, {"kind": "heading", "level": len(heading[1]), "runs": runs(heading[2])}
    if line.startswith(FENCE):
        end = next((k for k in range(at + 1, len(lines)) if lines[k].startswith(FENCE)), len(lines))
        return end + 1, {"kind": "code", "text": "\n".join(lines[at + 1 : end])}
    for kind, make in ((CODE, _code), (ROW, _table), (ITEM, _list)):
        if kind.match(line):
            return make(lines, at)
    end = at + 1
    while end < len(lines) and not _begins(lines[end]):
        end += 1
    return end, {"kind": "paragraph", "runs": runs(" ".join(each.strip() for each in lines[at:end]))}


def _begins(line: str) -> bool:
    """Return whether a line ends a paragraph above it."""
    patterns = (HEADING, ROW, ITEM)
    return not line.strip() or line.startswith(FENCE) or any(each.match(line) for each in patterns)


def _code(lines: Sequence[str], at: int) -> tuple[int, Data]:
    end = at
    while end < len(lines) and (CODE.match(lines[end]) or not lines[end].strip()):
        end += 1
    shown = [found[1] if (found := CODE.match(each)) else "" for each in lines[at:end]]
    return end, {"kind": "code", "text": "\n".join(shown).rstrip()}


def _table(lines: Sequence[str], at: int) -> tuple[int, Data]:
    end = at
    while end < len(lines) and ROW.match(lines[end]):
        end += 1
    rows = [_cells(each) for each in lines[at:end] if not RULE.match(each)]
    width = max(map(len, rows), default=0)
    filled = [[*row, *([[]] * (width - len(row)))] for row in rows]
    return end, {
        "kind": "table",
        "rows": filled,
        "widths": [_width(each) for each in zip(*filled, strict=True)],
    }


LEAST, MOST = 8, 48
"""Letters between which columns share a line by their longest cell."""


def _width(column: Sequence[list[Run]]) -> int:
    longest = max(sum(len(words) for words, _ in cell) for cell in column)
    return min(max(longest, LEAST), MOST)


def _cells(line: str) -> list[list[Run]]:
    inside = line.strip().removeprefix("|").removesuffix("|")
    return [runs(each.strip().replace(r"\|", "|")) for each in re.split(r"(?<!\\)\|", inside)]


def _list(lines: Sequence[str], at: int) -> tuple[int, Data]:
    """Return a list: a line that is indented goes on with its item."""
    items: list[list[str]] = []
    end = at
    while end < len(lines):
        item = ITEM.match(lines[end])
        if item:
            items.append([item[2]])
        elif lines[end].startswith(" ") and lines[end].strip():
            items[-1].append(lines[end].strip())
        else:
            break
        end += 1
    first = ITEM.match(lines[at])
    numbered = first is not None and first[1] is not None
    return end, {"kind": "list", "numbered": numbered, "items": [runs(" ".join(each)) for each in items]}


def runs(text: str) -> list[Run]:
    """Return a line as words and how they stand, neighbours that stand alike in one."""
    return [
        ("".join(words for words, _ in group), kind)
        for kind, group in groupby(_runs(text), key=lambda each: each[1])
    ]


def _runs(text: str) -> Iterator[Run]:
    at = 0
    for found in WITHIN.finditer(text):
        if found.start() > at:
            yield text[at : found.start()], "plain"
        kind = found.lastgroup or ""
        if kind == "code":
            yield found["code"], "code"
        else:
            outer = "plain" if kind == "link" else kind
            yield from ((words, own if own != "plain" else outer) for words, own in runs(found[kind]))
        at = found.end()
    if at < len(text):
        yield text[at:], "plain"
