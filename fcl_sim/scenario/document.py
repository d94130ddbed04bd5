"""Files of a scenario → their text, or the fault and its mend."""

import hashlib
from pathlib import Path

from fcl_sim.diagnostics import Diagnostic, InputFault, Place, Source, Span, nearest
from fcl_sim.diagnostics.spelling import listed
from fcl_sim.scenario.model import SourceFile
from fcl_sim.toml import Entry
from fcl_sim.toml import parse as parse_toml

SCENARIO, CONTROLLER_FILE, RULE_BASE, BLOCK_FILE = "scenario", "controller", "rule base", "block"
BASELINE_FILE = "baseline"
"""The roles of files."""

BYTE_ORDER_MARK = "\ufeff"


def read_file(path: Path, role: str, asked: Span | None = None) -> SourceFile:
    """Return a file; InputFault, at the place that asks for it, where it cannot be read.

    A rule base may be in another encoding than UTF-8: its reader sees to that.
    """
    try:
        data = path.read_bytes()
        text = data.decode("utf-8", "replace" if role == RULE_BASE else "strict")
    except FileNotFoundError as error:
        raise _unreadable(path, asked, f"there is no file `{shown(path)}`", _beside(path)) from error
    except OSError as error:
        raise _unreadable(path, asked, f"`{shown(path)}` cannot be read: {error.strerror}") from error
    except UnicodeDecodeError as error:
        message = f"`{shown(path)}` is not UTF-8 text: byte {error.start + 1} does not fit"
        raise _unreadable(path, asked, message, "save it as UTF-8") from error
    except ValueError as error:
        raise _unreadable(path, asked, f"{str(path)!r} is not the name of a file") from error
    source = Source(shown(path), text.removeprefix(BYTE_ORDER_MARK))
    return SourceFile(role=role, path=path, source=source, digest=hashlib.sha256(data).hexdigest())


def shown(path: Path) -> str:
    """Return a path as short as it can be said: relative to the current folder where it lies below."""
    whole, here = path.absolute(), Path.cwd()
    return whole.relative_to(here).as_posix() if whole.is_relative_to(here) else path.as_posix()


def _unreadable(path: Path, asked: Span | None, message: str, hint: str = "") -> InputFault:
    place = Place(span=asked) if asked else Place(file=shown(path))
    return InputFault([Diagnostic(code="SCN101", message=message, places=(place,), hint=hint)])


def _beside(path: Path) -> str:
    if not path.parent.is_dir():
        return f"there is no folder `{shown(path.parent)}` either"
    names = sorted(each.name for each in path.parent.glob(f"*{path.suffix}") if each.is_file())
    near = nearest(path.name, names)
    if near:
        return f"did you mean `{near}`?"
    return f"the folder holds {listed(names)}" if names else ""


def parse(source: Source) -> Entry:
    """Return a TOML text as a tree; InputFault where it is none."""
    return parse_toml(source, not_toml="SCN102", twice="SCN103")
