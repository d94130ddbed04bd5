"""Plants are found in the bench first, then among the shipped ones."""

import pytest

from fcl_sim.diagnostics import InputFault
from fcl_sim.plant.catalog import find, shipped_bench
from tests.plant.tanks import GOOD


def test_the_shipped_crane_is_found_without_a_bench():
    assert find("crane").path == shipped_bench() / "plants" / "crane.py"


def test_a_plant_of_the_bench_comes_before_a_shipped_one(tmp_path):
    (tmp_path / "plants").mkdir()
    own = tmp_path / "plants" / "crane.py"
    own.write_text(GOOD, encoding="utf-8")
    assert find("crane", tmp_path).path == own


def test_a_plant_of_the_bench_is_read_anew_when_its_file_changes(tmp_path):
    (tmp_path / "plants").mkdir()
    own = tmp_path / "plants" / "tank.py"
    own.write_text(GOOD, encoding="utf-8")
    first = find("tank", tmp_path)
    own.write_text(GOOD.replace('title="tank"', 'title="another"'), encoding="utf-8")
    assert find("tank", tmp_path).declaration.title == "another"
    assert find("tank", tmp_path).digest != first.digest


def test_an_unknown_plant_is_refused_with_the_nearest_name():
    with pytest.raises(InputFault) as caught:
        find("crain")
    assert (
        str(caught.value) == "error[PLT101]: there is no plant called `crain`\n  hint: did you mean `crane`?"
    )


def test_nothing_of_a_plant_file_lands_among_the_importable_names(tmp_path):
    (tmp_path / "plants").mkdir()
    (tmp_path / "plants" / "tank.py").write_text(GOOD, encoding="utf-8")
    find("tank", tmp_path)
    with pytest.raises(ModuleNotFoundError):
        __import__("tank")
