"""Where every key and value of a TOML text stands: tomllib reads it, but does not say.

The scanner takes a text that tomllib has accepted, so it finds its way by the
few characters that TOML's grammar leaves no choice about.
"""

import tomllib
from dataclasses import dataclass

from fcl_sim.diagnostics import Source, Span

KeyPath = tuple[str | int, ...]
"""Keys from the top of a document; an integer is the place in an array, from 0."""

BLANK = " \t\r\n"
TRIPLE = 3
ENDS_BARE_VALUE = ",]}#\n"


@dataclass(frozen=True, slots=True)
class Position:
    """Where a key stands, and what it is given; of a table, its header or first key."""

    key: Span
    value: Span


def positions(source: Source) -> dict[KeyPath, Position]:
    """Return the position of every key path of a TOML document, tables and array elements included.

    The text must be TOML: run it through tomllib first.
    """
    scanner = _Scanner(source)
    scanner.document()
    return scanner.found


class _Scanner:
    """A place in the text, and what was found up to there."""

    def __init__(self, source: Source) -> None:
        self.source = source
        self.text = source.text
        self.at = 0
        self.found: dict[KeyPath, Position] = {}
        self.lengths: dict[KeyPath, int] = {}

    def document(self) -> None:
        prefix: KeyPath = ()
        self.skip_blank()
        while self.at < len(self.text):
            if self.text[self.at] == "[":
                prefix = self.header()
            else:
                self.pair(prefix)
            self.skip_blank()

    def skip_blank(self) -> None:
        """Skip white space, line ends and comments."""
        while self.at < len(self.text):
            if self.text[self.at] == "#":
                end = self.text.find("\n", self.at)
                self.at = len(self.text) if end < 0 else end
            elif self.text[self.at] in BLANK:
                self.at += 1
            else:
                return

    def header(self) -> KeyPath:
        """Scan [a.b] or [[a.b]]; return the path of the table that it opens."""
        is_array = self.text.startswith("[[", self.at)
        self.at += 2 if is_array else 1
        path: KeyPath = ()
        keys = self.keys()
        for index, (name, span) in enumerate(keys):
            path = (*path, name)
            if is_array and index == len(keys) - 1:
                self.lengths[path] = self.lengths.get(path, 0) + 1
            self.found.setdefault(path, Position(span, span))
            if path in self.lengths:
                path = (*path, self.lengths[path] - 1)
                self.found.setdefault(path, Position(span, span))
        self.at += 2 if is_array else 1
        return path

    def pair(self, prefix: KeyPath) -> None:
        """Scan a.b = value."""
        path = prefix
        keys = self.keys()
        for name, span in keys:
            path = (*path, name)
            self.found.setdefault(path, Position(span, span))
        self.at += 1
        self.skip_blank()
        self.found[path] = Position(keys[-1][1], self.value(path))

    def keys(self) -> list[tuple[str, Span]]:
        """Scan a . "b" . 'c', and stop at what follows."""
        keys = []
        while True:
            self.skip_blank()
            start = self.at
            if self.text[start] in "\"'":
                self.string()
            else:
                while self.text[self.at] not in " \t.=]":
                    self.at += 1
            span = Span(self.source, start, self.at)
            keys.append((_decoded(span.text), span))
            self.skip_blank()
            if self.text[self.at] != ".":
                return keys
            self.at += 1

    def value(self, path: KeyPath) -> Span:
        """Scan any value; return where it stands."""
        start = self.at
        first = self.text[start]
        if first in "\"'":
            self.string()
        elif first == "[":
            self.array(path)
        elif first == "{":
            self.inline_table(path)
        else:
            while self.at < len(self.text) and self.text[self.at] not in ENDS_BARE_VALUE:
                self.at += 1
            while self.text[self.at - 1] in BLANK:
                self.at -= 1
        return Span(self.source, start, self.at)

    def string(self) -> None:
        """Scan any of the four kinds of string."""
        quote = self.text[self.at]
        escapes = quote == '"'
        if self.text.startswith(quote * TRIPLE, self.at):
            self.at += TRIPLE
            self.skip_to(quote * TRIPLE, escapes)
            while self.text.startswith(quote, self.at):  # up to two quotes may stand before the closing three
                self.at += 1
        else:
            self.at += 1
            self.skip_to(quote, escapes)

    def skip_to(self, closing: str, escapes: bool) -> None:  # noqa: FBT001
        while not self.text.startswith(closing, self.at):
            self.at += 2 if escapes and self.text[self.at] == "\\" else 1
        self.at += len(closing)

    def array(self, path: KeyPath) -> None:
        self.at += 1
        index = 0
        self.skip_blank()
        while self.text[self.at] != "]":
            span = self.value((*path, index))
            self.found[(*path, index)] = Position(span, span)
            index += 1
            self.skip_separator()
        self.at += 1

    def inline_table(self, path: KeyPath) -> None:
        self.at += 1
        self.skip_blank()
        while self.text[self.at] != "}":
            self.pair(path)
            self.skip_separator()
        self.at += 1

    def skip_separator(self) -> None:
        self.skip_blank()
        if self.text[self.at] == ",":
            self.at += 1
            self.skip_blank()


def _decoded(key: str) -> str:
    if "\\" in key:
        return next(iter(tomllib.loads(f"{key} = 0")))
    return key[1:-1] if key[0] in "\"'" else key
