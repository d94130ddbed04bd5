"""The words of temporal formulae and sentences, as the scanner of formulae must know them."""

from collections.abc import Mapping
from types import MappingProxyType

from fcl_sim.formula import tokens

WORDS = frozenset({"and", "or", "not", "until", "implies"})
"""The words of the language that stand between truths."""

BEHIND_NUMBERS = WORDS | {"then", "within", "for", "lasts", "before", "at", "on", "to"}
"""What may stand behind a number and is no unit."""

INSTEAD: Mapping[str, str] = MappingProxyType(
    {
        **{each: hint for each, hint in tokens.INSTEAD.items() if each != "^"},
        "&": "write `and`",
        "|": "write `or`",
        "!": "write `not`",
        "=": "write `==`, or better <= and >=",
        "→": "write `implies`",
        "≤": "write `<=`",
        "≥": "write `>=`",
        ";": "one formula is one requirement: join two by `and`",
    }
)
"""What to write in place of a character that has no meaning."""
