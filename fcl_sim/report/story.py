"""The story of a folder of scenarios: its README, which a report tells before them."""

from collections.abc import Sequence
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path
from typing import Any

from fcl_sim.report.markdown import blocks
from fcl_sim.report.provenance import shown
from fcl_sim.report.words import one_line
from fcl_sim.testbench import Outcome

Data = dict[str, Any]

README = "README.md"


@dataclass(frozen=True, slots=True, kw_only=True)
class Story:
    """The README of a folder: its name for a reader, the folder, the text, the SHA-256 of the file in hex."""

    name: str
    folder: Path
    text: str
    digest: str


def stories_of(outcomes: Sequence[Outcome]) -> tuple[Story, ...]:
    """Return the story of each folder of scenarios that has one, in the order of the scenarios."""
    folders = dict.fromkeys(each.scenario.path.parent for each in outcomes)
    return tuple(
        Story(
            name=shown(folder / README),
            folder=folder,
            text=data.decode(errors="replace").replace("\r\n", "\n"),
            digest=sha256(data).hexdigest(),
        )
        for folder in folders
        if (data := _read(folder / README))
    )


def _read(path: Path) -> bytes:
    try:
        return path.read_bytes()
    except OSError:
        return b""


def story_data(stories: Sequence[Story], outcome: Outcome, before: Sequence[Outcome]) -> Data | None:
    """Return the story to be told before an outcome: that of its folder, unless one `before` had it."""
    folder = outcome.scenario.path.parent
    if any(each.scenario.path.parent == folder for each in before):
        return None
    found = next((each for each in stories if each.folder == folder), None)
    if found is None:
        return None
    told = blocks(found.text)
    title = next(iter(told), {})
    named = title.get("kind") == "heading"
    words = "".join(text for text, _ in title["runs"]) if named else found.name
    return {"title": one_line(words), "name": one_line(found.name), "blocks": told[1:] if named else told}
