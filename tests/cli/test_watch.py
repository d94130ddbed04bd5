"""`fcl-sim run --watch`: what is saved is run again, beside what it was before."""

from types import SimpleNamespace

import pytest

from fcl_sim.cli import watch
from fcl_sim.cli.watch import Bench, saved
from fcl_sim.report.html.live import Live


def faults(made, scenario, label=""):
    """Run a scenario; return what is wrong with it."""
    ((_, found),) = made.run([scenario], label)
    return [*found]


@pytest.fixture
def scenario(bench):
    return bench / "scenarios" / "crane" / "short.toml"


@pytest.fixture
def rules(scenario):
    return scenario.with_name("crane_completed.fcl")


@pytest.fixture
def watched(scenario):
    made = Bench([scenario], {})
    assert faults(made, scenario) == []
    return made


def stronger(rules):
    """Let the crane drive off with more power."""
    text = rules.read_text("utf-8")
    assert "pos_medium := 9" in text
    rules.write_text(text.replace("pos_medium := 9", "pos_medium := 18"), "utf-8")


def test_a_scenario_depends_on_its_controller_its_rules_and_its_plant(watched, scenario, rules):
    assert {each.name for each in watched.inputs} == {
        "short.toml",
        "crane.controller.toml",
        "crane_completed.fcl",
        "crane.py",
    }
    (file,) = (each for each in watched.inputs if each.name == rules.name)
    assert watched.affected({file}) == [scenario]
    assert watched.affected({scenario.with_name("other.fcl")}) == []


def test_what_was_saved_is_shown_over_what_was_before(watched, scenario, rules):
    (before,) = watched.known
    stronger(rules)
    assert faults(watched, scenario, "crane_completed.fcl") == []
    (now,) = watched.known
    assert now.against.label == "before crane_completed.fcl was saved"
    assert now.against.runs == before.variants
    assert now.trace["crane.power"][0] == 18.0
    assert before.trace["crane.power"][0] == 9.0


def test_a_mistake_is_told_and_what_was_before_stays_until_it_is_mended(watched, scenario, rules):
    (before,) = watched.known
    whole = rules.read_text("utf-8")
    rules.write_text(whole.replace("END_FUZZIFY", "END_FUZZFY", 1), "utf-8")
    (fault,) = faults(watched, scenario)
    assert fault.code == "FCL203"
    assert watched.known == [before]
    assert any(each.name == rules.name for each in watched.inputs)
    rules.write_text(whole, "utf-8")
    assert faults(watched, scenario) == []
    assert watched.known != [before]


def test_a_scenario_that_never_could_be_run_is_watched_too(scenario):
    whole = scenario.read_text("utf-8")
    scenario.write_text(whole.replace("crane.controller.toml", "missing.toml"), "utf-8")
    made = Bench([scenario], {})
    assert [each.code for each in faults(made, scenario)] == ["SCN101"]
    assert made.known == []
    assert "Nothing was run" in made.page(1)
    assert scenario in made.inputs


def test_a_section_is_made_anew_only_where_something_was_run(watched, scenario):
    watched.page(1)
    (first,) = watched.sections.values()
    watched.page(2)
    assert [*watched.sections.values()] == [first]
    faults(watched, scenario)
    watched.page(3)
    assert [*watched.sections.values()] != [first]


def test_a_file_that_is_written_in_pieces_is_seen_once_and_whole(watched, rules, monkeypatch):
    text = rules.read_text("utf-8")
    pieces = iter([text, text, "", "", "", "", f"{text}(* more *)"])

    def sleep(_):
        piece = next(pieces, None)
        if piece is not None and piece != rules.read_text("utf-8"):
            rules.write_text(piece, "utf-8")

    monkeypatch.setattr(watch, "time", SimpleNamespace(sleep=sleep))
    (changed,) = next(saved(watched))
    assert changed.name == rules.name
    assert changed.read_text("utf-8").endswith("(* more *)")


def test_at_the_command_line_it_tells_where_the_page_is_and_what_each_saving_changed(
    invoke, scenario, rules, monkeypatch
):
    shown = []

    def once(bench):
        stronger(rules)
        yield {each for each in bench.inputs if each.name == rules.name}
        shown.append(served[0].page.decode("utf-8"))
        raise KeyboardInterrupt

    served = []

    def live():
        served.append(Live())
        return served[0]

    monkeypatch.setattr(watch, "saved", once)
    monkeypatch.setattr(watch, "Live", live)
    result = invoke("run", scenario, "--watch")
    assert result.exit_code == 130
    assert "open http://127.0.0.1:" in result.stdout
    assert "(4 files are watched; Ctrl-C ends it)" in result.stdout
    assert "crane_completed.fcl was saved: " in result.stdout
    assert "S-1, peak of crane.sway" in result.stdout
    assert "Against before crane_completed.fcl was saved" in shown[0]


@pytest.mark.parametrize("option", ["--format=json", "--html", "--png", "--coverage"])
def test_what_asks_for_files_or_other_output_does_not_go_with_it(invoke, scenario, option):
    result = invoke("run", scenario, "--watch", option)
    assert result.exit_code == 2
    assert f"leave {option.partition('=')[0]} out" in result.stderr
