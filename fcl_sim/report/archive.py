"""Outcomes in a file beside `results.json`, from which a report is made later without simulating again.

It is an NPZ of all numbers, with all nouns in `nouns.json`. It belongs to the
version of fcl_sim that wrote it and to the results.json beside it; with any
other it is refused, as it might say something else.
"""

import json
import zipfile
from collections.abc import Sequence
from dataclasses import dataclass, replace
from hashlib import sha256
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fcl_sim import __version__
from fcl_sim.diagnostics import InputFault, nearest
from fcl_sim.diagnostics.spelling import listed
from fcl_sim.report.codec import Unreadable, decoded, encoded
from fcl_sim.report.proved import Proved
from fcl_sim.report.provenance import Origin
from fcl_sim.report.story import Story
from fcl_sim.testbench import Outcome
from fcl_sim.verify.coverage import Coverage

SUFFIX = ".npz"
NOUNS = "nouns.json"


@dataclass(frozen=True, slots=True, kw_only=True)
class Stored:
    """All that a report is made of: outcomes, coverage and proofs of their rule bases, and their origin."""

    outcomes: tuple[Outcome, ...]
    covered: tuple[Coverage, ...]
    proofs: tuple[Proved, ...]
    stories: tuple[Story, ...]
    origin: Origin


def beside(results: Path) -> Path:
    """Return the file of outcomes that belongs to a `results.json`."""
    return results.with_suffix(SUFFIX)


def write(stored: Stored, results: str, path: Path) -> None:
    """Write what a report is made of to `path`, always in the same bytes; `results` is the JSON beside it."""
    document, pools = encoded(stored)
    head = {"fcl_sim": __version__, "results": _digest(results)}
    with zipfile.ZipFile(path, "w") as file:
        file.writestr(zipfile.ZipInfo(NOUNS), json.dumps(head | document, allow_nan=False))
        for kind, pool in pools.items():
            with file.open(zipfile.ZipInfo(f"{kind}.npy"), "w", force_zip64=True) as part:
                np.lib.format.write_array(part, pool, allow_pickle=False)


def read(results: Path) -> Stored:
    """Return what was written beside a `results.json`.

    InputFault where it is not there, not whole, of another version, or of
    other results.
    """
    path = beside(results)
    try:
        text = results.read_text(encoding="utf-8")
        with zipfile.ZipFile(path) as file:
            document = json.loads(file.read(NOUNS))
            _check(document, text, results)
            stored = decoded(document, _pools(file))
    except FileNotFoundError as error:
        raise _missing(results, Path(error.filename)) from error
    except (zipfile.BadZipFile, Unreadable, KeyError, ValueError) as error:
        raise _refused(path, f"it is not what `fcl-sim run` writes ({error})") from error
    if not isinstance(stored, Stored):
        raise _refused(path, "it is not what `fcl-sim run` writes")
    return stored


def _pools(file: zipfile.ZipFile) -> dict[str, NDArray[Any]]:
    pools = {}
    for name in file.namelist():
        if name.endswith(".npy"):
            with file.open(name) as part:
                pools[name.removesuffix(".npy")] = np.lib.format.read_array(part, allow_pickle=False)
    return pools


def _check(document: dict[str, Any], results: str, path: Path) -> None:
    if document["fcl_sim"] != __version__:
        told = f"it was written by fcl_sim {document['fcl_sim']}, and this is {__version__}"
        raise _refused(beside(path), told)
    if document["results"] != _digest(results):
        raise _refused(beside(path), f"it belongs to other results than `{path.name}`")


def _digest(results: str) -> str:
    return sha256(results.encode()).hexdigest()


def _missing(results: Path, lacking: Path) -> InputFault:
    if lacking == results:
        return InputFault.at_file("RUN204", str(results), "there are no such results", AGAIN)
    hint = f"`fcl-sim run` writes `{lacking.name}` beside it; keep the two together"
    return InputFault.at_file("RUN204", str(results), "the runs of these results are not beside them", hint)


AGAIN = "`fcl-sim run` writes them anew"


def _refused(path: Path, why: str) -> InputFault:
    return InputFault.at_file("RUN204", str(path), f"no report can be made of it: {why}", AGAIN)


def chosen(stored: Stored, names: Sequence[str]) -> Stored:
    """Return what is stored of some scenarios, by their names; of all where none is named.

    How far their rule bases were exercised stays that of all runs, which it
    names. InputFault where there is none of a name.
    """
    if not names:
        return stored
    known = {each.scenario.name: each for each in stored.outcomes}
    for name in names:
        if name not in known:
            near = nearest(name, known)
            hint = f"did you mean `{near}`?" if near else f"there are {listed(list(known))}"
            raise InputFault.at_file("RUN205", "", f"there are no results of a scenario `{name}`", hint)
    outcomes = tuple(known[name] for name in dict.fromkeys(names))
    labels = {f"{each.scenario.name}/{variant}" for each in outcomes for variant in each.variants}
    covered = tuple(each for each in stored.covered if not labels.isdisjoint(each.runs))
    return replace(stored, outcomes=outcomes, covered=covered)
