"""SVG and data → PDF and PNG, by typst: no text of a user ever becomes markup."""

from datetime import UTC, datetime
from importlib.resources import files
from pathlib import Path
from typing import Literal

import typst

from fcl_sim.report.lettering import fonts

PPI = 160
"""Dots per inch of a PNG."""

TEMPLATE = ("dots.typ", "style.typ", "pieces.typ", "report.typ")
"""The files of the layout, one after the other."""

GALLERY = b"""
#set page(width: auto, height: auto, margin: 0pt)
#for each in json("gallery.json") { page(in-dots(image(each), reflow: true)) }
"""

SHEET = b"""
#set page(width: auto, height: auto, margin: 6mm, fill: white)
#set text(font: "DejaVu Sans", size: 7.2pt)
#for each in json("sheet.json") {
  let drawn = image(each.file, alt: each.alt, width: each.width * 1mm)
  block(width: each.width * 1mm, if is-png { in-dots(drawn) } else { drawn } + each.caption, below: 7mm)
}
"""


def pdf(folder: Path, date: datetime) -> bytes:
    """Return the report whose data stand in `folder` as `report.json`, with what it names, dated `date`.

    Tagged PDF/A-3a and PDF/UA-1, the same bytes from the same files.
    """
    made = _compiler(folder).compile(
        template(), format="pdf", pdf_standards=["a-3a", "ua-1"], timestamp=date.astimezone(UTC)
    )
    assert isinstance(made, bytes)  # noqa: S101  a PDF is one file
    return made


def pages(folder: Path, ppi: int = PPI) -> list[bytes]:
    """Return the pages of the report whose data stand in `folder`, as PNGs."""
    return _pngs(folder, template(), ppi)


def template() -> bytes:
    """Return the layout of a report: its look, its pieces, its chapters."""
    return b"\n".join(map(_layout, TEMPLATE))


def pngs(folder: Path) -> list[bytes]:
    """Return the SVG files that `gallery.json` in `folder` names, at least one, as PNGs.

    They are the drawings of the PDF; drawn from the figures themselves they
    would take ten times as long.
    """
    return _pngs(folder, _layout("dots.typ") + GALLERY, PPI)


def sheet(folder: Path, kind: Literal["png", "svg", "pdf"], date: datetime) -> bytes:
    """Return the SVG files that `sheet.json` in `folder` names, below one another on one page."""
    layout = _layout("dots.typ") + SHEET
    if kind == "png":
        return _pngs(folder, layout, PPI)[0]
    made = _compiler(folder).compile(layout, format=kind, timestamp=date.astimezone(UTC))
    assert isinstance(made, bytes)  # noqa: S101  one page is one file
    return made


def _layout(name: str) -> bytes:
    return files("fcl_sim.report").joinpath(name).read_bytes()


def _pngs(folder: Path, layout: bytes, ppi: int) -> list[bytes]:
    """Return each page of a layout as PNG."""
    made = _compiler(folder).compile(layout, format="png", ppi=ppi, sys_inputs={"ppi": str(ppi)})
    return made if isinstance(made, list) else [made] if made else []


def _compiler(folder: Path) -> typst.Compiler:
    """Return typst with its own fonts and matplotlib's, and nothing of the machine it runs on."""
    shipped = typst.Fonts(include_system_fonts=False, font_paths=[str(fonts())])
    return typst.Compiler(root=str(folder), font_paths=shipped, ignore_system_fonts=True)
