"""The page of each code: what it means, why it is a fault, and how it is mended.

The pages stand in `pages/*.toml`, a table per code, and are read when somebody
asks for one.
"""

import re
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from types import MappingProxyType

from fcl_sim.diagnostics.codes import CODES
from fcl_sim.diagnostics.diagnostic import Severity

FAMILIES = {
    "FCL1": "Rule bases: the file and its characters",
    "FCL2": "Rule bases: grammar",
    "FCL3": "Rule bases: names and meaning",
    "FCL4": "Rule bases: evaluation",
    "FCL5": "Rule bases: levels and conformance",
    "FCL6": "Rule bases: what the rules say together",
    "JDG": "Requirements and traces",
    "MTX": "Rule bases as matrices",
    "PLT": "Plants",
    "RUN": "The run and its surroundings",
    "SCN": "Scenarios and controllers",
    "VER": "Coverage, waivers and replays",
    "WIR": "Wiring of a loop",
}
"""By the beginning of their codes; those without a code are not shown."""

LANGUAGES = {"FCL": "fcl", "MTX": "csv", "PLT": "python", "RUN": "console"}
"""What the examples are written in; TOML where nothing is said."""

_FOLDER = "pages"
_FRAME = "bath.fcl"
_COMPLETE = "bath_complete.fcl"
_PROSE = re.compile(r"\s*\n\s*")


@dataclass(frozen=True, slots=True, kw_only=True)
class Page:
    """What is to be said about one code.

    `rule` is the clause of IEC 61131-7 and our reading of it (S1 …), or empty.
    `within` is the section of the frame in which the examples stand, empty
    where they are whole texts. `severity` is the usual one, `language` what the
    examples are written in, as Markdown calls it.
    """

    code: str
    severity: Severity
    language: str
    means: str
    why: str
    bad: str
    mended: str
    rule: str = ""
    within: str = ""

    @property
    def title(self) -> str:
        """One line, which begins like the rest of a sentence."""
        return CODES[self.code]


def family(code: str) -> str:
    """Return the beginning of a code, by which its family is known."""
    return code[:4] if code[:4] in FAMILIES else code[:3]


def page(code: str) -> Page:
    """Return the page of a code; KeyError where there is no such code."""
    return pages()[code]


@cache
def pages() -> Mapping[str, Page]:
    """Return all pages, in the order of their codes."""
    found: dict[str, Page] = {}
    for file in files("fcl_sim.diagnostics").joinpath(_FOLDER).iterdir():
        if not file.name.endswith(".toml"):
            continue
        for code, table in tomllib.loads(file.read_text("utf-8")).items():
            if code in found:
                raise ValueError(f"{code} has two pages, one of them in {file.name}")
            found[code] = _page(code, table)
    return MappingProxyType({code: found[code] for code in sorted(found)})


def _page(code: str, table: Mapping[str, str]) -> Page:
    return Page(
        code=code,
        severity=Severity(table["severity"]),
        language=table.get("language") or LANGUAGES.get(code[:3], "toml"),
        means=_prose(table["means"]),
        why=_prose(table["why"]),
        bad=table["bad"].strip("\n"),
        mended=table["mended"].strip("\n"),
        rule=table.get("rule", ""),
        within=table.get("within", ""),
    )


def _prose(text: str) -> str:
    return _PROSE.sub(" ", text.strip())


def frame(*, complete: bool = False) -> str:
    """Return the rule base in which the FCL examples stand, or one of which a proof finds nothing, too."""
    name = _COMPLETE if complete else _FRAME
    return files("fcl_sim.diagnostics").joinpath(_FOLDER, name).read_text("utf-8")


def framed(example: str, within: str, *, complete: bool = False) -> str:
    """Return an FCL example as a whole text, as it can be read.

    It takes the place of what stands in the section `within` of the frame, of
    its rules where that is RULE.
    """
    if not within:
        return f"{example}\n"
    pattern = r"(?:^    RULE.*\n)+" if within == "RULE" else rf"(?<=^{within}\n)(?:    .*\n)+"
    lines = "".join(f"    {line}".rstrip() + "\n" for line in example.splitlines())
    text, count = re.subn(pattern, lambda _: lines, frame(complete=complete), count=1, flags=re.MULTILINE)
    if not count:
        raise ValueError(f"the frame has no section `{within}`")
    return text
