"""`fcl-sim mutate`: which changes of its rule bases a bench notices."""

import shlex
from collections.abc import Sequence
from pathlib import Path

import click
from rich.table import Table

from fcl_sim import mutation
from fcl_sim.cli.benches import scenario_files
from fcl_sim.cli.doors import Exit, say
from fcl_sim.cli.progress import progress
from fcl_sim.cli.table import GAP, console
from fcl_sim.diagnostics import Diagnostic, InputFault, nearest
from fcl_sim.diagnostics.spelling import listed
from fcl_sim.model.labels import unique_labels
from fcl_sim.mutation import Group, RuleBase, Survey
from fcl_sim.report import mutants
from fcl_sim.report.words import counted
from fcl_sim.scenario.document import shown
from fcl_sim.scenario.model import Scenario
from fcl_sim.scenario.reader import read

GROUPS = {each.name.lower(): each for each in Group}
ALL = "all"


@click.command()
@click.argument("paths", metavar="[PATH]...", nargs=-1, type=click.Path(path_type=Path))
@click.option("--rule", "rules", metavar="LABEL", multiple=True, help="Change this rule only.")
@click.option(
    "--list",
    "groups",
    type=click.Choice((*GROUPS, ALL)),
    multiple=True,
    default=(Group.DIFFERENT.name.lower(),),
    show_default=True,
    help="List the mutants of this group.",
)
@click.option("--json", "as_json", is_flag=True, help="Print every mutant in one JSON document.")
def command(
    *, paths: tuple[Path, ...], rules: tuple[str, ...], groups: tuple[str, ...], as_json: bool
) -> Exit:
    """Change one thing at a time in the rule bases, and see which changes the bench notices.

    PATH is a scenario or a folder of them; without one, the bench of the current folder is taken, else the
    shipped one.

    Each rule base is changed in every way of a catalogue: a consequent moved, a breakpoint shifted, a rule
    deleted ... Each such mutant takes the place of the rule base in all runs that use it. It is killed by a
    requirement that no longer passes, else by a baseline that is left. Exit code 1: some mutant lives,
    though it gives something else where the runs go.
    """
    bases = mutation.rule_bases(_read(scenario_files(paths)))
    if not bases:
        raise click.UsageError("no run of these scenarios has a rule base")
    labels = _labels(bases, rules)
    surveys = [_survey(each, labels) for each in bases]
    for each in surveys:
        for remark in mutants.remarks(each.rule_base, each.refused):
            say(f"warning: {remark}")
    if as_json:
        click.echo(mutants.text(surveys), nl=False)
    else:
        for each in surveys:
            _print(
                each, list(Group) if ALL in groups else [GROUPS[name] for name in GROUPS if name in groups]
            )
        click.echo(mutants.sentence(surveys))
    alive = any(each.of(Group.DIFFERENT) for each in surveys)
    return Exit.VERDICT if alive else Exit.GREEN


def _read(files: Sequence[Path]) -> list[Scenario]:
    """Return the scenarios; InputFault with the faults of all."""
    scenarios = []
    faults: dict[Diagnostic, None] = {}
    for file in files:
        try:
            scenarios.append(read(file))
        except InputFault as fault:
            faults.update(dict.fromkeys(fault.diagnostics))
    if faults:
        raise InputFault(faults)
    return scenarios


def _labels(bases: Sequence[RuleBase], rules: Sequence[str]) -> frozenset[str]:
    """Return the labels that are asked for, in lower case; wrong usage where no rule has one."""
    known = {label.casefold(): label for each in bases for label in unique_labels(each.function_block)}
    for rule in rules:
        if rule.casefold() not in known:
            near = nearest(rule, known.values())
            hint = f"did you mean '{near}'?" if near else f"there are {listed(list(known.values()))}"
            raise click.UsageError(f"there is no rule '{rule}'; {hint}")
    return frozenset(rule.casefold() for rule in rules)


def _survey(base: RuleBase, labels: frozenset[str]) -> Survey:
    with progress(f"mutants of {shown(base.file)}") as advance:
        return mutation.survey(base, lambda mutant: not labels or mutant.rule.casefold() in labels, advance)


def _print(survey: Survey, groups: Sequence[Group]) -> None:
    base = survey.rule_base
    tally = f"{counted(len(survey.fates), 'mutant')}, {counted(len(base.cases), 'run')}"
    click.echo(f"{shown(base.file)}, {base.function_block.name}: {tally}\n")
    table = Table(box=None, pad_edge=False, padding=(0, GAP, 0, 0), header_style="bold")
    table.add_column("one change each")
    for heading in (
        "mutants",
        *(str(each).replace(" by ", " by\n").replace(" and ", " and\n") for each in Group),
    ):
        table.add_column(heading.replace(", ", ",\n"), justify="right", vertical="bottom")
    for kind, count, by_group in mutants.counts(survey):
        table.add_row(kind, str(count), *(str(by_group[each] or "") for each in Group))
    console().print(table)
    for group in groups:
        fates = survey.of(group)
        if fates:
            click.echo(f"\n{group}:{_hint(base, group)}")
        for fate in fates:
            click.echo(f"  {mutants.line(fate, base)}")
    click.echo()


def _hint(base: RuleBase, group: Group) -> str:
    if group is not Group.DIFFERENT:
        return ""
    file = shlex.quote(shown(base.file))
    return f" each line ends with the inputs where it shows most, as in `fcl-sim eval {file} INPUTS`"
