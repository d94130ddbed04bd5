"""Statements and their comments → lines of text."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from fcl_sim.fcl.comments import Comments, Remark, Remarks

WIDTH = 110
"""In characters; what cannot be divided may be longer."""
INDENT = 4


@dataclass(frozen=True, slots=True, kw_only=True)
class Line:
    """A statement to be written, of one line or several, each `indent` blanks further in.

    `number` is that of the statement in the text whose comments go with it;
    those above are `inner` blanks further in than the statement. `blank` says
    that a blank line stands before it, None that one does where the text has
    one.
    """

    code: tuple[str, ...]
    indent: int = 0
    inner: int = 0
    number: int | None = None
    blank: bool | None = None


def text_of(lines: Sequence[Line], comments: Comments) -> str:
    """Return the text of statements with every comment; line feeds end the lines."""
    remarks, last = _placed(lines, comments)
    out: list[str] = []
    for run in _runs(lines, remarks):
        column = _column(run, lines, remarks)
        for at in run:
            opens = at == 0 or lines[at - 1].indent < lines[at].indent + lines[at].inner
            above = list(_above(lines[at], remarks[at], opens=opens))
            out += above[1:] if not out and above[:1] == [""] else above
            out += _with_behind(lines[at], remarks[at].behind, column)
    if last:
        out += [""] * bool(out)
        out += _own_lines(last, 0)
    return "".join(f"{each}\n" for each in out)


def _placed(lines: Sequence[Line], comments: Comments) -> tuple[list[Remarks], list[Remark]]:
    """Return the comments of each line, and those behind all of them.

    What belongs to a statement that is not written goes to the next one of the
    text that is; what stands behind one that has become several goes above the
    first of them.
    """
    written: dict[int, list[int]] = {}
    for at, line in enumerate(lines):
        if line.number is not None:
            written.setdefault(line.number, []).append(at)
    placed = [Remarks() for _ in lines]
    homeless: list[Remark] = []
    for number, found in enumerate(comments.of):
        if number not in written:
            homeless += [*found.above, *found.behind]
            continue
        first, *others = written[number]
        placed[first].blank = found.blank
        placed[first].above = [*homeless, *found.above, *(found.behind if others else ())]
        placed[first].behind = [] if others else found.behind
        homeless = []
    return placed, homeless + comments.last


# -- what stands above


def _above(line: Line, remarks: Remarks, *, opens: bool) -> Iterator[str]:
    """Yield the lines before a statement; `opens` says that it is the first of its section."""
    was_blank = remarks.above[0].blank if remarks.above else remarks.blank and line.blank is None
    if line.blank or (was_blank and not opens):
        yield ""
    yield from _own_lines(remarks.above, line.indent + line.inner)
    if remarks.above and remarks.blank and not line.inner:
        yield ""


def _own_lines(remarks: Sequence[Remark], indent: int) -> Iterator[str]:
    for at, remark in enumerate(remarks):
        if at and remark.blank:
            yield ""
        yield " " * indent + _shifted(remark, indent)


def _shifted(remark: Remark, column: int) -> str:
    """Return a comment whose first line now begins at `column`; the others keep their distance to it."""
    first, *others = remark.text.split("\n")
    by = column - remark.column
    indents = [len(each) - len(each.lstrip(" ")) for each in others if each]
    if by + min(indents, default=0) < 0:
        return remark.text
    margin = " " * by
    moved = [each and (margin + each if by > 0 else each[-by:]) for each in others]
    return "\n".join((first, *moved))


# -- what stands behind


def _runs(lines: Sequence[Line], remarks: Sequence[Remarks]) -> Iterator[list[int]]:
    """Yield the places of lines, together where the comments behind them stand in one column."""
    run: list[int] = []
    for at, line in enumerate(lines):
        found = remarks[at]
        is_part = len(line.code) == 1 and found.behind != [] and all(each.is_line for each in found.behind)
        joins = run and not found.above and not (line.blank or found.blank)
        if run and not (is_part and joins and line.indent == lines[run[-1]].indent):
            yield run
            run = []
        run.append(at)
        if not is_part:
            yield run
            run = []
    if run:
        yield run


def _column(run: Sequence[int], lines: Sequence[Line], remarks: Sequence[Remarks]) -> int:
    """Return the column in which the comments behind some lines begin, 0 where they find no common one."""
    column = max(lines[at].indent + len(lines[at].code[0].expandtabs()) for at in run) + 1
    widest = max(sum(len(each.text) + 1 for each in remarks[at].behind) for at in run)
    return column if len(run) > 1 and column + widest - 1 <= WIDTH else 0


def _with_behind(line: Line, behind: Sequence[Remark], column: int) -> list[str]:
    """Return a statement and the comments behind it."""
    out = [" " * line.indent + each for each in line.code]
    for at, remark in enumerate(behind):
        if at == 0:
            column = max(column, len(out[-1].expandtabs()) + 1)
            out[-1] += " " * (column - len(out[-1].expandtabs()))
        elif remark.below:
            out.append(" " * column)
        else:
            out[-1] += " "
        out[-1] += _shifted(remark, len(out[-1].expandtabs()))
    return out
