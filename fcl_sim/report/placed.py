"""A picture on the page: its file, its width, how it stands."""

from collections.abc import Callable
from typing import Any

from fcl_sim.report.pictures import Picture
from fcl_sim.report.style import WIDTH
from fcl_sim.report.time_plots import TALLEST

Data = dict[str, Any]

Register = Callable[[str, Picture], str]
"""Takes the folder and a picture, returns the SVG file's name that will hold it."""

WIDE = 1.3
"""A figure so many times as wide as the column stands across the page."""
ACROSS = (250.0, 138.0)
"""Width and height in mm that a page across has for a figure."""


def placed(picture: Picture, folder: str, register: Register) -> Data:
    """Return a picture with its width on paper in mm; one too wide for the column stands across the page."""
    width, height = picture.size or (WIDTH, 0.0)
    turned = width > WIDE * WIDTH
    room, most = ACROSS if turned else (WIDTH, TALLEST)
    return {
        "file": register(folder, picture),
        "caption": picture.caption,
        "alt": picture.alt,
        "turned": turned,
        "width": width * min(1.0, room / width, most / height if height else 1.0),
    }
