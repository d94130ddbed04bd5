"""A trace is read back as it was written, and a recorded one as it was meant, or its fault is shown."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fcl_sim.diagnostics import InputFault
from fcl_sim.loop.trace import FuzzyRecord, Trace
from fcl_sim.loop.trace_file import write
from fcl_sim.loop.trace_reader import read

TICKS = np.array([0, 50_000_000, 100_000_001], dtype=np.int64)
VALUES = np.array([[-25.0, 0.1], [-24.999999999999996, 1e-300], [np.nan, np.inf]])
TRACE = Trace(TICKS, ("crane.distance", "a, b"), {"crane.distance": "m", "a, b": ""}, VALUES)


@pytest.mark.parametrize("name", ["x.csv", "x.npz", "X.CSV"])
def test_what_was_written_is_read_back_to_the_last_bit(tmp_path, name):
    write(TRACE, tmp_path / name)
    found = read(tmp_path / name)
    assert (found.names, dict(found.units)) == (TRACE.names, dict(TRACE.units))
    assert found.ticks.tolist() == TICKS.tolist()
    assert np.array_equal(found.values, VALUES, equal_nan=True)


def of_rules(outputs, cold=()):
    """Return a record of three samples of the block `rules`, with two rules of one label."""
    return FuzzyRecord(
        input_names=("distance", "color.brown"),
        output_names=outputs,
        rule_labels=("3a", "3a (2)", "No 1.(x)"),
        inputs=np.array([[1.0, 0.1], [2.0, np.nan], [3.0, 1e-300]]),
        outputs=np.arange(3.0 * len(outputs)).reshape(3, -1),
        degrees=np.linspace(0.0, 1.0, 9).reshape(3, 3),
        flags=np.array([[True], [False], [True]]) & np.ones(len(outputs), np.bool_),
        cold=cold,
        units={"distance": "m", "color.brown": "", **dict.fromkeys(outputs, "kW")},
    )


@pytest.mark.parametrize("name", ["x.csv", "x.npz"])
@pytest.mark.parametrize(
    ("signals", "record"),
    [
        (("crane.distance", "rules"), of_rules(("power",))),
        (("crane.distance", "rules"), of_rules(("power",), cold=(1, 2))),
        (("crane.distance", "rules.brake", "rules.power"), of_rules(("power", "brake"))),
    ],
)
def test_what_was_recorded_of_the_rules_is_read_back_with_the_signals(tmp_path, name, signals, record):
    outputs = dict(zip(record.output_names, record.outputs.T, strict=True))
    columns = [outputs.get(each.removeprefix("rules."), record.outputs[:, 0]) for each in signals]
    units = dict.fromkeys(signals, "kW") | {"crane.distance": "m"}
    write(Trace(TICKS, signals, units, np.column_stack(columns), {"rules": record}), tmp_path / name)
    found = read(tmp_path / name)
    assert (found.names, dict(found.units)) == (signals, units)
    assert np.array_equal(found.values, np.column_stack(columns))
    back = found.fuzzy["rules"]
    for part in ("inputs", "outputs", "degrees", "active"):
        assert np.array_equal(getattr(back, part), getattr(record, part), equal_nan=part != "active")
    for part in ("input_names", "output_names", "rule_labels", "cold", "units"):
        assert getattr(back, part) == getattr(record, part)


def test_columns_that_make_no_whole_record_are_signals(tmp_path):
    text = "time [s],rules.active(power) [1],rules.degree(1) [1]\n0,1,0.5\n"
    found = recorded(tmp_path, text)
    assert found.names == ("rules.active(power)", "rules.degree(1)")
    assert not found.fuzzy


@given(st.lists(st.integers(0, 10**15), min_size=1, max_size=30, unique=True))
def test_every_nanosecond_of_eleven_days_survives_a_csv(tmp_path_factory, ticks):
    path = tmp_path_factory.mktemp("ticks") / "x.csv"
    given_ = np.array(sorted(ticks), dtype=np.int64)
    write(Trace(given_, ("y",), {"y": "m"}, np.zeros((len(ticks), 1))), path)
    assert read(path).ticks.tolist() == given_.tolist()


def recorded(tmp_path, text, name="log.csv", encoding="utf-8"):
    path = tmp_path / name
    path.write_bytes(text.encode(encoding))
    return read(path)


def test_a_logger_may_have_other_separators_units_and_line_ends(tmp_path):
    text = '\ufefftime [ms]; Temp 1 [°C] ;valve [%]\r\n0;20,5;\r\n\r\n500;"21";1e1\r\n'
    found = recorded(tmp_path, text)
    assert found.ticks.tolist() == [0, 500_000_000]
    assert dict(found.units) == {"Temp 1": "degC", "valve": "%"}
    assert np.array_equal(found.values, [[20.5, np.nan], [21.0, 10.0]], equal_nan=True)


def test_a_header_alone_is_a_trace_without_a_scan(tmp_path):
    assert recorded(tmp_path, "time [s],y [m]\n").values.shape == (0, 1)


FAULTS = {
    "no unit": (
        "time [s],crane.distance\n0,1\n",
        """\
