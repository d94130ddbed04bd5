"""Outcomes → files: one PDF, the results as JSON and stored, on request a page and PNGs; whole or none."""

import errno
import filecmp
import json
import re
from collections.abc import Callable, Sequence
from contextlib import closing
from functools import partial
from pathlib import Path
from shutil import copyfile

from fcl_sim.diagnostics import InputFault
from fcl_sim.forked import Copies, Work, able, do_all
from fcl_sim.report import alone, archive, results, typeset
from fcl_sim.report.archive import Stored
from fcl_sim.report.content import report_data
from fcl_sim.report.exclusive import workplace
from fcl_sim.report.gather import gathered
from fcl_sim.report.html import page
from fcl_sim.report.pictures import Picture
from fcl_sim.report.vector import svg
from fcl_sim.scenario.kinds import RESULTS
from fcl_sim.testbench import Outcome
from fcl_sim.verify.coverage import Coverage

PDF = "report.pdf"
HTML = "report.html"
DATA = "report.json"
PAGES = "pages"
"""The folder of the pages as PNG."""
STORED = archive.beside(Path(RESULTS)).name
LONGEST = 80
"""Characters of a file's stem; file systems take 255 bytes with the ending."""

Progress = Callable[[int, int], None]
Lap = Callable[[str], None]
"""Is told what has just been done: `drawing`, `typesetting` or `writing`."""


def write(  # noqa: PLR0913  a choice each
    outcomes: Sequence[Outcome],
    folder: Path,
    progress: Progress | None = None,
    covered: Sequence[Coverage] | None = None,
    *,
    png: bool = False,
    pages: bool = False,
    html: bool = False,
    lap: Lap | None = None,
) -> list[Path]:
    """Write the report of a run as `write_stored` does; `covered` is its coverage, where it is known."""
    stored = gathered(outcomes, covered)
    return write_stored(stored, folder, progress, png=png, pages=pages, html=html, lap=lap)


def write_stored(  # noqa: PLR0913  a choice each
    stored: Stored,
    folder: Path,
    progress: Progress | None = None,
    *,
    png: bool = False,
    pages: bool = False,
    html: bool = False,
    lap: Lap | None = None,
    source: Path | None = None,
) -> list[Path]:
    """Write the report of a run into `folder`; return its files, the PDF first.

    Everything is made in a hidden folder inside `folder` and moved into place
    at the end, file by file, so a run that is killed leaves old files or new
    ones, none half-written. `progress` is called with the pictures drawn and
    their number. With `png` each picture is written as one, too, with `pages`
    each page, with `html` the page for a browser is; without, one that a report of
    other results has left under its name is removed, as it would show another run.
    `source` is the results file that all of `stored` was read from, where it was.
    InputFault where the system refuses.
    """
    done = lap or _silent
    try:
        with workplace(folder) as work, closing(Copies(2)) as copies, closing(Shelf(work)) as shelf:
            told = copies.begin(partial(_write_results, stored, work, source))
            beside = [copies.begin(partial(_write_page, stored, work))] if html else []
            data = report_data(stored, shelf.add)
            (work / DATA).write_text(json.dumps(data), encoding="utf-8")
            copies.result(told)
            beside.append(copies.begin(partial(_write_archive, stored, work, source)))
            shelf.draw(progress or _silent)
            done("drawing")
            (work / PDF).write_bytes(typeset.pdf(work, stored.origin.date))
            names = [*(shelf.export() if png else []), *(_pages(work, PAGES) if pages else [])]
            for each in beside:
                copies.result(each)
            done("typesetting")
            named = [HTML] if html else []
            is_again = _is_same(work / RESULTS, folder / RESULTS)
            moved = _move(work, folder, [*names, STORED, RESULTS, *named, PDF])[::-1]
            if not is_again:
                _remove(folder, [*shelf.pngs, HTML], PAGES, moved)
            done("writing")
            return moved
    except OSError as error:
        raise refused(error, folder) from error


def write_alone(file: Path, folder: Path, *, png: bool = False, pages: bool = False) -> list[Path]:
    """Write the report of a rule base alone into `folder`, as FILE.pdf; return its files, the PDF first.

    InputFault where the rule base has errors, or the system refuses.
    """
    blocks, source, origin = alone.of_file(file)
    try:
        with workplace(folder) as work, closing(Shelf(work)) as shelf:
            data = alone.report_data(blocks, source, origin, shelf.add)
            (work / DATA).write_text(json.dumps(data), encoding="utf-8")
            (work / RESULTS).write_text(alone.findings_text(blocks, source), encoding="utf-8")
            shelf.draw(_silent)
            name = f"{slug(file.stem)}.pdf"
            (work / name).write_bytes(typeset.pdf(work, origin.date))
            where = f"{PAGES}/{slug(file.stem)}"
            names = [*(shelf.export() if png else []), *(_pages(work, where) if pages else [])]
            moved = _move(work, folder, [*names, name])[::-1]
            _remove(folder, [], where, moved)
            return moved
    except OSError as error:
        raise refused(error, folder) from error


