"""A waiver says what, of which rule, why and since when; whatever else it says is a finding."""

from datetime import date

import pytest

from fcl_sim.diagnostics import InputFault, Severity
from fcl_sim.verify.cover import Visit, cover
from fcl_sim.verify.coverage import Item, waived, waiver_findings
from fcl_sim.verify.subject import Subject
from fcl_sim.verify.waivers import waivers_of
from tests.verify.rule_bases import heating, recorded
from tests.verify.test_coverage import TICKS

WHOLE = {"what": '"fired"', "rule": '"2"', "reason": '"never so\\n windy"', "date": "2026-03-01"}


def written(folder, name="heating.waivers.toml", **changed):
    """Write one waiver, with some of its values changed; return the rule base that it is about."""
    values = {**WHOLE, **changed}
    lines = [f"{key} = {value}" for key, value in values.items() if value is not None]
    (folder / name).write_text("[[waive]]\n" + "\n".join(lines) + "\n", "utf-8")
    (folder / "heating.fcl").touch()
    return folder / "heating.fcl"


def read(folder, bench=None):
    return waivers_of(folder / "heating.fcl", bench or folder / "elsewhere", [*Item])


def test_a_waiver_beside_its_rule_base_is_read(tmp_path):
    base = written(tmp_path)
    (found,) = read(tmp_path)
    assert (found.rule_base, found.what, found.rule) == (base, "fired", "2")
    assert (found.reason, found.date) == ("never so windy", date(2026, 3, 1))


def test_a_bench_has_waivers_of_several_rule_bases_and_each_takes_its_own(tmp_path):
    written(tmp_path, "waivers.toml", rule_base='"heating.fcl"')
    (tmp_path / "other.fcl").touch()
    assert len(read(tmp_path, tmp_path)) == 1
    assert waivers_of(tmp_path / "other.fcl", tmp_path, [*Item]) == ()


def test_the_code_of_a_finding_is_waived_without_a_rule(tmp_path):
    written(tmp_path, what='"FCL310"', rule=None)
    (found,) = read(tmp_path)
    assert (found.what, found.rule) == ("FCL310", "")


@pytest.mark.parametrize(
    ("changed", "code", "told"),
    [
        ({"reason": None}, "VER103", "the waiver has no `reason`"),
        ({"reason": '" "'}, "VER103", "the waiver has no `reason`: the text is empty"),
        ({"rule": None}, "VER103", "the waiver has no `rule`"),
        ({"date": None}, "VER103", "the waiver has no `date`"),
        ({"until": "2027-01-01"}, "VER103", "`until` is no key of this waiver"),
        ({"rule_base": '"x.fcl"'}, "VER103", "`rule_base` is no key of this waiver"),
        ({"date": '"1 March"'}, "VER104", "this is no date"),
        ({"date": "2026-03-01T12:00:00"}, "VER104", "this is no date"),
        ({"rule": "2"}, "VER104", "`rule` is a text"),
        ({"what": '"fires"'}, "VER104", "`fires` is nothing that can be waived"),
        ({"what": "7"}, "VER104", "`what` is a text"),
        ({"reason": "because"}, "VER102", "not TOML: this is no value"),
    ],
)
def test_a_waiver_that_does_not_say_all_of_it_waives_nothing(tmp_path, changed, code, told):
    written(tmp_path, **changed)
    with pytest.raises(InputFault) as caught:
        read(tmp_path)
    assert [(each.code, each.message) for each in caught.value.diagnostics] == [(code, told)]
    assert caught.value.diagnostics[0].places[0].span.line >= 1


def test_every_fault_of_every_file_is_told_at_once(tmp_path):
    written(tmp_path, reason=None, date=None)
    written(tmp_path, "waivers.toml", rule_base='"heatin.fcl"', what='"Decisive"')
    with pytest.raises(InputFault) as caught:
        read(tmp_path, tmp_path)
    assert [each.code for each in caught.value.diagnostics] == ["VER103", "VER103", "VER104", "VER106"]
    assert caught.value.diagnostics[2].hint == "did you mean `decisive`?"


def test_a_file_in_another_encoding_and_a_stray_table_are_told(tmp_path):
    base = written(tmp_path)
    (tmp_path / "heating.waivers.toml").write_bytes(b"[[waive]]\nwhat = '\xe4'\n")
    with pytest.raises(InputFault, match="VER101"):
        read(tmp_path)
    base.with_suffix(".waivers.toml").write_text("[waive]\nwhat = 'fired'\n", "utf-8")
    with pytest.raises(InputFault, match="VER103"):
        read(tmp_path)


def covered(folder, **changed):
    written(folder, **changed)
    block = heating()
    record = recorded(block, "LREAL", [(0, 0), (10, 0)])
    found = cover(Subject(block=block), Visit(run="a/base", ticks=TICKS[:2], record=record))
    return waived(found, read(folder))


def test_a_rule_that_need_not_fire_need_not_do_anything_else(tmp_path):
    found = covered(tmp_path)
    assert [rule.label for rule in found.lacking(Item.FIRED)] == ["2", "4"]
    for item in Item:
        assert [rule.label for rule in found.unmet(item)] == ["4"]
    assert waiver_findings([found]) == ()


def test_that_a_rule_need_not_be_decisive_says_nothing_of_its_firing(tmp_path):
    found = covered(tmp_path, what='"decisive"')
    assert [rule.label for rule in found.unmet(Item.FIRED)] == ["2", "4"]
    assert [rule.label for rule in found.unmet(Item.DECISIVE)] == ["4"]


def test_a_waiver_of_what_a_rule_does_is_not_used(tmp_path):
    (told,) = waiver_findings([covered(tmp_path, rule='"1"')])
    assert (told.code, told.severity) == ("VER107", Severity.WARNING)
    assert told.message == "the waiver is not used: rule 1 is fired at 0 s in a/base"
    assert told.places[0].span.text == '"1"'


def test_a_waiver_of_a_rule_that_does_not_exist_is_an_error(tmp_path):
    (told,) = waiver_findings([covered(tmp_path, rule='"22"')])
    assert (told.code, told.severity) == ("VER105", Severity.ERROR)
    assert (told.message, told.hint) == ("heating.fcl has no rule `22`", "did you mean `2`?")
