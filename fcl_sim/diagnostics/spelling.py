"""Nearest names, for hints."""

from collections.abc import Iterable
from difflib import get_close_matches


def nearest(name: str, known: Iterable[str]) -> str | None:
    """Return the known name most like `name`, letter case ignored, or None when none is near.

    A name that ends or begins like a known one counts as near: `pos_big` is
    near `pos_high` because a slip of one word among several is the common one.
    """
    by_fold = {each.casefold(): each for each in known}
    folded = name.casefold()
    if folded in by_fold:
        return by_fold[folded]
    close = get_close_matches(folded, by_fold, n=1, cutoff=0.6)
    return by_fold[close[0]] if close else None


def listed(names: Iterable[str]) -> str:
    """Return names as a reader wants them: `a, b or c`; long lists are cut after eight."""
    all_names = list(names)
    shown = all_names[:8]
    rest = len(all_names) - len(shown)
    if rest:
        return ", ".join(shown) + f" … ({rest} more)"
    if len(shown) < 2:
        return "".join(shown)
    return ", ".join(shown[:-1]) + " or " + shown[-1]
