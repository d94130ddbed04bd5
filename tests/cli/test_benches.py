import pytest

from fcl_sim.cli.benches import bench_here, default_bench, reports_folder, scenario_files
from fcl_sim.diagnostics import InputFault
from fcl_sim.plant.catalog import shipped_bench


@pytest.fixture
def bench(tmp_path):
    folder = tmp_path / "bench"
    for name in (
        "scenarios/crane/transfer.toml",
        "scenarios/crane/crane.controller.toml",
        "scenarios/tank.toml",
    ):
        file = folder / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.touch()
    return folder


def names(files, folder):
    return [file.relative_to(folder).as_posix() for file in files]


def test_a_bench_is_found_from_any_folder_inside_it(bench):
    assert bench_here(bench) == bench_here(bench / "scenarios" / "crane") == bench


def test_where_there_is_no_bench_the_shipped_one_is_run_and_reports_stay_here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert bench_here(tmp_path) is None
    assert default_bench() == shipped_bench()
    assert reports_folder() == tmp_path / "reports"


def test_reports_of_a_bench_are_written_into_it(bench, monkeypatch):
    monkeypatch.chdir(bench / "scenarios")
    assert default_bench() == bench
    assert reports_folder() == bench / "reports"


def test_a_shipped_bench_is_never_written_to(bench, monkeypatch):
    monkeypatch.setattr("fcl_sim.cli.benches.PACKAGE", bench.parent)
    monkeypatch.chdir(bench)
    with pytest.raises(InputFault) as caught:
        reports_folder()
    assert str(caught.value) == (
        f"{bench}: error[RUN102]: the shipped bench is never written to\n  hint: name a folder with --reports"
    )


def test_a_folder_stands_for_its_scenarios_without_the_controllers(bench):
    assert names(scenario_files((bench,)), bench) == ["scenarios/crane/transfer.toml", "scenarios/tank.toml"]
    assert names(scenario_files((bench / "scenarios" / "crane",)), bench) == ["scenarios/crane/transfer.toml"]


def test_a_scenario_that_is_named_twice_is_run_once(bench):
    file = bench / "scenarios" / "tank.toml"
    assert scenario_files((file, bench)) == (file, bench / "scenarios" / "crane" / "transfer.toml")


def test_every_path_without_a_scenario_is_named(bench):
    empty = bench / "plants"
    empty.mkdir()
    missing = bench / "scenarios" / "tonk.toml"
    with pytest.raises(InputFault) as caught:
        scenario_files((empty, missing, bench / "no" / "where"))
    assert str(caught.value).splitlines() == [
        f"{empty}: error[RUN105]: there is no scenario below this folder",
        "  hint: a scenario is a .toml file whose name does not end in .controller.toml or .waivers.toml",
        f"{missing}: error[RUN105]: there is no such file or folder",
        f"  hint: did you mean {bench / 'scenarios' / 'tank.toml'}?",
        f"{bench / 'no' / 'where'}: error[RUN105]: there is no such file or folder",
    ]
