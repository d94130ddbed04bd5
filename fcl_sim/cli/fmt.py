"""`fcl-sim fmt`: rule bases in the canonical form."""

import difflib
import os
import shutil
import sys
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from io import StringIO
from pathlib import Path

import click

from fcl_sim.cli.doors import Exit, say
from fcl_sim.cli.rule_bases import rule_bases
from fcl_sim.diagnostics import InputFault, Source
from fcl_sim.diagnostics.render import render_all
from fcl_sim.fcl.files import check_ending, open_source, source_of
from fcl_sim.fcl.rewrite import rewrite

LEVELS = ("open", "basic")
PIPE = Path("-")


@dataclass(frozen=True, slots=True)
class _Text:
    """A text as it is, `content` in bytes, and as it is to be."""

    path: Path
    source: Source
    content: bytes
    canonical: bytes

    @property
    def differs(self) -> bool:
        return self.content != self.canonical


@click.command()
@click.argument("paths", metavar="PATH...", nargs=-1, required=True, type=click.Path(path_type=Path))
@click.option("--check", is_flag=True, help="Write nothing; exit code 1 if a file would change.")
@click.option("--diff", is_flag=True, help="Write nothing; print what would change.")
@click.option(
    "--level",
    type=click.Choice(LEVELS),
    default="open",
    help="basic: write what the Basic Level (Table 8) can say, or refuse.",
)
def command(paths: tuple[Path, ...], *, check: bool, diff: bool, level: str) -> Exit:
    """Write rule bases in the canonical form of the standard.

    PATH is a file, a folder to search for *.fcl, a pattern, or - for stdin to stdout.

    The meaning stays, and so do the comments, with what they describe. A file with errors is left as it is.
    With --level basic, OR becomes several rules (5.2.4), as do several subconclusions; what the Basic Level
    would compute otherwise is refused, with its place.
    """
    files, faults = rule_bases(tuple(each for each in paths if each != PIPE))
    if faults:
        say(render_all(faults))
    texts = []
    faulty = bool(faults)
    for path in (*files, *([PIPE] if PIPE in paths else ())):
        try:
            texts.append(_rewritten(path, basic=level == "basic"))
        except InputFault as fault:
            say(str(fault))
            faulty = True
    for each in texts:
        _deliver(each, check=check, diff=diff)
    if faulty:
        return Exit.INPUT
    return Exit.VERDICT if check and any(each.differs for each in texts) else Exit.GREEN


def _rewritten(path: Path, *, basic: bool) -> _Text:
    if path == PIPE:
        content = sys.stdin.buffer.read()
        source = source_of(content, "<stdin>")
    else:
        check_ending(path)
        open_source(path)  # says what is wrong with a file that cannot be read
        content = path.read_bytes()
        source = source_of(content, str(path))
    if "\ufffd" in source.text and "\ufffd".encode() not in content:
        message = "this file is neither UTF-8 nor Windows-1252: some of its characters would be lost"
        raise InputFault.at_file("FCL104", source.name, message, hint="save it as UTF-8")
    return _Text(path, source, content, rewrite(source, basic=basic).encode())


def _deliver(text: _Text, *, check: bool, diff: bool) -> None:
    """Write a text where it belongs, or say what would be written."""
    if diff:
        click.echo("".join(_difference(text)), nl=False)
    elif check:
        if text.differs:
            click.echo(f"{text.source.name}: would be rewritten")
    elif text.path == PIPE:
        sys.stdout.buffer.write(text.canonical)
    elif text.differs:
        _replace(text.path, text.canonical)
        click.echo(f"{text.source.name}: rewritten")


def _difference(text: _Text) -> Iterator[str]:
    """Yield the lines of a unified diff; one that differs in its encoding or line ends alone says so."""
    name = text.source.name
    before, after = (
        list(StringIO(each)) for each in (text.source.text.replace("\r\n", "\n"), text.canonical.decode())
    )
    lines = list(difflib.unified_diff(before, after, name, f"{name} (canonical)"))
    if text.differs and not lines:
        yield f"{name}: encoding or line ends would change\n"
    for line in lines:
        yield line if line.endswith("\n") else f"{line}\n\\ No newline at end of file\n"


def _replace(path: Path, content: bytes) -> None:
    """Write a file in one step: whoever reads it finds the old content or the new one."""
    target = path.resolve()
    with target.open("r+b"):
        pass  # one that must not be written is not replaced either
    handle, name = tempfile.mkstemp(prefix=f".{target.name}.", dir=target.parent)
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        shutil.copymode(target, name)
        Path(name).replace(target)
    except BaseException:
        Path(name).unlink(missing_ok=True)
        raise
