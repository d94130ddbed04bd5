"""What a comment or a file of waivers lets pass, and what it does not."""

import pytest

from fcl_sim import fcl
from fcl_sim.diagnostics.page import framed
from fcl_sim.proof.prove import prove
from fcl_sim.verify.waive import waive

GAP = """\
RULE 1: IF temp IS cold AND level IS low THEN valve IS inlet;
RULE 2: IF temp IS cold AND level IS high THEN valve IS drain;
RULE 3: IF temp IS hot AND level IS high THEN valve IS drain;
RULE 4: IF temp IS hot AND level IS high THEN valve IS drain;"""


def left(tmp_path, comment="", waivers=""):
    """Return codes of what is left of a base with a gap and a rule too many, and of its waivers' faults."""
    file = tmp_path / "bath.fcl"
    file.write_text(framed(f"{GAP}\n{comment}", "RULE", complete=True), "utf-8")
    file.with_suffix(".waivers.toml").write_text(waivers, "utf-8")
    (block,) = fcl.read_file(file).blocks
    found = waive(prove(block), block.span.source, file, tmp_path)
    return [each.diagnostic.code for each in found.findings], [each.code for each in found.faults]


def test_nothing_is_waived_unasked(tmp_path):
    assert left(tmp_path) == (["FCL601", "FCL604"], [])


@pytest.mark.parametrize(
    "comment",
    [
        "(* waive FCL604 of 4, 2026-03-01: to be seen by everybody *)",
        "(* waive FCL604, 2026-03-01: to be seen by\n   everybody *)",
        "// waive FCL604 2026-03-01: to be seen by everybody",
        "(* Rule 4 again; waive FCL604 of 4, 2026-03-01: to be seen *)",
    ],
)
def test_a_comment_waives_a_finding(tmp_path, comment):
    assert left(tmp_path, comment) == (["FCL601"], [])


def test_a_comment_waives_that_of_a_variable(tmp_path):
    assert left(tmp_path, "(* waive FCL601 of valve, 2026-03-01: known *)") == (["FCL604"], [])


def test_a_file_waives_a_finding(tmp_path):
    text = '[[waive]]\nwhat = "FCL604"\nrule = "4"\nreason = "known"\ndate = 2026-03-01\n'
    assert left(tmp_path, waivers=text) == (["FCL601"], [])


@pytest.mark.parametrize("of", [" of 3", " of temp", " of RULE"])
def test_a_waiver_of_something_else_waives_nothing_and_is_told(tmp_path, of):
    assert left(tmp_path, f"(* waive FCL604{of}, 2026-03-01: wrong *)") == (["FCL601", "FCL604"], ["VER107"])


@pytest.mark.parametrize("rest", ["", ": known", ", 2026-03-01", ", 2026-13-01: known", ", 2026-03-01: "])
def test_a_waiver_without_day_or_reason_waives_nothing(tmp_path, rest):
    assert left(tmp_path, f"(* waive FCL604{rest} *)") == (["FCL601", "FCL604"], ["VER103"])
