"""`fcl-sim vectors`: a table that `fcl-sim replay` reads."""

import csv

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


def test_the_one_wrong_answer_of_a_plc_is_named_with_its_row_and_rule(invoke, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "bath.fcl").write_text(frame(complete=True), "utf-8")
    invoke("vectors", "bath.fcl", "of/the/plc.csv")
    with (tmp_path / "of/the/plc.csv").open(encoding="utf-8", newline="") as file:
        head, *rows = csv.reader(file)
    level, valve = head.index("level [1]"), head.index("valve [1]")
    wrong = next(place for place, row in enumerate(rows) if float(row[level]) == 1.0)
    rows[wrong][valve] = str(float(rows[wrong][valve]) + 1.0)
    with (tmp_path / "answers.csv").open("w", encoding="utf-8", newline="") as file:
        csv.writer(file).writerows([head, *rows])
    result = invoke("replay", "bath.fcl", "answers.csv")
    assert result.exit_code == 1
    assert f"First in sample {wrong + 1}, at {float(rows[wrong][0]):g} s: valve is -100, and" in result.stdout
    assert result.stdout.endswith("        1  rule 2: IF level IS high THEN valve IS drain\n")


def test_a_wrong_answer_where_no_rule_is_active_names_the_default(invoke, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    gap = frame(complete=True).replace("RULE 2: IF level IS high THEN valve IS drain;", "")
    (tmp_path / "bath.fcl").write_text(gap, "utf-8")
    invoke("vectors", "bath.fcl", "vectors.csv")
    (tmp_path / "bath.fcl").write_text(gap.replace("DEFAULT := 0;", "DEFAULT := 7;"), "utf-8")
    told = invoke("replay", "bath.fcl", "vectors.csv").stdout
    assert told.endswith("no rule is active for valve: DEFAULT 7 is given out\n")
