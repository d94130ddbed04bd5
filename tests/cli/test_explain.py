"""`fcl-sim explain`: the page of a code."""

import json

from fcl_sim.diagnostics.codes import CODES
from fcl_sim.diagnostics.page import page
from fcl_sim.diagnostics.page_text import list_text, page_text


def test_the_page_of_a_code_is_printed(invoke):
    result = invoke("explain", "FCL204")
    assert (result.exit_code, result.stdout) == (0, page_text(page("FCL204")) + "\n")


def test_a_code_may_be_copied_from_a_finding(invoke):
    assert invoke("explain", "[fcl204]", "SCN101").stdout == (
        f"{page_text(page('FCL204'))}\n\n\n{page_text(page('SCN101'))}\n"
    )


def test_an_unknown_code_is_wrong_usage_and_the_nearest_is_named(invoke):
    result = invoke("explain", "FLC204")
    assert (result.exit_code, result.stdout) == (2, "")
    assert result.stderr.endswith("Error: There is no code 'FLC204'. Did you mean FCL204?\n")
    assert invoke("explain", "banana").stderr.endswith("`fcl-sim explain` lists all.\n")


def test_without_a_code_all_are_listed(invoke):
    assert invoke("explain").stdout == list_text() + "\n"


def test_json_holds_the_whole_page(invoke):
    document = json.loads(invoke("explain", "FCL204", "--json").stdout)
    assert document["schema"] == 1
    (told,) = document["codes"]
    assert told["code"] == "FCL204"
    assert told["means"] == page("FCL204").means
    assert [each["code"] for each in json.loads(invoke("explain", "--json").stdout)["codes"]] == list(CODES)
