import ast
import re

import pytest
from importlinter.cli import lint_imports

from fcl_sim.diagnostics.codes import CODES
from tests.house.places import PACKAGE, ROOT, own_files

CODE = re.compile(r"[A-Z]{3}\d{3}")
CEILING = 400

PACKAGES = sorted(file.parent for file in PACKAGE.rglob("__init__.py"))
SOURCES = [file for file in own_files("*.py") if ROOT / "tests" not in file.parents]


def test_every_source_file_stays_under_the_ceiling():
    lengths = {str(file.relative_to(ROOT)): len(file.read_text("utf-8").splitlines()) for file in SOURCES}
    assert {name: lines for name, lines in lengths.items() if lines >= CEILING} == {}


@pytest.mark.parametrize("package", PACKAGES[1:], ids=lambda package: package.name)
def test_every_room_says_what_comes_in_and_goes_out(package):
    text = ast.get_docstring(ast.parse((package / "__init__.py").read_text("utf-8"))) or ""
    assert 4 <= len(text.splitlines()) <= 8
    for word in ("In:", "Out:", "mport", "Tests:"):
        assert word in text


def test_every_room_has_its_tests():
    rooms = {package.name for package in PACKAGES if package.parent == PACKAGE}
    tested = {file.parent.name for file in (ROOT / "tests").rglob("test_*.py")}
    assert rooms - tested - {"model"} == set()


def test_the_floors_hold():
    assert lint_imports(config_filename=str(ROOT / "pyproject.toml"), no_cache=True) == 0


def test_every_code_in_the_sources_is_in_the_table_and_the_other_way_round():
    used = {
        node.value
        for file in own_files("*.py")
        if PACKAGE in file.parents and file != PACKAGE / "diagnostics" / "codes.py"
        for node in ast.walk(ast.parse(file.read_text("utf-8")))
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and CODE.fullmatch(node.value)
    }
    assert used == set(CODES)


def test_the_table_of_codes_is_sorted_and_each_title_is_one_line():
    assert list(CODES) == sorted(CODES)
    assert [title for title in CODES.values() if "\n" in title or not title.strip()] == []


# Built from parts, so that this file does not find itself.
HOSTS = [".".join(parts) for parts in (("pypi", "org"), ("pythonhosted", "org"), ("npmjs", "org"))]
FOLDERS = [f"/{name}/" for name in ("tmp", "root", "home", "work", "opt")]


def test_no_file_names_a_registry_or_a_path_of_one_machine():
    found = []
    for file in own_files():
        try:
            text = file.read_text("utf-8")
        except UnicodeDecodeError:
            continue  # a picture
        found += [f"{file.relative_to(ROOT)}: {word}" for word in HOSTS + FOLDERS if word in text]
    assert found == []


PIN = r"^[a-z0-9-]+==[^\\]+\\\n(?: +--hash=sha256:[0-9a-f]{64}(?: \\)?\n)+"


def test_the_locks_hold_every_file_to_a_hash_and_agree():
    complete, needed = (
        (ROOT / name).read_text("utf-8") for name in ("requirements.lock", "requirements-run.lock")
    )
    for text in (complete, needed):
        pins = re.findall(
            r"^[a-z0-9-]+==[^\\]+\\\n(?: +--hash=sha256:[0-9a-f]{64}(?: \\)?\n)+", text, re.MULTILINE
        )
        assert len(pins) == len(re.findall(r"^\S+==", text, re.MULTILINE)) > 0
        assert re.findall(r"^\s*-(?!-hash)|file:", text, re.MULTILINE) == []
    pinned = set(re.findall(r"^(\S+==\S+)", complete, re.MULTILINE))
    assert set(re.findall(r"^(\S+==\S+)", needed, re.MULTILINE)) <= pinned
