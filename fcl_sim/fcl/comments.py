"""Comments and the statements that they describe: what the writer takes from a text beside its model."""

from bisect import bisect_right
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

from fcl_sim.diagnostics import Source, Span
from fcl_sim.fcl.outline import Statement, outline
from fcl_sim.fcl.tokens import Comment, Scan
from fcl_sim.fcl.tree import Tree


@dataclass(frozen=True, slots=True, kw_only=True)
class Remark:
    """A comment to be written back: its text, and in which column (from 0) it stood.

    `blank` says that a blank line was before it, `below` that it goes on with a
    comment behind a statement, on a line of its own.
    """

    text: str
    column: int
    blank: bool = False
    below: bool = False

    @property
    def is_line(self) -> bool:
        """Whether it stands on one line."""
        return "\n" not in self.text


@dataclass(slots=True)
class Remarks:
    """The comments above a statement and behind it; `blank` says that a blank line was right before it."""

    above: list[Remark] = field(default_factory=list)
    behind: list[Remark] = field(default_factory=list)
    blank: bool = False


class Comments:
    """The comments of one text, each with its statement.

    A comment belongs to the statement on whose last line it begins, else to the
    one that follows; one inside of a statement goes above it.
    """

    def __init__(self, source: Source, statements: Sequence[Statement]) -> None:
        self.source = source
        self.statements = statements
        self.of = [Remarks() for _ in statements]
        """Of each statement."""
        self.last: list[Remark] = []
        """Behind the last statement."""
        self._starts = [each.start for each in statements]
        self._keyed = {(each.section, each.key): n for n, each in enumerate(statements) if each.key}

    def number(self, span: Span | None) -> int | None:
        """Return the number of the statement that a node of the model comes from, None for another text."""
        if span is None or span.source is not self.source or not self.statements:
            return None
        return max(0, bisect_right(self._starts, span.start) - 1)

    def section(self, span: Span | None) -> int | None:
        """Return the number of the section that a node of the model comes from."""
        number = self.number(span)
        return None if number is None else self.statements[number].section

    def part(self, span: Span | None, key: str) -> int | None:
        """Return the number of the statement `key` in the section that a node of the model comes from."""
        section = self.section(span)
        return None if section is None else self._keyed.get((section, key))

    def numbers(self, key: str) -> list[int]:
        """Return the numbers of all statements `key`, in the order of the text."""
        return [n for n, each in enumerate(self.statements) if each.key == key]


NO_COMMENTS = Comments(Source("", ""), ())
"""Of a model that comes from no text."""


def gather_comments(scan: Scan, tree: Tree) -> Comments:
    """Return the comments of a text that was read without an error."""
    comments = Comments(scan.source, outline(scan, tree))
    ends: list[int] = []
    for comment in _outside(scan.comments, tree):
        _attach(comments, comment, ends[-1] if ends else 0)
        ends.append(comment.start + len(comment.text))
    text = scan.source.text
    for number, statement in enumerate(comments.statements):
        at = bisect_right(ends, statement.start) - 1
        before = max(ends[at] if at >= 0 else 0, comments.statements[number - 1].end if number else 0)
        comments.of[number].blank = _is_blank(text[before : statement.start])
    return comments


def _outside(comments: Sequence[Comment], tree: Tree) -> Iterator[Comment]:
    """Yield the comments that are not part of something verbatim: options, and text that is not FCL."""
    verbatim = sorted((each.start, each.end) for each in tree.verbatim)
    for comment in comments:
        at = bisect_right(verbatim, (comment.start, len(tree.source.text))) - 1
        if at < 0 or comment.start >= verbatim[at][1]:
            yield comment


def _attach(comments: Comments, comment: Comment, last: int) -> None:
    """Give a comment to its statement; `last` is the offset behind the comment before it."""
    text = comments.source.text
    start, statements = comment.start, comments.statements
    here = comments.number(Span(comments.source, start, start))
    if here is not None and statements[here].start > start:
        here = None
    if here is not None and start < statements[here].end:
        comments.of[here].above.append(_remark(text, comment))
        return
    before = max(last, statements[here].end if here is not None else 0)
    if here is not None:
        behind = comments.of[here].behind
        if "\n" not in text[statements[here].end : start]:
            behind.append(_remark(text, comment))
            return
        if behind and before == last and _goes_on(text, behind[-1], comment, last):
            behind.append(_remark(text, comment, below=True))
            return
    following = 0 if here is None else here + 1
    above = comments.of[following].above if following < len(statements) else comments.last
    above.append(_remark(text, comment, blank=_is_blank(text[before:start])))


def _goes_on(text: str, behind: Remark, comment: Comment, last: int) -> bool:
    """Return whether a comment stands right below one behind a statement, in its column."""
    line_end = text.find("\n", comment.start)
    rest = text[comment.start + len(comment.text) : line_end if line_end >= 0 else len(text)]
    is_alone = "\n" not in comment.text and not rest.strip()
    is_next = text.count("\n", last, comment.start) == 1
    return is_alone and is_next and behind.is_line and behind.column == _column(text, comment.start)


def _remark(text: str, comment: Comment, *, blank: bool = False, below: bool = False) -> Remark:
    first, *others = (each.rstrip() for each in comment.text.split("\n"))
    lines = [each.lstrip() and each.expandtabs() for each in others]
    if first[0] in "#%":
        first = f"//{first[1:]}"
    column = _column(text, comment.start)
    return Remark(text="\n".join((first, *lines)), column=column, blank=blank, below=below)


def _column(text: str, start: int) -> int:
    line = text[text.rfind("\n", 0, start) + 1 : start]
    return len(line.lstrip("\ufeff").expandtabs())


def _is_blank(space: str) -> bool:
    """Return whether there is a blank line in what stands between two words."""
    return space.count("\n") > 1
