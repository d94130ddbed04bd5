"""The README of a folder is told once, before its first scenario."""

from fcl_sim.report.story import stories_of, story_data
from tests.report.synthetic import outcome, run


def test_it_is_told_before_the_first_scenario_of_its_folder_alone(tmp_path):
    (tmp_path / "README.md").write_text("# The crane\n\nIt carries.\n", "utf-8")
    first, second = (outcome(tmp_path, run(tmp_path), name=name) for name in ("a", "b"))
    stories = stories_of([first, second])
    assert len(stories) == 1
    told = story_data(stories, first, [])
    assert told["title"] == "The crane"
    assert [each["kind"] for each in told["blocks"]] == ["paragraph"]
    assert story_data(stories, second, [first]) is None


def test_a_folder_without_a_readme_has_no_story(tmp_path):
    assert stories_of([outcome(tmp_path, run(tmp_path))]) == ()
