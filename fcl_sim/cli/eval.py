"""`fcl-sim eval`: one evaluation of a rule base."""

import json
from collections.abc import Callable, Mapping
from dataclasses import asdict
from fractions import Fraction
from importlib import import_module
from pathlib import Path
from typing import Any, TypeVar

import click

from fcl_sim.block import ARITHMETICS, Block, load
from fcl_sim.engine.explain import Explanation, Origin
from fcl_sim.engine.explain_text import explanation_text
from fcl_sim.proof.exact import exactly
from fcl_sim.proof.rationals import NotExact
from fcl_sim.proof.told_exact import REMARKS, exact_json, exact_lines
from fcl_sim.units import short

SCHEMA = 1

T = TypeVar("T")


@click.command()
@click.argument("file", metavar="FILE.fcl", type=click.Path(path_type=Path))
@click.argument("assignments", metavar="[NAME=NUMBER]...", nargs=-1)
@click.option("--block", metavar="NAME", help="Which function block, where the file has several.")
@click.option(
    "--arithmetic",
    type=click.Choice(ARITHMETICS),
    default="LREAL",
    show_default=True,
    help="What it computes in: binary64, binary32, or the counts of Concept's FUZZY library.",
)
@click.option(
    "--exact",
    "in_fractions",
    is_flag=True,
    help="Compute in fractions: numbers are the decimals that are written, 1/3 is a third.",
)
@click.option("--explain", is_flag=True, help="Show every step of the inference.")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON document.")
@click.option(
    "--figure",
    type=click.Path(path_type=Path),
    metavar="OUT",
    help="Draw every step of the inference into OUT.png, OUT.svg or OUT.pdf.",
)
def command(  # noqa: PLR0913  an option each
    *,
    file: Path,
    assignments: tuple[str, ...],
    block: str | None,
    arithmetic: str,
    in_fractions: bool,
    explain: bool,
    as_json: bool,
    figure: Path | None,
) -> None:
    """Evaluate a rule base once.

    Every input is given by name: `fcl-sim eval crane.fcl distance=12 angle=4`. One with an initial value may
    be left out.
    """
    loaded = load(file, block)
    if in_fractions:
        if arithmetic != "LREAL" or figure is not None:
            raise click.UsageError("--exact goes without --arithmetic and --figure")
        _exactly(loaded, _values(assignments, _fraction), explain=explain, as_json=as_json)
        return
    values = _values(assignments, float)
    try:
        results = loaded.evaluate(values, arithmetic=arithmetic)
    except OverflowError as error:
        raise click.ClickException(str(error)) from None
    except (TypeError, ValueError) as error:  # unknown, missing or not finite, as it says
        raise click.UsageError(str(error)) from None
    if arithmetic == "INT":
        _in_counts(results, values, loaded.name, as_json=as_json, more=explain or figure is not None)
        return
    explanation = loaded.instance(arithmetic).explain(**values)
    if figure is not None:
        # Loads matplotlib and typst, which an evaluation does without.
        import_module("fcl_sim.cli.figure").write(loaded.function_block, explanation, file, figure)
        click.echo(f"written: {figure}", err=True)
    if as_json:
        document = _document(explanation, values, arithmetic)
        if explain:
            document["explanation"] = asdict(explanation)
        click.echo(json.dumps(document, indent=2, ensure_ascii=False))
    elif explain:
        click.echo(explanation_text(explanation))
    else:
        for each in explanation.defuzzified:
            click.echo(f"{each.variable} = {short(each.value)}{REMARKS[each.origin]}")


def _in_counts(
    results: Mapping[str, Any], values: dict[str, float], name: str, *, as_json: bool, more: bool
) -> None:
    """Print outputs in INT, of which there are no steps to show."""
    if more:
        raise click.UsageError("--explain and --figure are for LREAL and REAL")
    outputs = {output: int(value) for output, value in results.items()}
    if as_json:
        document = {
            "schema": SCHEMA,
            "block": name,
            "arithmetic": "INT",
            "inputs": values,
            "outputs": outputs,
        }
        click.echo(json.dumps(document, indent=2, ensure_ascii=False))
        return
    for output, value in outputs.items():
        click.echo(f"{output} = {value}")


def _exactly(loaded: Block, values: dict[str, Fraction], *, explain: bool, as_json: bool) -> None:
    """Print an evaluation in fractions."""
    try:
        found = exactly(loaded.function_block, values)
    except TypeError as error:  # unknown or missing, as it says
        raise click.UsageError(str(error)) from None
    except NotExact as reason:
        raise click.UsageError(f"{loaded.name} cannot be computed with --exact: {reason}") from None
    if as_json:
        click.echo(json.dumps(exact_json(found, loaded.name), indent=2, ensure_ascii=False))
        return
    for line in exact_lines(found, explain=explain):
        click.echo(line)


def _fraction(text: str) -> Fraction:
    """Return a number as it is written; ValueError for one that is none, or beyond what LREAL holds."""
    try:
        found = Fraction(text)
        float(found)
    except (ZeroDivisionError, OverflowError):
        raise ValueError from None
    return found


def _values(assignments: tuple[str, ...], read: Callable[[str], T]) -> dict[str, T]:
    """Return numbers by name; wrong usage where a text does not give one, or gives it again."""
    values: dict[str, T] = {}
    for text in assignments:
        name, equals, number = (part.strip() for part in text.partition("="))
        if not equals:
            raise click.UsageError(f"'{text}' is not NAME=NUMBER")
        if name in values:
            raise click.UsageError(f"'{name}' is given twice")
        try:
            values[name] = read(number)
        except ValueError:
            raise click.UsageError(f"'{number}' for '{name}' is not a number{_hint(number, read)}") from None
    return values


def _hint(number: str, read: Callable[[str], T]) -> str:
    if "," in number:
        return ": the decimal separator is a point"
    return ": fractions are for --exact" if "/" in number and read is not _fraction else ""


def _document(explanation: Explanation, values: dict[str, float], arithmetic: str) -> dict[str, Any]:
    return {
        "schema": SCHEMA,
        "block": explanation.name,
        "arithmetic": arithmetic,
        "inputs": values,
        "outputs": {each.variable: each.value for each in explanation.defuzzified},
        "active": {each.variable: each.origin is Origin.RULES for each in explanation.defuzzified},
        "degrees": {each.rule: each.degree for each in explanation.aggregated},
    }
