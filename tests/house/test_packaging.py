import subprocess
import sys
import tarfile
import zipfile

import pytest

from tests.house.places import ROOT


def build(target, folder):
    """Build `target` into `folder` with the build backend, without isolation; return the file."""
    subprocess.run(
        [sys.executable, "-m", "hatchling", "build", "--target", target, "--directory", str(folder)],
        cwd=ROOT,
        check=True,
        capture_output=True,
    )
    (file,) = folder.iterdir()
    return file


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    with zipfile.ZipFile(build("wheel", tmp_path_factory.mktemp("wheel"))) as archive:
        return set(archive.namelist())


def bench_files():
    return {
        file.relative_to(ROOT).as_posix()
        for folder in ("plants", "scenarios")
        for file in (ROOT / folder).rglob("*")
        if file.is_file() and "__pycache__" not in file.parts
    }


def test_the_wheel_carries_the_bench_below_the_package_and_nothing_beside_it(wheel):
    assert {name for name in wheel if name.startswith("fcl_sim/bench/")} == {
        f"fcl_sim/bench/{name}" for name in bench_files()
    }
    assert {name.split("/")[0].split("-")[0] for name in wheel} == {"fcl_sim"}
    assert "fcl_sim/py.typed" in wheel
    for data in ("diagnostics/pages/*", "fcl/targets/*.toml"):
        assert {file.relative_to(ROOT).as_posix() for file in (ROOT / "fcl_sim").glob(data)} <= wheel


def test_the_source_distribution_holds_all_that_a_build_and_the_tests_need(tmp_path):
    with tarfile.open(build("sdist", tmp_path)) as archive:
        names = {name.partition("/")[2] for name in archive.getnames()}
    assert bench_files() <= names
    for name in (
        "hatch_build.py",
        "LICENSE",
        "README.md",
        "Makefile",
        "requirements.lock",
        "tests/conftest.py",
    ):
        assert name in names
