"""Where each character of a TOML string stands in the text, behind escapes, folded lines and quotes."""

import re

from fcl_sim.diagnostics import Span

TRIPLE = 3

_BASIC = re.compile(
    r"""\\u[0-9a-fA-F]{4} | \\U[0-9a-fA-F]{8} | \\x[0-9a-fA-F]{2}
      | (?P<fold>\\[ \t]*\r?\n[ \t\r\n]*) | \\. | \r\n | .""",
    re.VERBOSE | re.DOTALL,
)
_LITERAL = re.compile(r"\r\n|.", re.DOTALL)


def offsets(span: Span, value: str) -> tuple[int, ...]:
    """Return for each character of a string, and for its end, the offset in the source.

    `span` is where the string stands, quotes included; `value` what tomllib
    read. Of what is no string in a text, all stand at the beginning of `span`.
    """
    text = span.text
    quote = text[:1]
    if quote not in {'"', "'"}:
        return (span.start,) * (len(value) + 1)
    width = TRIPLE if len(text) >= 2 * TRIPLE and text.startswith(quote * TRIPLE) else 1
    begin, end = width, len(text) - width
    if width == TRIPLE:
        begin += len(re.match(r"\r?\n|", text[begin:])[0])  # type: ignore[index]  # it always matches
    pattern = _BASIC if quote == '"' else _LITERAL
    starts = [each.start() for each in pattern.finditer(text, begin, end) if each.lastgroup != "fold"]
    found = tuple(span.start + at for at in (*starts, end))
    return found if len(found) == len(value) + 1 else (span.start,) * (len(value) + 1)
