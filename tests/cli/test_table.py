import io

import pytest
from rich.console import Console

from fcl_sim.cli.table import print_runs, print_verdicts
from fcl_sim.judge.verdict import Status
from fcl_sim.report.summary import Row, RunRow


def row(scenario, variant, requirement, status, shown=""):
    return Row(
        scenario=scenario,
        variant=variant,
        id=requirement,
        text="It stands",
        bound="at most 35 s",
        value="18.4 s",
        status=status,
        shown=shown or str(status),
        note="",
    )


ROWS = [
    row("crane/transfer", "base", "CR-1", Status.PASS),
    row("crane/transfer", "base", "CR-2", Status.FAIL),
    row("crane/transfer", "raw_distance", "CR-1", Status.PASS, "EXPECTED MISS"),
    row("crane/printed", "base", "CR-1", Status.FAULT),
]


def printed(rows, width, **settings):
    stream = io.StringIO()
    console = Console(file=stream, width=width, highlight=False, **settings)
    print_verdicts(rows, console)
    return [line.rstrip() for line in stream.getvalue().splitlines()]


def test_a_wide_terminal_shows_a_row_for_each_verdict_and_says_scenario_and_variant_once():
    assert printed(ROWS, 110) == [
        "scenario        variant       requirement  asked         measured  verdict",
        "crane/transfer  base          CR-1         at most 35 s    18.4 s  PASS",
        "                              CR-2         at most 35 s    18.4 s  FAIL",
        "                raw_distance  CR-1         at most 35 s    18.4 s  EXPECTED MISS",
        "crane/printed   base          CR-1         at most 35 s    18.4 s  FAULT",
    ]


RUNS = [
    RunRow(
        scenario="crane/transfer",
        variant="base",
        requirements="9 of 9",
        envelope="8 of 8 at 175 points",
        status=Status.PASS,
    ),
    RunRow(
        scenario="crane/transfer",
        variant="raw",
        requirements="9 of 9, 7 expected misses",
        envelope="",
        status=Status.PASS,
    ),
    RunRow(scenario="pi/draft", variant="base", requirements="1 of 2", envelope="", status=Status.FAIL),
]


def runs(rows, width):
    stream = io.StringIO()
    print_runs(rows, Console(file=stream, width=width, highlight=False))
    return [line.rstrip() for line in stream.getvalue().splitlines()]


def test_each_run_is_a_line_with_how_many_of_its_requirements_are_met():
    assert runs(RUNS, 110) == [
        "scenario        variant  requirements               over its envelope     verdict",
        "crane/transfer  base     9 of 9                     8 of 8 at 175 points  PASS",
        "                raw      9 of 9, 7 expected misses                        PASS",
        "pi/draft        base     1 of 2                                           FAIL",
    ]


def test_where_no_run_has_an_envelope_there_is_no_column_for_it():
    assert runs(RUNS[1:], 110)[0].split() == ["scenario", "variant", "requirements", "verdict"]


def test_on_a_narrow_terminal_scenarios_stand_on_lines_of_their_own():
    assert runs(RUNS, 80) == [
        "crane/transfer",
        "base     9 of 9                     8 of 8 at 175 points  PASS",
        "raw      9 of 9, 7 expected misses                        PASS",
        "pi/draft",
        "base     1 of 2                                           FAIL",
    ]


def test_a_terminal_of_eighty_columns_shows_a_table_for_each_run():
    assert printed(ROWS, 80) == [
        "crane/transfer  base",
        "CR-1         at most 35 s    18.4 s  PASS",
        "CR-2         at most 35 s    18.4 s  FAIL",
        "crane/transfer  raw_distance",
        "CR-1         at most 35 s    18.4 s  EXPECTED MISS",
        "crane/printed  base",
        "CR-1         at most 35 s    18.4 s  FAULT",
    ]


def test_a_narrow_terminal_shows_the_same_in_lines():
    assert printed(ROWS[2:], 40) == [
        "crane/transfer  raw_distance",
        "  CR-1: EXPECTED MISS",
        "    18.4 s, at most 35 s",
        "crane/printed  base",
        "  CR-1: FAULT",
        "    18.4 s, at most 35 s",
    ]


@pytest.mark.parametrize("width", [20, 40, 72, 80, 110])
def test_nothing_is_cut_off_at_any_width(width):
    shown = "".join(printed(ROWS, width)).replace(" ", "")
    for word in ("raw_distance", "CR-2", "FAULT", "EXPECTEDMISS", "18.4"):
        assert word in shown


def test_colours_only_underline_the_words(monkeypatch):
    monkeypatch.delenv("NO_COLOR", raising=False)
    coloured = "\n".join(printed(ROWS, 110, force_terminal=True, color_system="standard"))
    assert "\x1b[32mPASS\x1b[0m" in coloured
    assert "\x1b[31mFAIL\x1b[0m" in coloured
    assert "  EXPECTED MISS\n" in coloured
    monkeypatch.setenv("NO_COLOR", "1")
    plain = "\n".join(printed(ROWS, 110, force_terminal=True, color_system="standard"))
    assert "\x1b[3" not in plain


def test_names_that_look_like_markup_are_shown_as_they_are():
    assert any("[red]x[/red]" in line for line in printed([row("[red]x[/red]", "a", "b", Status.PASS)], 110))


def test_no_verdicts_are_no_table():
    assert printed([], 110) == []
