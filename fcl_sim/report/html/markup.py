"""Elements → HTML: a text of a user becomes text, never markup."""

from collections.abc import Iterable
from html import escape

EMPTY = frozenset({"br", "col", "input", "link", "meta"})
"""Elements without an end."""


class Markup(str):
    """HTML that is whole and safe as it is."""

    __slots__ = ()


Child = str | Iterable["Child"] | None
Attribute = str | int | float | bool | None


def element(name: str, /, *children: Child, **attributes: Attribute) -> Markup:
    """Return an element; children that are no markup are escaped, None is left out.

    An attribute `class_` is `class`, `data_run` is `data-run`; True gives its
    name alone, None and False leave it out.
    """
    head = "".join([name, *(_attribute(key, value) for key, value in attributes.items())])
    if name in EMPTY:
        return Markup(f"<{head}>")
    return Markup(f"<{head}>{joined(*children)}</{name}>")


def joined(*children: Child) -> Markup:
    """Return children one after the other."""
    return Markup("".join(_text(each) for each in children))


def prose(text: str) -> Markup:
    """Return a text in which what stands between two backticks is code; a lone backtick is itself."""
    parts = text.split("`")
    if len(parts) % 2 == 0 or "" in parts[1::2]:
        return joined(text)
    return joined(*(element("code", each) if at % 2 else each for at, each in enumerate(parts)))


def _text(child: Child) -> str:
    if child is None or isinstance(child, Markup):
        return child or ""
    if isinstance(child, str):
        return escape(child, quote=False)
    return "".join(_text(each) for each in child)


def _attribute(key: str, value: Attribute) -> str:
    name = key.rstrip("_").replace("_", "-")
    if value is None or value is False:
        return ""
    return f" {name}" if value is True else f' {name}="{escape(str(value))}"'
