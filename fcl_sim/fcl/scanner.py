"""Text → tokens (IEC 61131-3 B.1.1 and B.1.2, for 5.4)."""

import re
import unicodedata
from collections.abc import Iterator

from fcl_sim.diagnostics import Source
from fcl_sim.fcl.findings import Findings
from fcl_sim.fcl.tokens import Comment, Kind, Scan, Token

_PATTERN = re.compile(
    r"""
    [\s\ufeff]*+
    (?: ([^\W\d]\w*+)(?!\#)
      | ((?:[0-9][0-9_]*+(?:\.(?!\.)[0-9_]*+)?|\.[0-9][0-9_]*+)(?:[eE][+\-]?[0-9][0-9_]*+)?)(?![\w\#]|\.\w)
      | (:=|\.\.|[:;,).=+\-^|%]|\((?!\*)|/(?![/*])|\*(?!\)))
      | (\(\*.*?(?:\*\)|\Z)|/\*.*?(?:\*/|\Z)|//[^\n]*+|\#(?:(?!END_OPTION)[^\n])*+)
      | ((?:[^\W\d]|[0-9])\w*+\#(?:[+\-](?=\w))?(?:[\w\#]|\.(?=[\w])|(?<=[eE])[+\-](?=[0-9]))*)
      | ([0-9]\w*+(?:\.\w++)*)
      | (\*\))
      | ([^\s\w\ufeff:;,().=+\-*/^|%\#]++|.)
      | \Z
    )
    """,
    re.VERBOSE | re.DOTALL,
)
"""One match is one token with the space before it. No part of it can be matched in two ways,
so scanning takes time in proportion to the text, whatever the text. Groups are not repeated
possessively: Python before 3.11.5 then loses their last character."""

_NAME, _NUMBER, _SYMBOL, _COMMENT, _LITERAL, _MIXED, _COMMENT_END, _STRAY = range(1, 9)
_KINDS = {
    _NAME: Kind.NAME,
    _NUMBER: Kind.NUMBER,
    _SYMBOL: Kind.SYMBOL,
    _LITERAL: Kind.LITERAL,
    _MIXED: Kind.MIXED,
    _COMMENT_END: Kind.STRAY,
    _STRAY: Kind.STRAY,
}

MOST_WORDS = 5
"""Words that one message names."""

_INSTEAD = {
    "−": "write the minus sign as `-`",
    "–": "write the minus sign as `-`",
    "—": "write the minus sign as `-`",
    "&": "write AND",
    "&&": "write AND",
    "!": "write NOT",
    "~": "write NOT",
    "≔": "write `:=`",
    "[": "write `(`",
    "]": "write `)`",
    "{": "write `(`; comments stand between `(*` and `*)`",
    "}": "write `)`; comments stand between `(*` and `*)`",
    "<": "FCL compares by terms: `variable IS term`",
    ">": "FCL compares by terms: `variable IS term`",
}


def scan(source: Source) -> Scan:
    """Return the tokens of a text, its comments, and what is wrong with its characters.

    Words are not judged: a keyword is a name until the parser needs it (S1a).
    """
    findings = Findings(source)
    tokens: list[Token] = []
    comments: list[Comment] = []
    for group, start, text in _words(source.text):
        if group == _COMMENT:
            comments.append(Comment(text, start))
            if text[0] in "#%":
                findings.feature("comment", f"a comment that begins with {text[0]}", comments[-1])
            if not _closed(text):
                tokens.append(_unclosed(findings, text, start))
            continue
        token = Token(_KINDS[group], text, text.upper() if group == _NAME else text, start)
        tokens.append(token)
        if group >= _COMMENT_END:
            _report_stray(findings, token)
    tokens.append(Token(Kind.END, "", "", len(source.text)))
    if not source.text.isascii():
        _report_letters(findings, tokens)
    return Scan(
        source=source,
        tokens=tuple(tokens),
        comments=tuple(comments),
        diagnostics=findings.diagnostics(),
        notes=tuple(findings.notes),
    )


def _words(text: str) -> Iterator[tuple[int, int, str]]:
    """Yield what `_PATTERN` finds: group, offset and text; a line that begins with % is a comment."""
    at = 0
    while at <= len(text):
        for match in _PATTERN.finditer(text, at):
            group = match.lastindex
            if group is None:
                return
            word, start = match[group], match.start(group)
            if word == "%" and (start == 0 or "\n" in text[match.start() : start]):
                end = text.find("\n", start)
                at = len(text) if end < 0 else end
                yield _COMMENT, start, text[start:at]
                break
            yield group, start, word
        else:
            return


def _closed(comment: str) -> bool:
    if comment[0] in "#%" or comment.startswith("//"):
        return True
    closing = "*)" if comment[0] == "(" else "*/"
    return len(comment) >= len("(**)") and comment.endswith(closing)


def _unclosed(findings: Findings, text: str, start: int) -> Token:
    opening = text[:2]
    closing = "*)" if opening == "(*" else "*/"
    token = Token(Kind.STRAY, opening, opening, start)
    findings.error(
        "FCL110",
        "this comment is not closed: everything from here to the end of the text is comment",
        token,
        hint=f"close it with `{closing}`",
    )
    return token


def _report_stray(findings: Findings, token: Token) -> None:
    if token.text == "*)":
        hint = "comments cannot be nested"
        findings.error("FCL111", "a comment ends here that does not begin anywhere", token, hint)
        return
    hint = _INSTEAD.get(token.text, "")
    findings.error("FCL112", f"{_characters(token)} has no meaning in FCL", token, hint)


def _characters(token: Token) -> str:
    if token.text.isprintable():
        return token.shown
    hidden = next(each for each in token.text if not each.isprintable())
    name = {"\0": "NUL"}.get(hidden) or unicodedata.name(hidden, "a control character")
    return f"the character U+{ord(hidden):04X} ({name})"


def _report_letters(findings: Findings, tokens: list[Token]) -> None:
    """Say once which names are not portable, each at its first place."""
    names = {
        each.key: each for each in reversed(tokens) if each.kind is Kind.NAME and not each.text.isascii()
    }
    found = sorted(names.values(), key=lambda each: each.start)
    if found:
        words = [each.shown for each in found[:MOST_WORDS]]
        others = len(found) - len(words)
        listing = ", ".join(words) + (f" and {others} more" if others else "")
        for each in found:
            message = f"letters other than A to Z in names are not portable: {listing}"
            findings.warning("FCL115", message, each)
