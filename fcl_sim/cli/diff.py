"""`fcl-sim diff`: how far two rule bases are apart."""

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict
from math import isfinite
from pathlib import Path
from typing import Any

import click

from fcl_sim.block import Block, load
from fcl_sim.cli.doors import Exit
from fcl_sim.diagnostics.spelling import listed
from fcl_sim.proof.apart import Apart, ChangedRule, apart
from fcl_sim.proof.told_law import extreme_json
from fcl_sim.proof.universe import UniverseError, universe_of
from fcl_sim.report.baselines import edited
from fcl_sim.verify.edits import SETTING, TERM, Edit, edits

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
        click.echo(json.dumps(document(found, old, new, delta, _edits(blocks)), indent=2, ensure_ascii=False))
    else:
        for each in found:
            for line in _lines(each):
                click.echo(line)
        if any(each.largest is None or each.largest.bound > 0.0 for each in found):
            for edit in _edits(blocks):
                click.echo(f"edited: {edited(edit)}")
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


def _edits(blocks: tuple[Block, Block]) -> Sequence[Edit]:
    """Return the terms and settings that are not the same; rules are told where they count."""
    old, new = (each.function_block for each in blocks)
    return [each for each in edits(old, new) if each.kind in {TERM, SETTING}]


def _lines(found: Apart) -> Iterator[str]:
    most = found.largest
    if most is None:
        yield f"{found.output}: nothing is known of it: {found.unknown}"
        return
    if most.bound == 0.0:
        yield f"{found.output}: the same everywhere"
        return
    beyond = "" if most.is_exact else f", nowhere by more than {_number(most.bound)}"
    shown = found.shown
    at = " ".join(f"{name}={_number(value)}" for name, value in shown.at.items())
    yield f"{found.output}: differs by up to {_number(most.reached)}{beyond}"
    yield f"  there {_number(shown.old)} became {_number(shown.new)}: {at}"
    yield f"  by more than {_number(found.threshold)} on {_share(found)}"
    yield from _rules(found.rules)


def _rules(rules: Sequence[ChangedRule]) -> Iterator[str]:
    """Yield a line for each rule; one that is in both, with the same words, has one for both."""
    same = {(each.label, each.text) for each in rules if each.side == "old"}
    same &= {(each.label, each.text) for each in rules if each.side == "new"}
    degrees = {(each.side, each.label): _number(each.degree) for each in rules}
    for each in rules:
        if (each.label, each.text) not in same:
            yield f"  {each.side} rule {each.label}, degree {_number(each.degree)}: {each.text}"
        elif each.side == "old":
            old, new = (degrees[side, each.label] for side in ("old", "new"))
            degree = old if old == new else f"{old}, now {new}"
            yield f"  rule {each.label}, degree {degree}: {each.text}"


def _share(found: Apart) -> str:
    least, most = (f"{100 * each:.4g} %" for each in (found.share_at_least, found.share_at_most))
    share = most if least == most else f"{least} to {most}"
    return f"{share} of the universe"


def _number(value: float) -> str:
    return f"{value + 0.0:.6g}"


def document(
    found: tuple[Apart, ...], old: Path, new: Path, delta: float | None, changed: Sequence[Edit]
) -> Mapping[str, Any]:
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
                "shown": {
                    "inputs": dict(each.shown.at),
                    "old": each.shown.old if isfinite(each.shown.old) else None,
                    "new": each.shown.new if isfinite(each.shown.new) else None,
                }
                if each.largest
                else None,
                "share_at_least": each.share_at_least,
                "share_at_most": each.share_at_most,
                "rules": [
                    {"side": rule.side, "label": rule.label, "text": rule.text, "degree": rule.degree}
                    for rule in each.rules
                ],
            }
            for each in found
        ],
        "edits": [asdict(each) for each in changed],
    }
