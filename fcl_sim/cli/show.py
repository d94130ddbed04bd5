"""`fcl-sim show`: every noun on the way from a text to a run."""

from importlib import import_module
from pathlib import Path

import click

from fcl_sim.block import load_all
from fcl_sim.cli.doors import Exit, say
from fcl_sim.cli.matrix import matrix_text
from fcl_sim.diagnostics import Diagnostic
from fcl_sim.diagnostics.render import render_all
from fcl_sim.diagnostics.spelling import listed
from fcl_sim.engine.show import program_text
from fcl_sim.fcl import parse, scan, show_model, show_tokens, show_tree
from fcl_sim.fcl.files import open_source
from fcl_sim.loop.show import tape_text, wiring_text
from fcl_sim.loop.tape import lower
from fcl_sim.loop.wiring import wire
from fcl_sim.scenario.binder import bind
from fcl_sim.scenario.model import BASE
from fcl_sim.scenario.reader import read
from fcl_sim.scenario.show import show_scenario

OF_RULE_BASE = ("tokens", "tree", "model", "matrix", "program")
FORMS = ("text", "csv", "toml")
OF_SCENARIO = ("scenario", "wiring", "tape")


@click.command()
@click.argument("stage", type=click.Choice((*OF_RULE_BASE, *OF_SCENARIO)))
@click.argument("file", type=click.Path(path_type=Path))
@click.option("--variant", default=BASE, show_default=True, help="Which run, of wiring and tape.")
@click.option(
    "--figure",
    type=click.Path(path_type=Path),
    metavar="OUT",
    help="Draw the wiring, as OUT.svg, OUT.png or OUT.pdf.",
)
@click.option(
    "--as", "form", type=click.Choice(FORMS), help="How a matrix is printed; text where nothing is said."
)
def command(stage: str, file: Path, variant: str, figure: Path | None, form: str | None) -> Exit:
    """Print what a file becomes on its way: tokens, tree, model, wiring ...

    \b
    Of FILE.fcl:   tokens, tree, model, matrix, program
    Of FILE.toml:  scenario, wiring, tape
    """  # noqa: D301  the backslash is click's mark for lines that are kept
    if (file.suffix == ".toml") != (stage in OF_SCENARIO) and file.suffix in {".toml", ".fcl"}:
        kind, stages = ("scenario", OF_SCENARIO) if file.suffix == ".toml" else ("rule base", OF_RULE_BASE)
        raise click.UsageError(f"there is no {stage} of a {kind}, but its {listed(stages)}")
    if figure is not None:
        if stage != "wiring":
            raise click.UsageError(f"there is no figure of a {stage}, but of a wiring")
        _draw(file, variant, figure)
    if form is not None and stage != "matrix":
        raise click.UsageError(f"there is one form of {stage}; --as is for a matrix")
    if stage == "matrix":
        click.echo(matrix_text(file, form or "text"), nl=False)
        return Exit.GREEN
    text, findings = _shown(stage, file, variant)
    click.echo(text)
    if findings:
        say(render_all(findings))
    return Exit.INPUT if any(each.is_error for each in findings) else Exit.GREEN


def _draw(file: Path, variant: str, target: Path) -> None:
    """Write the figure of a wiring; what draws is loaded for this alone."""
    scenario = read(file)
    wiring = wire(bind(scenario, variant))
    title = scenario.variants[variant].title
    import_module("fcl_sim.cli.figure").write_wiring(wiring, title, file, target)
    click.echo(f"written: {target}", err=True)


def _shown(stage: str, file: Path, variant: str) -> tuple[str, tuple[Diagnostic, ...]]:
    """Return a product in print, and what its stage found wrong: what could be read is shown all the same."""
    match stage:
        case "tokens":
            scanned = scan(open_source(file))
            return show_tokens(scanned), scanned.diagnostics
        case "tree":
            parsed = parse(scan(open_source(file)))
            return show_tree(parsed.tree), parsed.diagnostics
        case "model":
            return "\n".join(show_model(each.function_block) for each in load_all(file).values()), ()
        case "program":
            return "\n".join(program_text(each.program) for each in load_all(file).values()), ()
        case "scenario":
            return show_scenario(read(file)), ()
    wiring = wire(bind(read(file), variant))
    return (wiring_text(wiring) if stage == "wiring" else tape_text(lower(wiring))), ()