def _write_results(stored: Stored, work: Path, source: Path | None) -> None:
    if source is None:
        (work / RESULTS).write_text(results.text(stored.outcomes, stored.covered), encoding="utf-8")
    else:
        copyfile(source, work / RESULTS)


def _write_archive(stored: Stored, work: Path, source: Path | None) -> None:
    """Write what is stored beside the results, which are there."""
    if source is None:
        archive.write(stored, (work / RESULTS).read_text(encoding="utf-8"), work / STORED)
    else:
        copyfile(archive.beside(source), work / STORED)


def _write_page(stored: Stored, work: Path) -> None:
    (work / HTML).write_text(page(stored.outcomes, stored.covered), encoding="utf-8")


def _pages(work: Path, where: str) -> list[str]:
    """Write every page as PNG into a folder; return the files' names."""
    (work / where).mkdir(parents=True, exist_ok=True)
    names = []
    for number, png in enumerate(typeset.pages(work), start=1):
        names.append(f"{where}/{number:03}.png")
        (work / names[-1]).write_bytes(png)
    return names


def _is_same(one: Path, other: Path) -> bool:
    return other.is_file() and filecmp.cmp(one, other, shallow=False)


def _remove(folder: Path, stale: Sequence[str], pages: str, kept: Sequence[Path]) -> None:
    """Remove what a report before has left, the files `stale` and its pages, but for what is `kept`."""
    left = {folder / name for name in stale}
    left |= {each for each in (folder / pages).glob("*.png") if each.stem.isdigit()}
    for each in left - set(kept):
        each.unlink(missing_ok=True)


BATCH = 8
"""Pictures that are worth a copy of this process."""


class Shelf:
    """The pictures of a report, drawn into a folder under names that any file system takes and no two share.

    While data are still gathered for more, other processors draw those that are there.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._pictures: dict[str, Picture] = {}
        self._left: list[str] = []
        self._ahead: list[Work[None]] = []
        self._copies = Copies(able() - 1)

    def add(self, folder: str, picture: Picture) -> str:
        """Take a picture; return the name of its SVG file, to be drawn later."""
        stem = "/".join(slug(each) for each in (*folder.split("/"), picture.name) if each)
        name, copy = stem, 1
        while name.casefold() in {each.casefold() for each in self._pictures}:
            copy += 1
            name = f"{stem}-{copy}"
        self._pictures[name] = picture
        self._left.append(name)
        if len(self._left) >= BATCH and self._copies.free():
            self._ahead.append(self._copies.begin(partial(self._draw_some, tuple(self._left))))
            self._left = []
        return f"{name}.svg"

    @property
    def pngs(self) -> list[str]:
        """Names of the pictures' files as PNG."""
        return [f"{name}.png" for name in self._pictures]

    def draw(self, progress: Progress) -> None:
        """Draw every picture that is not drawn yet, as SVG."""
        count = len(self._pictures)
        begun = count - len(self._left)
        do_all([partial(self._draw, name) for name in self._left], lambda done: progress(begun + done, count))
        for each in self._ahead:
            self._copies.result(each)

    def close(self) -> None:
        """End what is being drawn."""
        self._copies.close()

    def _draw_some(self, names: Sequence[str]) -> None:
        for name in names:
            self._draw(name)

    def _draw(self, name: str) -> None:
        file = self._folder / f"{name}.svg"
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(svg(self._pictures[name].draw()))

    def export(self) -> list[str]:
        """Write every drawn picture as PNG; return the files' names."""
        svgs = [f"{name}.svg" for name in self._pictures]
        (self._folder / "gallery.json").write_text(json.dumps(svgs), encoding="utf-8")
        for name, png in zip(self.pngs, typeset.pngs(self._folder) if svgs else [], strict=True):
            (self._folder / name).write_bytes(png)
        return self.pngs


def slug(name: str) -> str:
    """Return a name as a file's stem: letters, digits, `-`, `_`, and dots inside."""
    return re.sub(r"[^A-Za-z0-9_.-]+", "_", name).strip(".")[:LONGEST] or "_"


def _move(work: Path, folder: Path, names: Sequence[str]) -> list[Path]:
    moved = []
    for name in names:
        target = folder / name
        target.parent.mkdir(parents=True, exist_ok=True)
        moved.append((work / name).replace(target))
    return moved


def refused(error: OSError, folder: Path) -> InputFault:
    """Return the fault of a report that the system did not let us write."""
    full = error.errno in {errno.ENOSPC, errno.EDQUOT}
    reason = error.strerror or str(error)
    return InputFault.at_file(
        "RUN201",
        str(folder),
        f"the report cannot be written: {reason}",
        "make room, or name a folder elsewhere" if full else "name a folder that can be written",
    )


def _silent(*_: object) -> None:
    """Take no notice."""
