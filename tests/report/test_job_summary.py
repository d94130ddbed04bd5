"""The page of a job: the verdict first, what is missed next, the rest folded away."""

from fcl_sim.diagnostics import Diagnostic, Place
from fcl_sim.judge.verdict import Status
from fcl_sim.report import job_summary
from fcl_sim.report.job_summary import escaped, text
from tests.report.synthetic import EVIL, outcome, run, verdict


def test_a_green_run_has_its_verdict_a_sentence_and_every_verdict_folded_away(tmp_path):
    assert text([outcome(tmp_path, run(tmp_path))]).replace("\N{NO-BREAK SPACE}", " ") == (
        "## fcl-sim: PASS\n\n"
        "1 scenario, 1 run, 2 verdicts: 2 PASS.\n\n"
        "<details>\n\n<summary>2 verdicts</summary>\n\n"
        "| scenario | run | requirement | asked | measured | verdict |\n"
        "| --- | --- | --- | --- | --- | --- |\n"
        "| crane/transfer | base | CR-1: The container stands within half a metre of the target "
        "| at most 35 s | 25.4 s | PASS |\n"
        "| crane/transfer | base | CR-2: No sway is left | at most 0.5 deg | 25.4 deg | PASS |\n\n"
        "</details>\n"
    )


def test_what_is_missed_stands_first_with_its_place(tmp_path):
    page = text([outcome(tmp_path, run(tmp_path, verdicts=(verdict(Status.FAIL, 41.2), verdict())))])
    head, missed = page.partition("<details>")[0].split("### Not passed")
    assert head.startswith("## fcl-sim: FAIL\n")
    assert (
        "| JDG402: CR-1 is FAIL in the run \\`base\\`: crane.distance does not settle. | transfer.toml |"
        in missed
    )
    assert missed.count("\n| ") == 3


def test_what_could_not_be_run_is_the_verdict(tmp_path):
    fault = Diagnostic(code="SCN201", message="no key", places=(Place(file="typo.toml"),))
    page = text([outcome(tmp_path, run(tmp_path))], [fault])
    assert page.startswith("## fcl-sim: input faults\n")
    assert "### 1 input fault\n\n| finding | where |\n| --- | --- |\n| SCN201: no key | typo.toml |" in page


def test_no_name_breaks_the_table(tmp_path):
    judged = verdict(Status.FAIL, 41.2, text=f"{EVIL}\n| x |")
    page = text([outcome(tmp_path, run(tmp_path, verdicts=(judged,)))])
    (row,) = [line for line in page.splitlines() if line.startswith("| crane/transfer")]
    assert row.replace("\\|", "").count("|") == 7
    assert "<script>" not in page
    assert escaped("a_b*c|<d>") == "a\\_b\\*c\\|&lt;d&gt;"


def test_a_page_has_room_on_a_server_however_many_verdicts_there_are(tmp_path, monkeypatch):
    monkeypatch.setattr(job_summary, "ROOM", 2_000)
    page = text([outcome(tmp_path, run(tmp_path, verdicts=(verdict(),) * 100))])
    assert len(page.encode()) < 3_000
    shown = page.count("\n| crane/transfer ")
    assert f"\nand {100 - shown} more\n" in page
