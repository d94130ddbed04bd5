"""Nearest names, for hints."""

from collections.abc import Iterable
from difflib import get_close_matches

LIKENESS = 0.6
"""Share of letters in common, in the same order, from which on one name may stand for another."""

LISTED_NAMES = 8


def nearest(name: str, known: Iterable[str]) -> str | None:
    """Return the known name most like `name`, letter case ignored, or None when none is near.

    Of names that share a word with it, the one with most letters in common is
    taken: for `pos_big` that is `pos_high`, not `pos_medium`.
    """
    by_fold = {each.casefold(): each for each in known}
    folded = name.casefold()
    if folded in by_fold:
        return by_fold[folded]
    close = get_close_matches(folded, by_fold, n=1, cutoff=LIKENESS)
    return by_fold[close[0]] if close else None


def listed(names: Iterable[str]) -> str:
    """Return names as a reader wants them: `a, b or c`; long lists are cut after eight."""
    all_names = list(names)
    shown = all_names[:LISTED_NAMES]
    rest = len(all_names) - len(shown)
    if rest:
        return ", ".join(shown) + f" … ({rest} more)"
    if len(shown) < 2:
        return "".join(shown)
    return ", ".join(shown[:-1]) + " or " + shown[-1]
