"""A report made later is the report made then, without simulating; other results are refused."""

import json
import zipfile

import pytest

from fcl_sim.diagnostics import InputFault
from fcl_sim.report import archive, write
from fcl_sim.report.writer import write_stored
from tests.report.synthetic import outcome, run


@pytest.fixture(scope="module")
def reports(tmp_path_factory):
    inputs, folder = tmp_path_factory.mktemp("inputs"), tmp_path_factory.mktemp("reports")
    (inputs / "other").mkdir()
    first = outcome(inputs, run(inputs), run(inputs, "raw_distance", "swings"))
    second = outcome(inputs / "other", run(inputs / "other"), name="crane/other", title="Another")
    write([first, second], folder)
    for file in sorted(inputs.rglob("*"), reverse=True):
        file.unlink() if file.is_file() else file.rmdir()
    return folder


def test_it_is_the_same_bytes_though_the_inputs_are_gone(reports, tmp_path):
    write_stored(archive.read(reports / "results.json"), tmp_path)
    for name in ("report.pdf", "results.json", "results.npz"):
        assert (tmp_path / name).read_bytes() == (reports / name).read_bytes()


def test_some_scenarios_are_chosen_by_their_names(reports):
    stored = archive.read(reports / "results.json")
    chosen = archive.chosen(stored, ["crane/other"])
    assert [each.scenario.title for each in chosen.outcomes] == ["Another"]
    assert chosen.covered == tuple(each for each in stored.covered if "crane/other/base" in each.runs)
    with pytest.raises(InputFault, match="did you mean `crane/other`"):
        archive.chosen(stored, ["crane/othr"])


def test_results_without_their_runs_are_told_where_these_belong(reports, tmp_path):
    alone = tmp_path / "results.json"
    alone.write_bytes((reports / "results.json").read_bytes())
    with pytest.raises(InputFault, match="the runs of these results are not beside them"):
        archive.read(alone)
    with pytest.raises(InputFault, match="there are no such results"):
        archive.read(tmp_path / "nothing.json")


def test_the_runs_of_other_results_are_refused(reports, tmp_path):
    for name in ("results.json", "results.npz"):
        (tmp_path / name).write_bytes((reports / name).read_bytes())
    (tmp_path / "results.json").write_text(json.dumps({"schema": 1}))
    with pytest.raises(InputFault, match="it belongs to other results"):
        archive.read(tmp_path / "results.json")


def test_runs_of_another_version_are_refused(reports, tmp_path):
    (tmp_path / "results.json").write_bytes((reports / "results.json").read_bytes())
    with (
        zipfile.ZipFile(reports / "results.npz") as before,
        zipfile.ZipFile(tmp_path / "results.npz", "w") as new,
    ):
        nouns = json.loads(before.read(archive.NOUNS))
        new.writestr(archive.NOUNS, json.dumps(nouns | {"fcl_sim": "0.0.1"}))
    with pytest.raises(InputFault, match=r"it was written by fcl_sim 0\.0\.1"):
        archive.read(tmp_path / "results.json")


def test_half_a_file_is_refused(reports, tmp_path):
    (tmp_path / "results.json").write_bytes((reports / "results.json").read_bytes())
    whole = (reports / "results.npz").read_bytes()
    (tmp_path / "results.npz").write_bytes(whole[: len(whole) // 2])
    with pytest.raises(InputFault, match="no report can be made of it"):
        archive.read(tmp_path / "results.json")
