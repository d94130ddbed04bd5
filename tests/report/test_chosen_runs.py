"""Where some runs are drawn and others are not, it is said which, why, and where the others are told."""

import pytest

from fcl_sim.report.content import CHOSEN, FIRST_USERS, report_data
from fcl_sim.report.gather import gathered
from tests.report.synthetic import outcome, run

FIRES, MAPS = "Which rules fire when", "The runs on the characteristic"


@pytest.fixture
def sections(tmp_path):
    """Return the texts of the sections of a report on runs, by their titles."""

    def made(*runs):
        data = report_data(gathered([outcome(tmp_path, *runs)]), lambda _, picture: picture.name)
        return {each["title"]: each["text"] for each in data["scenarios"][0]["sections"]}

    return made


def always_active(found):
    for record in found.trace.fuzzy.values():
        record.flags[:] = True
    return found


def test_of_a_lone_run_nothing_is_said(sections, tmp_path):
    told = sections(run(tmp_path))
    assert told[FIRES] == ""
    assert CHOSEN not in told[MAPS]


def test_the_first_user_of_a_rule_base_is_said_to_stand_for_the_others(sections, tmp_path):
    told = sections(run(tmp_path), run(tmp_path, "swings", "swings"))
    assert told[FIRES] == FIRST_USERS


def test_the_maps_say_which_runs_they_show_and_name_those_they_do_not(sections, tmp_path):
    runs = [always_active(run(tmp_path, variant)) for variant in ("base", "far", "heavy")]
    told = sections(*runs)[MAPS]
    assert CHOSEN in told
    assert told.endswith("the page for a browser draws them: far and heavy.")
    assert CHOSEN not in sections(*runs[:1])[MAPS]
