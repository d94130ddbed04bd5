"""The page: one text, with the style and the script in it and nothing from elsewhere."""

import base64
from collections.abc import Callable, Sequence
from functools import cache
from hashlib import sha256
from importlib.resources import files

from fcl_sim import __version__
from fcl_sim.report import summary
from fcl_sim.report.content import KIND, provenance_of, sentence, title_of
from fcl_sim.report.html import sections
from fcl_sim.report.html.lines import scenario_data
from fcl_sim.report.html.markup import Markup, element, joined
from fcl_sim.report.html.pack import Pack
from fcl_sim.report.rule_bases import rule_bases
from fcl_sim.report.words import one_line
from fcl_sim.testbench import Outcome
from fcl_sim.verify.coverage import Coverage

SCRIPTS = (
    "data.js",
    "numbers.js",
    "elements.js",
    "lanes.js",
    "plots.js",
    "maps.js",
    "rules.js",
    "sketch.js",
    "controls.js",
    "explorer.js",
    "main.js",
)
"""The files of the script in their order: each needs only what stands before it."""

STRETCHES = 1_500_000
"""Stretches of time into which all series of a page are parted, together."""
FEWEST, MOST = 150, 4000
"""Bounds of those of one series: as many as a screen has columns, a page of a common bench has."""

LIVE = (
    "This page follows what is saved. Envelopes and baselines are left out: fcl-sim run looks at them, too."
)

Section = Callable[[Outcome, int], Markup]
"""Returns the section of a scenario by its place."""


def page(
    outcomes: Sequence[Outcome],
    covered: Sequence[Coverage] = (),
    *,
    section: Section | None = None,
    live: int | None = None,
) -> str:
    """Return the page of outcomes, the same text for the same ones.

    `covered` is how far the runs have exercised the rule bases. `section` may
    know sections that were made before. A page with a number `live` listens at
    `events` of where it comes from, and is fetched anew when there is another.
    """
    bases = rule_bases(outcomes)
    by_file = {(each.name, each.file): each for each in covered}
    made = section or scenario_section(stretches_for(outcomes))
    body = joined(
        element("a", "To the verdict", href="#top", class_="skip"),
        sections.contents(outcomes, bases),
        element(
            "main",
            _front(outcomes, is_live=live is not None),
            [made(outcome, number) for number, outcome in enumerate(outcomes)],
            [
                sections.rule_base(base, number, by_file.get((base.node.block.name, base.file.name)))
                for number, base in enumerate(bases)
            ],
            element("footer", f"fcl_sim {__version__}"),
            id="top",
        ),
    )
    return _document(f"{summary.overall(outcomes)}: {one_line(title_of(outcomes))}", body, live=live)


def scenario_section(stretches: int) -> Section:
    """Return what makes the section of a scenario, with each series parted into so many stretches."""

    def made(outcome: Outcome, number: int) -> Markup:
        pack = Pack(stretches)
        return sections.scenario(outcome, number, pack.text(scenario_data(outcome, pack)))

    return made


def stretches_for(outcomes: Sequence[Outcome]) -> int:
    """Return into how many stretches each series is parted, so that a page stays of a reasonable size."""
    runs = [run for outcome in outcomes for run in outcome.variants.values()]
    series = sum(
        len(run.trace.names) + sum(len(each.rule_labels) for each in run.trace.fuzzy.values()) for run in runs
    )
    return min(max(STRETCHES // max(series, 1), FEWEST), MOST)


def _front(outcomes: Sequence[Outcome], *, is_live: bool) -> Markup:
    status = str(summary.overall(outcomes))
    return element(
        "header",
        element("p", KIND, class_="kind"),
        element("h1", one_line(title_of(outcomes))),
        element(
            "div",
            element("strong", status),
            element("p", sentence(outcomes)),
            class_=f"verdict {sections.COLOURS.get(status, 'doubtful')}",
        ),
        element("p", LIVE, class_="tally") if is_live else None,
        [element("p", each, class_="ending") for each in summary.endings(outcomes)],
        element(
            "noscript",
            element("p", "Without a script this page shows tables and no signals.", class_="ending"),
        ),
        sections.overview(outcomes) if outcomes else None,
        element("details", element("summary", "What was run"), sections.facts(provenance_of(outcomes))),
    )


def _document(title: str, body: Markup, *, live: int | None) -> str:
    style, script = _style(), _script()
    policy = [
        "default-src 'none'",
        f"style-src '{_digest(style)}'",
        f"script-src '{_digest(script)}'",
        "connect-src 'none'" if live is None else "connect-src 'self'",
        "base-uri 'none'",
        "form-action 'none'",
    ]
    head = joined(
        element("meta", charset="utf-8"),
        element("meta", http_equiv="Content-Security-Policy", content="; ".join(policy)),
        element("meta", name="viewport", content="width=device-width, initial-scale=1"),
        element("meta", name="color-scheme", content="light dark"),
        element("title", title),
        element("style", Markup(style)),
    )
    page_body = element("body", body, element("script", Markup(script)), data_live=live)
    return f'<!DOCTYPE html>\n<html lang="en">{element("head", head)}{page_body}</html>\n'


def _digest(text: str) -> str:
    """Return what a policy calls a text that may stand in the page."""
    return f"sha256-{base64.b64encode(sha256(text.encode()).digest()).decode()}"


@cache
def _style() -> str:
    return files(__package__).joinpath("page.css").read_text(encoding="utf-8")


@cache
def _script() -> str:
    folder = files(__package__).joinpath("script")
    parts = [folder.joinpath(name).read_text(encoding="utf-8") for name in SCRIPTS]
    return f'(() => {{\n"use strict";\n{"".join(parts)}}})();\n'
