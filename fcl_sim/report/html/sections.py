"""What the page tells in words and tables: verdicts, scenarios, rule bases. It needs no script."""

from collections.abc import Sequence
from typing import Any

from fcl_sim.report import baselines, beside, summary
from fcl_sim.report.constant_rows import block_rows, plant_rows
from fcl_sim.report.content import facts_of, paragraphs, requirement_rows, run_text, run_title
from fcl_sim.report.coverage_matrix import matrix
from fcl_sim.report.envelopes import envelope_rows, envelope_text
from fcl_sim.report.html.markup import Child, Markup, element, joined, prose
from fcl_sim.report.rule_bases import Base
from fcl_sim.report.setting import setup_of
from fcl_sim.report.words import one_line, plain, with_unit
from fcl_sim.testbench import Outcome, Run
from fcl_sim.verify.coverage import Coverage

Row = Sequence[Child]

COLOURS = {"PASS": "good", "FAIL": "bad", "FAULT": "bad", summary.EXPECTED_MISS: "meant"}
"""Classes of verdicts; the others are doubtful."""


def badge(status: str) -> Markup:
    """Return a verdict, as a word on a colour."""
    return element("span", status, class_=f"badge {COLOURS.get(status, 'doubtful')}")


def table(headings: Sequence[str], rows: Sequence[Row], caption: str = "", kind: str = "") -> Markup:
    """Return a table whose first cells are the headings of their rows; wide ones can be scrolled."""
    head = element("tr", [element("th", each, scope="col") for each in headings])
    body = [
        element(
            "tr",
            [
                element("th", cell, scope="row") if at == 0 else element("td", cell)
                for at, cell in enumerate(row)
            ],
        )
        for row in rows
    ]
    return _scrolled(
        element(
            "table",
            element("caption", caption) if caption else None,
            element("thead", head),
            element("tbody", body),
            class_=kind or None,
        ),
        caption or headings[0],
    )


def _scrolled(made: Markup, label: str) -> Markup:
    return element("div", made, class_="wide", tabindex="0", role="group", aria_label=label)


def facts(rows: Sequence[dict[str, Any]]) -> Markup:
    """Return labels, each with its values."""
    pairs = [
        joined(
            element("dt", row["label"]),
            [element("dd", each, class_="code" if row["mono"] else None) for each in row["values"]],
        )
        for row in rows
    ]
    return element("dl", pairs, class_="facts")


def overview(outcomes: Sequence[Outcome]) -> Markup:
    """Return every run with its verdict, the scenarios linked."""
    bodies = []
    for number, outcome in enumerate(outcomes):
        runs = list(outcome.variants.values())
        link = element("a", one_line(outcome.scenario.title), href=f"#s{number}")
        rows = [
            element(
                "tr",
                element("th", link, scope="rowgroup", rowspan=len(runs)) if at == 0 else None,
                element("td", one_line(run.variant)),
                element("td", summary.run_tally(run)),
                element("td", badge(str(run.verdict))),
            )
            for at, run in enumerate(runs)
        ]
        bodies.append(element("tbody", rows))
    head = [element("th", each, scope="col") for each in ("Scenario", "Run", "Requirements", "Verdict")]
    made = element("table", element("thead", element("tr", head)), bodies, class_="overview")
    return _scrolled(made, "All runs")


def contents(outcomes: Sequence[Outcome], bases: Sequence[Base]) -> Markup:
    """Return the list of sections, each scenario with its verdict."""
    scenarios = [
        element(
            "li",
            element("a", one_line(each.scenario.title), href=f"#s{number}"),
            " ",
            badge(str(each.verdict)),
        )
        for number, each in enumerate(outcomes)
    ]
    rules = [
        element("li", element("a", _base_title(each), href=f"#r{number}"))
        for number, each in enumerate(bases)
    ]
    return element(
        "nav",
        element("a", "Verdict", href="#top"),
        element("ol", scenarios),
        element("ol", rules),
        aria_label="Contents",
        class_="contents",
    )


def scenario(outcome: Outcome, number: int, data: str) -> Markup:
    """Return the section of a scenario; `data` is what the script draws in it."""
    runs = list(outcome.variants.values())
    title = one_line(outcome.scenario.title)
    return element(
        "section",
        element("h2", title, " ", badge(str(outcome.verdict))),
        element("p", summary.sentence_of_runs(runs), class_="tally"),
        [element("p", prose(each)) for each in paragraphs(outcome.scenario.description)],
        _requirements(outcome),
        element("div", class_="explorer", data_name=outcome.scenario.name),
        element("script", Markup(data), type="text/plain", class_="pack"),
        _further(outcome, runs),
        class_="scenario",
        id=f"s{number}",
    )


def _requirements(outcome: Outcome) -> Markup | None:
    rows = requirement_rows(outcome)
    if not rows:
        return element("p", "Nothing is asked of these runs.", class_="tally")
    head = [element("th", each, scope="col") for each in ("Requirement", "Run", "Measured", "Verdict")]
    bodies = [_requirement(each) for each in rows]
    made = element("table", element("thead", element("tr", head)), bodies, class_="requirements")
    return _scrolled(made, "Requirements")


