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


def rounds(monkeypatch, *events):
    """Let the watcher look for new files each time it looks at all; each event happens before one look."""
    coming = iter(events)
    monkeypatch.setattr(watch, "ROUND", 1)
    monkeypatch.setattr(watch, "time", SimpleNamespace(sleep=lambda _: next(coming, lambda: None)()))


def test_a_scenario_that_comes_into_a_folder_is_followed_once_there_is_something_in_it(
    watched, scenario, monkeypatch
):
    watched.folders = (scenario.parent,)
    new = scenario.with_name("new.toml")
    rounds(monkeypatch, new.touch, lambda: new.write_bytes(scenario.read_bytes()))
    following = saved(watched)
    assert next(following) == {new}
    assert watched.affected({new}) == [new]
    assert faults(watched, new) == []
    assert [each.scenario.name for each in watched.known] == ["crane/short", "crane/new"]
    rounds(monkeypatch, lambda: new.write_text(new.read_text("utf-8") + "# more\n", "utf-8"))
    assert next(following) == {new}


def test_without_a_folder_nothing_else_is_followed(watched, scenario):
    scenario.with_name("new.toml").write_bytes(scenario.read_bytes())
    assert watched.join() == []


def test_a_scenario_that_is_deleted_from_its_folder_leaves_the_page(watched, scenario, monkeypatch):
    watched.folders = (scenario.parent,)
    watched.page(1)
    rounds(monkeypatch, scenario.unlink)
    changed = next(saved(watched))
    assert watch.told_of(changed) == "scenarios/crane/short.toml was deleted"
    assert watched.forget(changed)
    assert (watched.known, watched.inputs) == ([], set())


def test_one_that_was_named_stays_and_is_told_to_be_missing(watched, scenario):
    scenario.unlink()
    assert not watched.forget({scenario})
    assert [each.code for each in faults(watched, scenario)] == ["SCN101"]


def test_what_was_saved_and_what_was_deleted_are_told_apart(watched, scenario, rules):
    rules.unlink()
    told = watch.told_of({rules, scenario})
    assert told == "scenarios/crane/short.toml was saved and scenarios/crane/crane_completed.fcl was deleted"


def test_a_mistake_stands_above_the_page_until_it_is_mended_whatever_else_is_saved(
    invoke, scenario, rules, monkeypatch
):
    other = scenario.with_name("other.toml")
    other.write_bytes(scenario.read_bytes())
    live, above = Live(), []

    def twice(bench):
        scenario.write_text(scenario.read_text("utf-8").replace("duration", "duraton"), "utf-8")
        yield {scenario}
        yield {other}
        above.append(live._trouble)
        scenario.write_text(scenario.read_text("utf-8").replace("duraton", "duration"), "utf-8")
        yield {scenario}
        above.append(live._trouble)
        raise KeyboardInterrupt

    monkeypatch.setattr(watch, "saved", twice)
    monkeypatch.setattr(watch, "Live", lambda: live)
    result = invoke("run", scenario, other, "--watch")
    assert "no key `duraton`" in above[0]
    assert above[1] == ""
    assert result.stderr.count("no key `duraton`") == 1


def test_a_scenario_that_is_new_is_told_as_at_the_beginning(invoke, bench, scenario, monkeypatch):
    def once(watched):
        scenario.with_name("new.toml").write_bytes(scenario.read_bytes())
        yield set(watched.join())
        raise KeyboardInterrupt

    monkeypatch.setattr(watch, "saved", once)
    told = invoke("run", "scenarios", "--watch").stdout
    assert "new.toml was saved: " in told
    assert ["crane/new", "base", "1", "of", "1", "PASS"] in [line.split() for line in told.splitlines()]


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
