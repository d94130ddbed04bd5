"""Files → text: encodings, line ends, and what is no text (S15b)."""

import codecs
import os
import re
from itertools import islice
from pathlib import Path

from fcl_sim.diagnostics import Diagnostic, InputFault, Place, Severity, Source, Span, nearest
from fcl_sim.diagnostics.spelling import listed
from fcl_sim.fcl.findings import in_order
from fcl_sim.fcl.reading import LONGEST_TEXT, Reading, read

_SAMPLE = 4096
_CONTROLS = bytes(each for each in range(32) if chr(each) not in "\t\n\v\f\r\x1a")
_MOST_CONTROLS = 0.05
"""Share of control characters above which a file is not a text."""


OTHER_KINDS = {
    ".toml": "a TOML file",
    ".json": "a JSON file",
    ".csv": "a table in CSV",
    ".npz": "a file of numbers",
    ".pdf": "a PDF",
    ".html": "a page for a browser",
    ".png": "a picture",
    ".svg": "a picture",
    ".py": "Python",
}
"""What is no FCL by the ending of its name."""


def read_file(path: str | os.PathLike[str]) -> Reading:
    """Return what `read` returns for a file's text, with a warning where it is not in UTF-8.

    Raise `InputFault` as `open_source` does, and for a file of another kind by its name.
    """
    source, encoding = _open(path)
    check_ending(path)
    reading = read(source.text, source.name)
    if not encoding:
        return reading
    return Reading(reading.blocks, in_order((_foreign(source, encoding), *reading.diagnostics)))


def check_ending(path: str | os.PathLike[str]) -> None:
    """Raise `InputFault` where the name of a file says that it is no rule base."""
    kind = OTHER_KINDS.get(Path(path).suffix.lower())
    if kind is not None:
        hint = "a rule base is a .fcl file; `fcl-sim run` takes scenarios, which are .toml files"
        raise InputFault.at_file("FCL103", os.fspath(path), f"this is {kind}, not a rule base", hint)


def open_source(path: str | os.PathLike[str]) -> Source:
    """Return the text of a file.

    UTF-8 is expected, with or without a byte order mark; UTF-16 with one and
    Windows-1252 are read as well (S15b). Raise `InputFault` for a file that is
    missing, cannot be read, is no text, or has more than 8 MiB.
    """
    return _open(path)[0]


def source_of(content: bytes, name: str) -> Source:
    """Return the text of what a file, or a pipe called `name`, holds; else as `open_source`."""
    return _decoded(content, name)[0]


def _open(path: str | os.PathLike[str]) -> tuple[Source, str]:
    """Return the text of a file, and the name of its encoding where that is not UTF-8."""
    name = os.fspath(path)
    return _decoded(_content(name), name)


def _decoded(content: bytes, name: str) -> tuple[Source, str]:
    if len(content) > LONGEST_TEXT:
        message = f"this file is too large for a rule base: {LONGEST_TEXT // 2**20} MiB are read at most"
        raise InputFault.at_file("FCL102", name, message)
    decoded = _decode(content)
    if decoded is None:
        raise InputFault.at_file("FCL103", name, "this file is not a text", hint="FCL is plain text in UTF-8")
    text, encoding = decoded
    return Source(name, re.sub(r"\r(?!\n)", "\n", text.rstrip("\x1a"))), encoding


def _content(name: str) -> bytes:
    """Return the file's bytes, one more than are allowed at most."""
    try:
        path = Path(name)
        if path.is_dir():
            raise InputFault.at_file("FCL101", name, "this is a folder, not a file", hint=_files_in(path))
        with path.open("rb") as file:
            return file.read(LONGEST_TEXT + 1)
    except FileNotFoundError:
        raise InputFault.at_file("FCL101", name, "there is no such file", hint=_similar(Path(name))) from None
    except OSError as error:
        reason = error.strerror or str(error)
        raise InputFault.at_file("FCL101", name, f"this file cannot be read: {reason}") from None
    except ValueError as error:  # a name that no system accepts
        raise InputFault.at_file("FCL101", name, f"this is not the name of a file: {error}") from None


def _decode(content: bytes) -> tuple[str, str] | None:
    """Return the text of a file's bytes and its encoding if not UTF-8, None where they are no text."""
    for mark, encoding in ((codecs.BOM_UTF16_LE, "UTF-16"), (codecs.BOM_UTF16_BE, "UTF-16")):
        if content.startswith(mark):
            return content.decode(encoding, errors="replace"), encoding
    sample = content[:_SAMPLE]
    controls = len(sample) - len(sample.translate(None, _CONTROLS))
    if controls > _MOST_CONTROLS * len(sample):
        return None
    try:
        return content.decode("utf-8-sig"), ""
    except UnicodeDecodeError:
        return content.decode("cp1252", errors="replace"), "Windows-1252"


def _foreign(source: Source, encoding: str) -> Diagnostic:
    foreign = re.search(r"[^\x00-\x7f]", source.text)
    start = foreign.start() if foreign else 0
    span = Span(source, start, start + 1)
    return Diagnostic(
        code="FCL104",
        message=f"this file is not UTF-8: it is read as {encoding}",
        severity=Severity.WARNING,
        places=(Place(span),),
        hint="save it as UTF-8",
    )


def _similar(path: Path) -> str:
    near = nearest(path.name, _names(path.parent, "*"))
    return f"did you mean `{path.with_name(near)}`?" if near else ""


def _files_in(folder: Path) -> str:
    names = sorted(_names(folder, "*.fcl"))
    return f"it holds {listed(names)}" if names else ""


def _names(folder: Path, pattern: str) -> list[str]:
    try:
        return [each.name for each in islice(folder.glob(pattern), 200)]
    except OSError:
        return []
