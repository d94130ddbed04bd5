import re
import subprocess
import sys

import pytest

from tests.house.places import ROOT

HEAVY = {
    "control",
    "llvmlite",
    "matplotlib",
    "numba",
    "numpy",
    "pandas",
    "plotly",
    "pydantic",
    "rich",
    "scipy",
    "typst",
}


def imported(*arguments):
    """Return the top-level modules that a Python process imports."""
    result = subprocess.run(
        [sys.executable, "-X", "importtime", *arguments], cwd=ROOT, capture_output=True, text=True, check=True
    )
    return {
        name.split(".")[0] for name in re.findall(r"^import time:.*\| +(\S+)$", result.stderr, re.MULTILINE)
    }


@pytest.mark.parametrize(
    "arguments",
    [
        ("-c", "import fcl_sim"),
        ("-m", "fcl_sim", "--help"),
        ("-m", "fcl_sim", "--version"),
        ("-m", "fcl_sim", "explain", "FCL310"),
    ],
    ids=["import fcl_sim", "--help", "--version", "explain"],
)
def test_nothing_heavy_is_loaded_before_it_is_needed(arguments):
    modules = imported(*arguments)
    assert "fcl_sim" in modules
    assert modules & HEAVY == set()
