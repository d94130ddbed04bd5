"""Compiled and as plain Python the loop does the same, and executes every block once in a scan."""

import json
import os
import subprocess
import sys

import numpy as np

from tests.house.places import ROOT
from tests.loop.python_mode import traces


def in_python(what, file):
    """Let `tests.loop.python_mode` write a file, with its kernels as plain Python."""
    command = [sys.executable, "-W", "error", "-m", "tests.loop.python_mode", what, str(file)]
    environment = {**os.environ, "NUMBA_DISABLE_JIT": "1"}
    done = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return file


def test_compiled_and_as_plain_python_every_block_and_shipped_scenario_give_the_same_trace(tmp_path):
    with np.load(in_python("traces", tmp_path / "traces.npz")) as plain:
        compiled = dict(traces(tmp_path))
        assert set(plain) == set(compiled)
        for name, trace in compiled.items():
            assert trace.fault is None, name
            scale = np.abs(trace.values).max(axis=0) + 1.0
            assert plain[name].shape == trace.values.shape, name
            assert np.abs((plain[name] - trace.values) / scale).max() <= 1e-12, name


def test_every_block_is_executed_once_in_every_scan(tmp_path):
    found = json.loads(in_python("counts", tmp_path / "counts.json").read_text("utf-8"))
    assert len(found["counts"]) == found["blocks"]
    assert set(found["counts"].values()) == {found["scans"]}
