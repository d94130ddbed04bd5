"""Pictures on one sheet, below one another: what `fcl-sim plot` writes."""

import json
from collections.abc import Mapping, Sequence
from datetime import datetime
from pathlib import Path
from types import MappingProxyType
from typing import Literal

from fcl_sim.block import Block
from fcl_sim.diagnostics import InputFault
from fcl_sim.diagnostics.spelling import listed
from fcl_sim.report import typeset
from fcl_sim.report.characteristics import characteristic, memberships
from fcl_sim.report.exclusive import workplace
from fcl_sim.report.pictures import Picture
from fcl_sim.report.style import WIDTH
from fcl_sim.report.vector import svg

FORMATS: Mapping[str, Literal["png", "svg", "pdf"]] = MappingProxyType(
    {".png": "png", ".svg": "svg", ".pdf": "pdf"}
)
"""What a sheet can be written as, by the ending of the file's name."""


def pictures_of(block: Block) -> list[Picture]:
    """Return the pictures of a rule base alone: its terms, then each output over its inputs."""
    return [
        *memberships(block, {}, "memberships"),
        *characteristic(block, {}, "characteristic"),
    ]


def write_sheet(pictures: Sequence[Picture], file: Path, date: datetime) -> None:
    """Write pictures into one PNG, SVG or PDF, as the file's ending says; whole or not at all.

    `date` is the day that a PDF says it was made. InputFault for another
    ending; OSError where the system refuses.
    """
    kind = FORMATS.get(file.suffix.lower())
    if kind is None:
        raise InputFault.at_file(
            "RUN106",
            str(file),
            f"a picture is not written as `{file.suffix or file.name}`",
            f"end the name in {listed(FORMATS)}",
        )
    with workplace(file.parent) as work:
        drawn = [
            {"file": f"{number}.svg", "alt": each.alt, "caption": each.caption, "width": WIDTH}
            for number, each in enumerate(pictures)
        ]
        for entry, picture in zip(drawn, pictures, strict=True):
            figure = picture.draw()
            entry["width"] = max(WIDTH, figure.width)
            (work / str(entry["file"])).write_bytes(svg(figure))
        (work / "sheet.json").write_text(json.dumps(drawn), encoding="utf-8")
        made = work / f"sheet.{kind}"
        made.write_bytes(typeset.sheet(work, kind, date))
        made.replace(file)
