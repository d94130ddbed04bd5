"""Which rule bases the arguments of a command mean."""

import glob
from collections.abc import Iterator
from pathlib import Path

from fcl_sim.diagnostics import Diagnostic, Place

SUFFIX = ".fcl"


def rule_bases(paths: tuple[Path, ...]) -> tuple[tuple[Path, ...], tuple[Diagnostic, ...]]:
    """Return the files that `paths` stand for, each once, and a finding for each that stands for none.

    A folder stands for the `*.fcl` files below it, hidden folders excepted; a
    pattern such as `scenarios/**/*.fcl` for what it fits, where the shell has
    left it alone. Everything else is taken for a file, whether it is there or not.
    """
    found: dict[Path, None] = {}
    faults: list[Diagnostic] = []
    for path in paths:
        files = list(_meant(path))
        if not files:
            faults.append(_nothing(path))
        found.update(dict.fromkeys(files))
    return tuple(found), tuple(faults)


def _meant(path: Path) -> Iterator[Path]:
    if path.is_dir():
        yield from sorted(each for each in path.rglob("*") if _is_rule_base(each, path))
    elif glob.has_magic(str(path)) and not path.exists():
        yield from map(Path, sorted(glob.glob(str(path), recursive=True)))  # noqa: PTH207  absolute patterns, too
    else:
        yield path


def _is_rule_base(file: Path, folder: Path) -> bool:
    hidden = any(part.startswith(".") for part in file.relative_to(folder).parts)
    return file.suffix.lower() == SUFFIX and not hidden and file.is_file()


def _nothing(path: Path) -> Diagnostic:
    message, hint = "no file fits this pattern", ""
    if path.is_dir():
        message, hint = "there is no rule base below this folder", f"a rule base is a {SUFFIX} file"
    return Diagnostic(code="RUN107", message=message, places=(Place(file=str(path)),), hint=hint)
