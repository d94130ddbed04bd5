"""A picture on the page: its file, its width, how it stands."""

from collections.abc import Callable
from typing import Any

from fcl_sim.report.pictures import Picture
from fcl_sim.report.style import TALLEST, WIDTH

Data = dict[str, Any]

Register = Callable[[str, Picture], str]
"""Takes the folder and a picture, returns the SVG file's name that will hold it."""


def placed(picture: Picture, folder: str, register: Register) -> Data:
    """Return a picture with its width on paper in mm: it is shrunk to what a page has for it."""
    width, height = picture.size or (WIDTH, 0.0)
    return {
        "file": register(folder, picture),
        "caption": picture.caption,
        "alt": picture.alt,
        "width": width * min(1.0, WIDTH / width, TALLEST / height if height else 1.0),
    }