def _requirement(row: dict[str, Any]) -> Markup:
    metric, definition = row["metric"], row["definition"]
    about = element(
        "th",
        element("b", row["id"]),
        " ",
        prose(row["text"]),
        element(
            "span",
            prose(f"{metric[:1].upper()}{metric[1:]} of {row['signal']}: "),
            element("b", row["bound"]),
            class_="asked",
        ),
        element("span", prose(definition), class_="definition"),
        scope="rowgroup",
        rowspan=len(row["results"]),
    )
    lines = [
        element(
            "tr",
            about if at == 0 else None,
            element(
                "td",
                result["run"],
            ),
            element("td", result["value"], class_="number"),
            element(
                "td",
                badge(result["status"]),
                element("small", prose(result["note"])) if result["note"] else None,
                _jump(result),
            ),
        )
        for at, result in enumerate(row["results"])
    ]
    return element("tbody", lines)


def _jump(result: dict[str, Any]) -> Markup | None:
    """Return what shows the instant at which a run first violates a requirement; it needs the script."""
    time = result["from"]
    if time is None:
        return None
    at, run = with_unit(time, "s", 9), result["run"]
    return element(
        "button",
        f"Show {at}",
        type="button",
        class_="jump",
        data_run=run,
        data_time=repr(time),
        aria_label=f"Show {run} at {at}",
    )


def _further(outcome: Outcome, runs: Sequence[Run]) -> Markup:
    """Return what is told below the signals: the set-up, the runs, baselines, an older version, envelopes."""
    told = [(run_title(outcome, run), run_text(outcome, run)) for run in runs]
    return joined(
        _details("How it is set up", facts(facts_of(outcome)), _constants(outcome)),
        _details(
            "How the runs differ",
            [element("p", element("b", head), ". ", text) for head, text in told if text],
        ),
        _baselines(outcome, runs),
        _older(outcome),
        [_envelope(run) for run in runs],
    )


PLANT = ("Plant", "Value", "What it is", "Where it is from", "Limits")
BLOCKS = ("Block", "Type", "Set to", "As its type has it")


def _constants(outcome: Outcome) -> Markup:
    """Return the values of the plant and of the blocks in the base run."""
    diagram = outcome.base.diagram
    plant = [
        [
            f"{row['name']}{' at the start' if row['kind'] == 'start' else ''}",
            row["value"],
            row["meaning"],
            row["source"],
            row["limits"],
        ]
        for row in plant_rows(diagram.plant, setup_of(outcome, outcome.base))
    ]
    blocks = [[row["name"], row["type"], "; ".join(row["given"]), row["left"]] for row in block_rows(diagram)]
    return joined(
        table(PLANT, plant, kind="constants") if plant else None,
        table(BLOCKS, blocks, kind="constants") if blocks else None,
    )


def _details(title: str, *children: Child, is_open: bool = False) -> Markup | None:
    body = joined(*children)
    return element("details", element("summary", title), body, open=is_open) if body else None


CHANGES = ("Run", "Figure", "Before", "Now", "Change", "Verdict")


def _changed(rows: Sequence[beside.Beside]) -> Markup:
    cells = [
        [one_line(each) for each in (row.run, row.about, row.old, row.new, row.change, row.verdict)]
        for row in rows
    ]
    return table(CHANGES, cells, kind="changes")


def _baselines(outcome: Outcome, runs: Sequence[Run]) -> Markup | None:
    rows = list(beside.baseline_rows(outcome))
    causes = [element("p", each) for each in baselines.cause_texts(runs)]
    return _details("Beside the baselines", _changed(rows), causes, is_open=True) if rows else None


def _older(outcome: Outcome) -> Markup | None:
    if outcome.against is None:
        return None
    rows = list(beside.against_rows(outcome))
    body = _changed(rows) if rows else element("p", "Every figure is what it was.")
    return _details(f"Against {one_line(outcome.against.label)}", body, is_open=True)


def _envelope(run: Run) -> Markup | None:
    if run.envelope is None:
        return None
    rows = [
        [
            row["id"],
            [row["asked"], element("small", prose(row["reason"])) if row["reason"] else None],
            row["passed"],
            row["worst"],
            badge(row["status"]),
        ]
        for row in envelope_rows(run.envelope)
    ]
    return _details(
        f"Envelope of run {one_line(run.variant)}",
        element("p", envelope_text(run, run.envelope)),
        table(("Requirement", "Asked", "Passed", "Worst", "Verdict"), rows, kind="envelope"),
    )


def _base_title(base: Base) -> str:
    return f"Rule base {one_line(base.node.block.name)}"


def rule_base(base: Base, number: int, covered: Coverage | None) -> Markup:
    """Return the section of a rule base: its file, how far its rules were exercised, its text."""
    rows = [
        {"label": "File", "values": [base.file.name], "mono": True},
        {"label": "SHA-256", "values": [base.file.digest], "mono": True},
        {"label": "Used by", "values": [", ".join(map(one_line, base.records))], "mono": False},
    ]
    return element(
        "section",
        element("h2", _base_title(base)),
        facts(rows),
        None if covered is None else _coverage(covered),
        _details("The text", element("pre", plain(base.file.text).rstrip(), tabindex="0")),
        class_="base",
        id=f"r{number}",
    )


def _coverage(covered: Coverage) -> Markup:
    made = matrix(covered)
    rows = [
        [
            row["label"],
            row["text"],
            *(
                element("span", cell["share"], class_="open" if cell["open"] else None)
                for cell in row["cells"]
            ),
            " ".join(filter(None, (row["first"], row["remark"]))),
        ]
        for row in made["rows"]
    ]
    return joined(
        element("p", made["summary"]),
        table(("Rule", "Text", *made["items"], "First fired"), rows, kind="coverage"),
        [element("p", each, class_="note") for each in [*made["notes"], made["meaning"]]],
    )