log.csv:1:1: error[JDG302]: the column `crane.distance` has no unit
  1 | time [s],crane.distance
    | ^^^^^^^^^^^^^^^^^^^^^^^
  hint: write each as NAME [UNIT], as in crane.distance [m], with [1] for no unit""",
    ),
    "an unknown unit": (
        "time [s],y [metre]\n",
        """\
log.csv:1:1: error[JDG302]: the column `y`: there is no unit `metre`
  1 | time [s],y [metre]
    | ^^^^^^^^^^^^^^^^^^""",
    ),
    "one name twice": (
        "time [s],y [m],y [m]\n",
        """\
log.csv:1:1: error[JDG302]: two columns are called `y`
  1 | time [s],y [m],y [m]
    | ^^^^^^^^^^^^^^^^^^^^""",
    ),
    "no time": (
        "y [m],time [s]\n",
        """\
log.csv:1:1: error[JDG302]: the first column is not the time
  1 | y [m],time [s]
    | ^^^^^^^^^^^^^^
  hint: begin the header with time [s]""",
    ),
    "a cell that is no number": (
        "time [s],y [m]\n0,1\n1,n/a\n",
        """\
log.csv:3:1: error[JDG303]: `n/a` is no number
  3 | 1,n/a
    | ^^^^^
  hint: an empty cell stands for what was not recorded""",
    ),
    "a cell too many": (
        "time [s],y [m]\n0,1,2\n",
        """\
log.csv:2:1: error[JDG303]: the line has 3 cells, and the header has 2
  2 | 0,1,2
    | ^^^^^""",
    ),
    "times that fall": (
        "time [s],y [m]\n0,1\n2,1\n1,1\n",
        """\
log.csv: error[JDG304]: the times do not rise: 1 s comes after 2 s, in sample 3
  hint: sort the samples, and keep one of each time""",
    ),
    "a time that is missing": (
        "time [s],y [m]\n,1\n",
        "log.csv: error[JDG304]: a time is missing, or no trace is so long",
    ),
    "nothing at all": (
        "",
        """\
log.csv:1:1: error[JDG302]: the first column is not the time
  1 |
    | ^
  hint: begin the header with time [s]""",
    ),
}


@pytest.mark.parametrize("name", FAULTS)
def test_a_fault_of_a_recording_is_shown(tmp_path, monkeypatch, name):
    monkeypatch.chdir(tmp_path)
    text, expected = FAULTS[name]
    (tmp_path / "log.csv").write_text(text, "utf-8")
    with pytest.raises(InputFault) as caught:
        read(tmp_path.joinpath("log.csv").relative_to(tmp_path))
    assert str(caught.value).startswith(expected)


@pytest.mark.parametrize(
    ("name", "content", "told"),
    [
        ("log.xlsx", b"", "a trace is not read from `.xlsx`"),
        ("log.csv", "time [s],Füllstand [m]".encode("cp1252"), "byte 11 does not fit"),
        ("log.npz", b"PK\x03\x04 no archive", "the file does not hold ticks, values, names and units"),
        ("log.npz", b"", "the file does not hold ticks, values, names and units"),
    ],
)
def test_what_is_no_trace_is_refused(tmp_path, name, content, told):
    (tmp_path / name).write_bytes(content)
    with pytest.raises(InputFault, match="JDG301") as caught:
        read(tmp_path / name)
    assert told in str(caught.value)


def test_a_file_that_is_not_there_is_told(tmp_path):
    with pytest.raises(InputFault, match="there is no such file"):
        read(tmp_path / "log.csv")


def test_ticks_that_do_not_rise_are_refused_in_an_npz_too(tmp_path):
    write(Trace(TICKS[::-1], TRACE.names, TRACE.units, VALUES), tmp_path / "x.npz")
    with pytest.raises(InputFault, match="JDG304"):
        read(tmp_path / "x.npz")


@given(
    st.text(max_size=60)
    | st.lists(st.sampled_from(["time [s]", ",", ";", "\n", '"', "1", "y [m]", "nan"])).map("".join)
)
def test_any_text_is_a_trace_or_a_finding(tmp_path_factory, text):
    try:
        text.encode()
    except UnicodeEncodeError:
        return
    try:
        recorded(tmp_path_factory.mktemp("any"), text)
    except InputFault as fault:
        assert str(fault)  # noqa: PT017
