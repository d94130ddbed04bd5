"""The collector of findings: what says the same is one, and there is an end to everything."""

from fcl_sim.diagnostics import Source
from fcl_sim.fcl.findings import LONGEST_NAME, MOST_FINDINGS, MOST_HINTS, Findings, Stretch

TEXT = Source("t", "x" * 1000)


def test_findings_that_say_the_same_are_one_with_several_places():
    findings = Findings(TEXT)
    findings.error("FCL302", "`x` is not declared", Stretch(5, 6), hint="first")
    findings.error("FCL302", "`x` is not declared", Stretch(1, 2), hint="second")
    findings.warning("FCL302", "`y` is not declared", Stretch(7, 8))
    one, two = findings.diagnostics()
    assert [place.span.start for place in one.places] == [5, 1]
    assert one.hint == "first"
    assert (two.severity, len(two.places)) == ("warning", 1)


def test_related_places_come_after_the_occurrences():
    findings = Findings(TEXT)
    related = (findings.place(Stretch(0, 1), "first here"),)
    findings.error("FCL301", "twice", Stretch(5, 6), related=related)
    findings.error("FCL301", "twice", Stretch(9, 10), related=related)
    (found,) = findings.diagnostics()
    assert [(place.span.start, place.label) for place in found.places] == [
        (5, ""),
        (9, ""),
        (0, "first here"),
    ]


def test_a_hint_is_made_only_for_the_first():
    made = []

    def hint():
        made.append(1)
        return "did you mean y?"

    findings = Findings(TEXT)
    for at in range(10):
        findings.error("FCL302", "`x` is not declared", Stretch(at, at + 1), hint)
    assert len(made) == 1


def test_beyond_the_most_findings_known_ones_still_gather_places():
    findings = Findings(TEXT)
    for number in range(MOST_FINDINGS + 20):
        findings.error("FCL302", f"`x{number}` is not declared", Stretch(number, number + 1))
    findings.error("FCL302", "`x0` is not declared", Stretch(500, 501))
    found = findings.diagnostics()
    assert len(found) == MOST_FINDINGS + 1
    assert found[-1].code == "FCL199"
    assert found[-1].is_error
    assert [place.span.start for place in found[-1].places] == [MOST_FINDINGS]
    assert len(found[0].places) == 2


def test_near_names_are_sought_within_bounds():
    findings = Findings(TEXT)
    assert findings.near("pos_big", ("zero", "pos_high")) == "pos_high"
    longest, longer = "x" * LONGEST_NAME, "x" * (LONGEST_NAME + 1)
    assert findings.near(longest, (longest,)) == longest
    assert findings.near(longer, (longer,)) is None
    for _ in range(MOST_HINTS - 3):
        assert findings.near("pos_big", ("zero", "pos_high")) == "pos_high"
    assert findings.near("pos_big", ("zero", "pos_high")) is None


def test_warnings_beyond_the_most_are_left_unsaid_and_neither_refuse_the_text_nor_hide_errors():
    findings = Findings(TEXT)
    for number in range(MOST_FINDINGS + 20):
        findings.warning("FCL340", f"the label {number}", Stretch(number, number + 1))
    findings.error("FCL302", "`x` is not declared", Stretch(500, 501))
    *warnings, rest, error = findings.diagnostics()
    assert len(warnings) == MOST_FINDINGS
    assert (rest.code, rest.severity) == ("FCL199", "warning")
    assert error.code == "FCL302"
