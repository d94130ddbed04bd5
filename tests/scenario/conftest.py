"""A bench in a folder of its own, with the shipped crane in it, that tests change and read.

Its transfer is a text of the tests' own, without an envelope: messages name its lines.
"""

import shutil
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import pytest

from fcl_sim.diagnostics import InputFault
from fcl_sim.plant.catalog import shipped_bench
from fcl_sim.scenario.model import Scenario
from fcl_sim.scenario.reader import read
from fcl_sim.testbench import prepare

FOLDER = Path("scenarios/crane")


@dataclass(frozen=True)
class Bench:
    """The current folder is the bench; files are edited by replacing text."""

    folder: Path

    def edit(self, name: str, *edits: tuple[str, str]) -> None:
        file = FOLDER / name
        text = file.read_text("utf-8")
        for before, after in edits:
            assert before in text
            text = text.replace(before, after, 1)
        file.write_text(text, "utf-8")

    def read(self, name: str = "transfer.toml", **overrides: object) -> Scenario:
        return read(FOLDER / name, {key.replace("__", "."): value for key, value in overrides.items()})

    def fault(self, name: str = "transfer.toml", overrides: dict[str, object] | None = None) -> str:
        """Return what a user reads when the scenario is prepared."""
        with pytest.raises(InputFault) as caught:
            prepare(read(FOLDER / name, overrides))
        return str(caught.value)


@pytest.fixture
def bench(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Bench:
    shutil.copytree(shipped_bench() / FOLDER, tmp_path / FOLDER)
    shutil.copy(Path(__file__).with_name("transfer.toml"), tmp_path / FOLDER)
    monkeypatch.chdir(tmp_path)
    return Bench(tmp_path)


@pytest.fixture
def written(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[[str], str]:
    """Write a scenario text of one's own, prepare it, return what a user reads."""
    (tmp_path / "scenarios").mkdir(exist_ok=True)
    monkeypatch.chdir(tmp_path)

    def fault(text: str) -> str:
        file = Path("scenarios/own.toml")
        file.write_text(text, "utf-8")
        with pytest.raises(InputFault) as caught:
            prepare(read(file))
        return str(caught.value)

    return fault
