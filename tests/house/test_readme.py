import re
import subprocess
import sys

from tests.house.places import ROOT

README = (ROOT / "README.md").read_text("utf-8")
BLOCKS = dict(re.findall(r"^```(python|)\n(.*?)^```$", README, re.MULTILINE | re.DOTALL))


def test_the_ten_lines_print_what_the_readme_says():
    done = subprocess.run(
        [sys.executable, "-c", BLOCKS["python"]], cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert (done.stdout, done.stderr) == (BLOCKS[""], "")


def test_every_file_that_the_readme_and_the_docs_point_to_is_there():
    for page in [ROOT / "README.md", *(ROOT / "docs").rglob("*.md")]:
        for target in re.findall(r"\]\(([^)#]+)(?:#[\w-]+)?\)", page.read_text("utf-8")):
            assert (page.parent / target).exists(), f"{page.name}: {target}"


def test_every_command_that_the_readme_shows_is_there():
    from fcl_sim.cli.program import COMMANDS

    shown = set(re.findall(r"^ {4}fcl-sim (\w+)", README, re.MULTILINE))
    assert shown <= set(COMMANDS)
    assert len(shown) > 4
