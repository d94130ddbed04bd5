"""Pages as people read them: on a terminal, and in Markdown."""

import re
from collections.abc import Iterator
from itertools import groupby
from textwrap import fill, indent

from fcl_sim.diagnostics.codes import CODES
from fcl_sim.diagnostics.page import FAMILIES, Page, family

TEXT_WIDTH = 100

_PLACES = {"RULE": "among the rules", "scenario": "in a scenario", "controller": "in a controller file"}
_READING = re.compile(r"\b(S\d)")


def page_text(page: Page) -> str:
    """Return a page in plain text."""
    return "\n".join(
        (
            f"{page.code}: {page.title}",
            _about(page),
            "",
            fill(page.means, TEXT_WIDTH),
            "",
            fill(page.why, TEXT_WIDTH),
            "",
            f"{_heading('Wrong', page)}:",
            "",
            indent(page.bad, "    "),
            "",
            "Mended:",
            "",
            indent(page.mended, "    "),
        )
    )


def page_markdown(page: Page) -> str:
    """Return a page in Markdown, without a heading: it stands under one, or in a SARIF rule."""
    parts = (
        _about(page),
        page.means,
        page.why,
        f"{_heading('Wrong', page)}:",
        f"```{page.language}\n{page.bad}\n```",
        "Mended:",
        f"```{page.language}\n{page.mended}\n```",
    )
    return "\n\n".join(parts)


def list_text() -> str:
    """Return all codes with their titles, by family."""
    return "\n\n".join(
        "\n".join((title, *(f"  {code}  {CODES[code]}" for code in codes))) for title, codes in families()
    )


def families() -> Iterator[tuple[str, tuple[str, ...]]]:
    """Yield the title of each family, and its codes in order."""
    for key, codes in groupby(sorted(CODES), key=family):
        yield FAMILIES[key], tuple(codes)


def _about(page: Page) -> str:
    rule = _READING.sub(r"our reading \1", page.rule, count=1)
    return " · ".join(each for each in (page.severity, rule) if each)


def _heading(word: str, page: Page) -> str:
    if not page.within:
        return word
    return f"{word}, {_PLACES.get(page.within, f'in {page.within}')}"
