"""`fcl-sim vectors`: a table that `fcl-sim replay` reads."""

from fcl_sim.diagnostics.page import frame


def test_replay_reads_the_vectors_and_finds_no_difference(invoke, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "bath.fcl").write_text(frame(), "utf-8")
    written = invoke("vectors", "bath.fcl", "vectors.csv", "--universe", "temp=0..30 degC")
    assert (written.exit_code, written.stdout) == (0, "")
    assert written.stderr.startswith("written: vectors.csv, ")
    head = (tmp_path / "vectors.csv").read_text("utf-8").splitlines()[0]
    assert head == "time [s],temp [degC],level [1],valve [1],valve_tolerance [1]"
    result = invoke("replay", "bath.fcl", "vectors.csv")
    assert result.exit_code == 0
    assert "no difference" in result.stdout


def test_an_input_that_does_not_exist_is_wrong_usage(invoke, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "bath.fcl").write_text(frame(), "utf-8")
    assert invoke("vectors", "bath.fcl", "vectors.csv", "--universe", "tmp=0..30").exit_code == 2
    assert not (tmp_path / "vectors.csv").exists()
