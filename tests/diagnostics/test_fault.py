"""The one exception for a user's mistake."""

from fcl_sim.diagnostics import Diagnostic, InputFault
from fcl_sim.diagnostics.codes import CODES


def test_a_fault_says_all_of_its_findings():
    fault = InputFault([Diagnostic(code="FCL101", message="one"), Diagnostic(code="FCL102", message="two")])
    assert str(fault) == "error[FCL101]: one\nerror[FCL102]: two"


def test_a_fault_of_a_file_names_the_file_and_one_of_the_surroundings_none():
    assert str(InputFault.at_file("FCL101", "a.fcl", "gone")) == "a.fcl: error[FCL101]: gone"
    assert str(InputFault.at_file("FCL101", "", "gone", "look")) == "error[FCL101]: gone\n  hint: look"


def test_only_errors_stop_a_run():
    assert Diagnostic(code="FCL101", message="one").is_error


def test_a_title_begins_like_the_rest_of_a_sentence():
    assert all(not title.endswith(".") for title in CODES.values())
