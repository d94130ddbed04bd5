"""The cache of machine code, on a package of two kernels in two files with our own room jit."""

import os
import shutil
import subprocess
import sys

import pytest

from tests.house.places import PACKAGE

INNER = """
from fcl_sim.jit import kernel


@kernel
def inner(value):
    return value + 1.0
"""

OUTER = """
from fcl_sim.arithmetic.inner import inner
from fcl_sim.jit import entry, f8, signature


@entry(signature(f8, f8))
def outer(value):
    return inner(value)
"""

MAIN = """
import numba
from fcl_sim.engine.outer import outer

before = numba.config.CACHE_DIR
result = outer(1.0)
assert numba.config.CACHE_DIR == before
print(result, sum(outer.compile().stats.cache_hits.values()))
"""


@pytest.fixture
def package(tmp_path):
    folder = tmp_path / "here" / "fcl_sim"
    for room in ("arithmetic", "engine"):
        (folder / room).mkdir(parents=True)
        (folder / room / "__init__.py").touch()
    (folder / "__init__.py").touch()
    shutil.copytree(PACKAGE / "jit", folder / "jit", ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copy(PACKAGE / "kernel_cache.py", folder)
    (folder / "arithmetic" / "inner.py").write_text(INNER)
    (folder / "engine" / "outer.py").write_text(OUTER)
    return folder


def run(package, **settings):
    """Run the package in a process of its own; return its result and the number of cache hits."""
    environment = {name: value for name, value in os.environ.items() if not name.startswith("NUMBA_")}
    environment |= {"FCL_SIM_CACHE_DIR": str(package.parents[1] / "cache")}
    environment |= {name: str(value) for name, value in settings.items()}
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", MAIN],
        cwd=package.parent,
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.stderr == ""
    result, hits = done.stdout.split()
    return float(result), int(hits)


def test_a_second_process_compiles_nothing(package):
    assert run(package) == (2.0, 0)
    assert run(package) == (2.0, 1)


def test_an_edit_in_a_called_kernel_of_another_file_is_noticed(package):
    assert run(package) == (2.0, 0)
    (package / "arithmetic" / "inner.py").write_text(INNER.replace("1.0", "41.0"))
    assert run(package) == (42.0, 0)
    (package / "arithmetic" / "inner.py").write_text(INNER)
    assert run(package) == (2.0, 1)


def test_a_cache_that_cannot_be_written_breaks_nothing(package, tmp_path):
    (tmp_path / "file").touch()
    assert run(package, FCL_SIM_CACHE_DIR=tmp_path / "file" / "below") == (2.0, 0)


@pytest.mark.parametrize("rubbish", [b"", None], ids=["empty", "cut off"])
def test_a_spoilt_cache_breaks_nothing(package, tmp_path, rubbish):
    assert run(package) == (2.0, 0)
    files = [file for file in (tmp_path / "cache").rglob("*") if file.is_file()]
    assert len(files) == 2
    for file in files:
        file.write_bytes(file.read_bytes()[: file.stat().st_size // 2] if rubbish is None else rubbish)
    assert run(package) == (2.0, 0)
    assert run(package)[0] == 2.0


def test_the_settings_of_numba_are_left_alone(package, tmp_path):
    theirs = tmp_path / "theirs"
    theirs.mkdir()
    assert run(package, NUMBA_CACHE_DIR=theirs) == (2.0, 0)
    assert list(theirs.iterdir()) == []


def test_old_caches_are_forgotten(package, tmp_path):
    for number in range(40):
        old = tmp_path / "cache" / f"{number:024}"
        old.mkdir(parents=True)
        os.utime(old, (number, number))
    run(package)
    left = sorted((tmp_path / "cache").iterdir(), key=lambda folder: folder.stat().st_mtime)
    assert [folder.name[-2:] for folder in left[:-1]] == [f"{number:02}" for number in range(17, 40)]


def test_a_cache_that_is_used_is_not_old_however_long_ago_it_was_made(package, tmp_path):
    run(package)
    (used,) = (tmp_path / "cache").iterdir()
    os.utime(used, (0, 0))
    assert run(package) == (2.0, 1)
    for number in range(1, 24):
        other = tmp_path / "cache" / f"{number:024}"
        other.mkdir()
        os.utime(other, (number, number))
    (package / "arithmetic" / "inner.py").write_text(INNER.replace("1.0", "41.0"))
    assert run(package) == (42.0, 0)
    assert used.is_dir()
