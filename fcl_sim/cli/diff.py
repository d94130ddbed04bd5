"""`fcl-sim diff`: how far two rule bases are apart."""

import json
from collections.abc import Iterator, Mapping
from math import isfinite
from pathlib import Path
from typing import Any

import click

from fcl_sim.block import Block, load
from fcl_sim.cli.doors import Exit
from fcl_sim.diagnostics.spelling import listed
from fcl_sim.proof.apart import Apart, apart
from fcl_sim.proof.told_law import extreme_json
from fcl_sim.proof.universe import UniverseError, universe_of

SCHEMA = 1


@click.command()
@click.argument("old", metavar="OLD.fcl", type=click.Path(path_type=Path))
@click.argument("new", metavar="NEW.fcl", type=click.Path(path_type=Path))
@click.option("--block", metavar="NAME", help="Which function block, where the files have several.")
@click.option(
    "--universe",
    "stretches",
    metavar="NAME=LOW..HIGH",
    multiple=True,
    help="From where to where an input goes; else as far as its terms have points.",
)
@click.option(
    "--delta",
    type=click.FloatRange(0.0),
    metavar="VALUE",
    help="By how much they may differ, in the unit of the output; else 1 % of its reach.",
)
@click.option("--json", "as_json", is_flag=True, help="Print one JSON document.")
def command(
    *, old: Path, new: Path, block: str | None, stretches: tuple[str, ...], delta: float | None, as_json: bool
) -> Exit:
    """Tell by how much two rule bases differ in what they give, where most, and which rules do it.

    The texts do not count: what is compared is every output over the whole space of the inputs.
    The exit code is 1 where they differ by more than --delta.
    """
    blocks = load(old, block), load(new, block)
    _same_names(*blocks)
    try:
        universe = universe_of(blocks[0].function_block, stretches)
    except UniverseError as error:
        raise click.UsageError(str(error)) from None
    found = apart(*blocks, universe, delta)
    if as_json:
        click.echo(json.dumps(document(found, old, new, delta), indent=2, ensure_ascii=False))
    else:
        for each in found:
            for line in _lines(each):
                click.echo(line)
    return Exit.VERDICT if any(each.differs for each in found) else Exit.GREEN


def _same_names(old: Block, new: Block) -> None:
    """Refuse blocks whose inputs are not the same: there is nothing to compare them at."""
    names = [{name.casefold(): name for name in each.inputs} for each in (old, new)]
    if names[0].keys() != names[1].keys():
        told = []
        for word, own, other in (("old", names[0], names[1]), ("new", names[1], names[0])):
            alone = [own[each] for each in sorted(own.keys() - other.keys())]
            if alone:
                told.append(f"the {word} one alone has {listed(alone).replace(' or ', ' and ')}")
        raise click.UsageError(f"the inputs are not the same: {', '.join(told)}")


def _lines(found: Apart) -> Iterator[str]:
    most = found.largest
    if most is None:
        yield f"{found.output}: nothing is known of it: {found.unknown}"
        return
    if most.bound == 0.0:
        yield f"{found.output}: the same everywhere"
        return
    beyond = "" if most.is_exact else f", nowhere by more than {_number(most.bound)}"
    at = " ".join(f"{name}={_number(value)}" for name, value in most.at.items())
    yield f"{found.output}: differs by up to {_number(most.reached)}{beyond}"
    yield f"  there {_number(found.old)} became {_number(found.new)}: {at}"
    yield f"  by more than {_number(found.threshold)} on {_share(found)}"
    for rule in found.rules:
        yield f"  {rule.side} rule {rule.label}, degree {_number(rule.degree)}: {rule.text}"


def _share(found: Apart) -> str:
    least, most = (f"{100 * each:.4g} %" for each in (found.share_at_least, found.share_at_most))
    share = most if least == most else f"{least} to {most}"
    return f"{share} of the universe"


def _number(value: float) -> str:
    return f"{value + 0.0:.6g}"


def document(found: tuple[Apart, ...], old: Path, new: Path, delta: float | None) -> Mapping[str, Any]:
    """Return differences as JSON's types."""
    return {
        "schema": SCHEMA,
        "old": old.as_posix(),
        "new": new.as_posix(),
        "threshold": delta,
        "outputs": [
            {
                "output": each.output,
                "unknown": each.unknown,
                "threshold": each.threshold,
                "largest": extreme_json(each.largest),
                "old": each.old if isfinite(each.old) else None,
                "new": each.new if isfinite(each.new) else None,
                "share_at_least": each.share_at_least,
                "share_at_most": each.share_at_most,
                "rules": [
                    {"side": rule.side, "label": rule.label, "text": rule.text, "degree": rule.degree}
                    for rule in each.rules
                ],
            }
            for each in found
        ],
    }
