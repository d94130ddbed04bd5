"""What is wrong with a table is told with its place and what would be right."""

import pytest

from fcl_sim.block import loads
from fcl_sim.diagnostics import InputFault, Source
from fcl_sim.matrix import matrices, read, rules
from tests.matrix.test_round_trip import block
from tests.report.synthetic import THREE_INPUTS

CASES = {
    "short row": (
        "u\na \\ b,low,mid\nlow,low\n",
        "MTX103",
        (3, 1),
        "this row has 2 cells, and the first has 3",
    ),
    "no output": (
        "a \\ b,low\nlow,low\n",
        "MTX103",
        (1, 1),
        "a matrix begins with a line that names its output",
    ),
    "twice": ("u\na \\ b,low,LOW\nlow,low,\n", "MTX103", (2, 11), "`LOW` has a row or column already"),
    "no name": ("u\na \\ b,,low\nlow,low,\n", "MTX103", (2, 7), "a row or column has no term"),
    "no inputs": ("u\n,low\nlow,low\n", "MTX103", (2, 1), "the first cell of the table names the inputs"),
    "term": ("u\na \\ b,low\nlaw,low\n", "MTX104", (3, 1), "`a` has no term `law`"),
    "input": ("u\na \\ c,low\nlow,low\n", "MTX104", (2, 1), "`mixer` has no fuzzified input `c`"),
    "output": ("x\na \\ b,low\nlow,low\n", "MTX104", (1, 1), "`mixer` has no defuzzified output `x`"),
    "weight's name": ("u\na \\ b,low\nlow,low WITH q\n", "MTX104", (3, 5), "`mixer` has no input `q`"),
    "no condition": ("u\na \\ b,*\n*,low\n", "MTX104", (3, 3), "a rule needs a term of one input at least"),
    "weight": ("u\na \\ b,low\nlow,low WITH 2\n", "MTX105", (3, 5), "`low WITH 2` is no conclusion"),
    "words": ("u\na \\ b,low\nlow,low and mid\n", "MTX105", (3, 5), "`low and mid` is no conclusion"),
    "empty": ("\n", "MTX103", (1, 1), "there is no matrix in this table"),
}


@pytest.mark.parametrize("case", CASES)
def test_a_fault_of_a_table_has_its_place(case):
    text, code, place, message = CASES[case]
    with pytest.raises(InputFault) as caught:
        rules(read(Source("t.csv", text)), block())
    (found, *_) = caught.value.diagnostics
    assert found.code == code
    assert found.message.startswith(message)
    span = found.places[0].span
    assert (span.line, span.column) == place
    assert found.hint


TOML = {
    "not TOML": ("[[matrix]]\noutput = u\n", "MTX102"),
    "another key": ('[[matrix]]\noutput = "u"\nrow = "a"\n', "MTX103"),
    "another table": ("[matrices]\n", "MTX103"),
    "no rows": ('[[matrix]]\noutput = "u"\nrows = "a"\nrules = []\n', "MTX103"),
    "a number": (
        '[[matrix]]\noutput = "u"\nrows = "a"\ncolumns = "b"\nrules = [["", 1], ["low", "low"]]\n',
        "MTX103",
    ),
}


@pytest.mark.parametrize("case", TOML)
def test_a_fault_of_a_table_in_toml_has_its_code(case):
    text, code = TOML[case]
    with pytest.raises(InputFault) as caught:
        read(Source("t.toml", text))
    assert {each.code for each in caught.value.diagnostics} == {code}


def test_every_fault_is_told_at_once():
    text = "u\na \\ b,low,mad\nlaw,low,\nmid,,none\n"
    with pytest.raises(InputFault) as caught:
        rules(read(Source("t.csv", text)), block())
    hints = [each.hint for each in caught.value.diagnostics]
    assert hints[:2] == ["did you mean `low`?", "did you mean `mid`?"]
    assert len(hints) == 3


def test_a_rule_base_of_three_inputs_is_no_matrix():
    with pytest.raises(InputFault) as caught:
        matrices(loads(THREE_INPUTS).function_block)
    assert str(caught.value.diagnostics[0].code) == "MTX101"
    assert "3 inputs: `a`, `b`, `c`" in str(caught.value)
