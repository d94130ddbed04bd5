"""The coverage of rule bases, on a terminal."""

from collections.abc import Sequence

import click
from rich.console import Console
from rich.table import Table
from rich.text import Text

from fcl_sim.diagnostics import InputFault
from fcl_sim.diagnostics.render import render
from fcl_sim.report import coverage_words as words
from fcl_sim.report.words import counted, joined
from fcl_sim.verify.coverage import Coverage, Item, RuleCoverage, waiver_findings

COLUMNS = ("rule", "", *map(str, Item), "first fired", "")
MISSING = "yellow"


def print_coverage(coverages: Sequence[Coverage], console: Console) -> None:
    """Print a table for each rule base: every rule, in how much of the scans it did what, and where first."""
    for each in coverages:
        console.print(Text(f"{each.file}: {each.name}", style="bold"))
        console.print(Text(f"{counted(len(each.runs), 'run')}, {counted(each.scans, 'scan')}"))
        console.print(_table(each))
        for note in words.notes(each):
            console.print(Text(note))
        console.print(Text(words.explained(each), style="dim"))
        console.print()


def _table(coverage: Coverage) -> Table:
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0), header_style="bold")
    remarks = [words.remark(coverage, rule) for rule in coverage.rules]
    for place, heading in enumerate(COLUMNS if any(remarks) else COLUMNS[:-1]):
        number = heading in set(Item)
        table.add_column(heading, justify="right" if number else "left", no_wrap=place != 1 or number)
    for rule, remark in zip(coverage.rules, remarks, strict=True):
        shares = [_share(coverage, rule, item) for item in Item]
        cells = [Text(rule.label), Text(rule.text), *shares, Text(words.first(rule.fired))]
        table.add_row(*cells, *([Text(remark)] if any(remarks) else []))
    return table


def _share(coverage: Coverage, rule: RuleCoverage, item: Item) -> Text:
    text = words.share(rule.seen(item), coverage.scans)
    open_ = not rule.seen(item).scans and coverage.waiver(rule, item) is None
    return Text(text, style=MISSING if open_ else "")


def check_waivers(coverages: Sequence[Coverage]) -> None:
    """Print what is unused among the waivers; InputFault where one is about a rule that does not exist."""
    files: dict[str, list[Coverage]] = {}
    for each in coverages:
        files.setdefault(each.file, []).append(each)
    findings = [one for own in files.values() for one in waiver_findings(own)]
    errors = [each for each in findings if each.is_error]
    for warning in findings:
        if not warning.is_error:
            click.echo(render(warning), err=True)
    if errors:
        raise InputFault(errors)


def met(coverages: Sequence[Coverage], item: Item) -> bool:
    """Return whether every rule has been seen to do what is required, or is waived; tell which were not."""
    for each in coverages:
        missing = [rule.label for rule in each.unmet(item)]
        if missing:
            rules = "rule" if len(missing) == 1 else "rules"
            click.echo(f"{each.file}: never {item}: {rules} {joined(missing)}", err=True)
    return not any(each.unmet(item) for each in coverages)
