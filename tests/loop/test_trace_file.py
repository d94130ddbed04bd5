import csv

import numpy as np
import pytest

from fcl_sim.diagnostics import InputFault
from fcl_sim.loop import trace_file
from fcl_sim.loop.trace import Trace


@pytest.fixture
def trace():
    ticks = np.array([0, 50_000_000, 100_000_000], dtype=np.int64)
    values = np.array([[-25.0, 0.1], [-24.999999999999996, 1e-300], [np.nan, np.inf]])
    return Trace(
        ticks=ticks,
        names=("crane.distance", "a, b"),
        units={"crane.distance": "m", "a, b": ""},
        values=values,
    )


def test_a_csv_has_the_units_in_its_header_and_loses_no_digit(trace, tmp_path):
    trace_file.write(trace, tmp_path / "x.csv")
    with (tmp_path / "x.csv").open(newline="", encoding="utf-8") as file:
        header, *rows = csv.reader(file)
    assert header == ["time [s]", "crane.distance [m]", "a, b [1]"]
    read = np.array([[float(cell) for cell in row] for row in rows])
    assert np.array_equal(read, np.column_stack([[0.0, 0.05, 0.1], trace.values]), equal_nan=True)


def test_an_npz_holds_the_ticks_and_every_bit(trace, tmp_path):
    trace_file.write(trace, tmp_path / "x.npz")
    with np.load(tmp_path / "x.npz", allow_pickle=False) as read:
        assert np.array_equal(read["ticks"], trace.ticks)
        assert read["values"].tobytes() == trace.values.tobytes()
        assert (tuple(read["names"]), tuple(read["units"])) == (trace.names, ("m", ""))


def test_another_ending_is_refused(trace, tmp_path):
    with pytest.raises(InputFault) as caught:
        trace_file.write(trace, tmp_path / "x.xlsx")
    assert str(caught.value) == (
        f"{tmp_path / 'x.xlsx'}: error[RUN104]: a trace is not written as `.xlsx`\n"
        "  hint: end the name in .csv or .npz"
    )


@pytest.mark.parametrize("name", ["x.csv", "x.npz"])
def test_a_trace_that_cannot_be_written_whole_is_not_written(trace, tmp_path, name, monkeypatch):
    def full(*_arguments, **_options):
        raise OSError(28, "No space left on device")

    (tmp_path / name).write_text("yesterday's")
    monkeypatch.setattr(trace_file.np, "column_stack", full)
    monkeypatch.setattr(trace_file.np, "savez_compressed", full)
    with pytest.raises(OSError, match="No space left"):
        trace_file.write(trace, tmp_path / name)
    assert [(file.name, file.read_text()) for file in tmp_path.iterdir()] == [(name, "yesterday's")]
