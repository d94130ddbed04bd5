"""A matrix becomes rules and they become the matrix again, in CSV, in TOML and in FCL."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fcl_sim.block import loads
from fcl_sim.diagnostics import Source
from fcl_sim.fcl import read as read_fcl
from fcl_sim.fcl import read_file, replace_rules
from fcl_sim.matrix import ANY, as_csv, as_text, as_toml, matrices, read, rules
from fcl_sim.matrix.matrix import Entry, Matrix, Word
from tests.house.places import ROOT

TERMS = ("low", "mid", "high")
FRAME = """FUNCTION_BLOCK mixer (* kept *)
VAR_INPUT a: REAL; b: REAL; w: REAL; END_VAR
VAR_OUTPUT u: REAL; v: REAL; END_VAR
FUZZIFY a TERM low := (0, 1) (1, 0); TERM mid := (0, 0) (1, 1) (2, 0); TERM high := (1, 0) (2, 1); END_FUZZIFY
FUZZIFY b TERM low := (0, 1) (1, 0); TERM mid := (0, 0) (1, 1) (2, 0); TERM high := (1, 0) (2, 1); END_FUZZIFY
DEFUZZIFY u TERM low := 0; TERM mid := 1; TERM high := 2; METHOD: CoGS; DEFAULT := 0; END_DEFUZZIFY
DEFUZZIFY v TERM low := 0; TERM mid := 1; TERM high := 2; METHOD: CoGS; DEFAULT := 0; END_DEFUZZIFY
RULEBLOCK r
    AND: MIN;  // kept, too
    RULE 1: IF a IS low AND b IS low THEN u IS low, v IS low;
    RULE 2: IF a IS high THEN u IS high WITH 0.5;
END_RULEBLOCK
END_FUNCTION_BLOCK
"""

entries = st.builds(
    Entry,
    st.sampled_from(TERMS).map(Word),
    st.one_of(st.just(1.0), st.floats(0.0, 1.0), st.just("w")),
)
cells = st.lists(entries, max_size=2, unique_by=lambda each: (each.term, each.weight)).map(tuple)


def matrix(output, grid):
    """Return a matrix over a and b; its last row and column are ANY where something stands there."""
    size = len(TERMS)
    rows = (*TERMS, *([ANY] if any(grid[size][:size]) else []))
    columns = (*TERMS, *([ANY] if any(row[size] for row in grid[:size]) else []))
    return Matrix(
        output=Word(output),
        down=Word("a"),
        across=Word("b"),
        rows=tuple(map(Word, rows)),
        columns=tuple(map(Word, columns)),
        cells=tuple(
            tuple(() if i == j == size else grid[i][j] for j in range(len(columns))) for i in range(len(rows))
        ),
    )


grids = st.lists(st.lists(cells, min_size=4, max_size=4), min_size=4, max_size=4)
found = st.tuples(grids, grids).map(
    lambda pair: tuple(matrix(*each) for each in zip("uv", pair, strict=True))
)
filled = found.filter(
    lambda pair: (
        all(any(cell for row in each.cells for cell in row) for each in pair)
        and any(cell for each in pair for row in each.cells for cell in row[:3])
    )
)


def block(text=FRAME):
    (made,) = read_fcl(text, "mixer.fcl").blocks
    return made


def names_of(pair):
    """Return what both matrices of a pair share: which inputs are asked for at all."""
    return [each for each in pair if any(cell for row in each.cells[:3] for cell in row[:3])]


@given(filled.filter(names_of))
def test_matrices_become_rules_and_they_become_the_matrices(pair):
    model = block()
    text = replace_rules(Source("mixer.fcl", FRAME), model, rules(pair, model))
    again = matrices(block(text))
    assert again.beside == ()
    assert again.matrices == pair


@pytest.mark.parametrize(("write", "name"), [(as_csv, "t.csv"), (as_toml, "t.toml")])
@given(pair=found)
def test_a_table_is_read_as_it_was_written(write, name, pair):
    assert read(Source(name, write(pair))) == pair


@pytest.mark.parametrize("sign", [";", "\t"])
def test_cells_are_parted_by_semicolons_or_tabs_as_well(sign):
    (made,) = matrices(block()).matrices[:1]
    table = as_csv([made]).replace(",", sign)
    assert read(Source("t.csv", table)) == (made,)


def test_a_spreadsheet_leaves_empty_cells_behind_the_name_of_the_output_and_quotes_others():
    table = 'u,,\n"a \\ b",low,"mid"\nlow,"low, mid WITH 0.5",-\n,,\n'
    (made,) = read(Source("t.csv", table))
    assert made.cells == (((Entry(Word("low")), Entry(Word("mid"), 0.5)), ()),)


def test_all_but_the_rules_stays_as_it_stands():
    model = block()
    text = replace_rules(Source("mixer.fcl", FRAME), model, rules(matrices(model).matrices, model))
    assert text == FRAME


SHIPPED = sorted((ROOT / "scenarios").rglob("*.fcl"))
PLAIN = [
    each
    for each in SHIPPED
    if each.stem in {"crane_completed", "crane_printed", "crane_precise", "bilinear", "schedule"}
]


@pytest.mark.parametrize("file", PLAIN, ids=lambda file: file.stem)
def test_a_shipped_rule_base_says_the_same_after_it_was_a_table(file):
    (model,) = read_file(file).blocks
    shown = matrices(model)
    assert shown.beside == ()
    table = read(Source("t.csv", as_csv(shown.matrices)))
    own = {(each.condition, each.conclusions) for each in model.rule_blocks[0].rules}
    assert {(each.condition, each.conclusions) for each in rules(table, model)} == own


def test_a_text_has_a_column_for_each_term_and_a_sign_where_there_is_no_rule():
    assert as_text(matrices(block()).matrices) == (
        "u\n"
        "a \\ b  low  mid  high  *\n"
        "low    low  -    -     -\n"
        "mid    -    -    -     -\n"
        "high   -    -    -     high WITH 0.5\n"
        "\n"
        "v\n"
        "a \\ b  low  mid  high\n"
        "low    low  -    -\n"
        "mid    -    -    -\n"
        "high   -    -    -\n"
    )


ONE = """FUNCTION_BLOCK one
VAR_INPUT a: REAL; END_VAR
VAR_OUTPUT u: REAL; END_VAR
FUZZIFY a TERM low := (0, 1) (1, 0); TERM high := (0, 0) (1, 1); END_FUZZIFY
DEFUZZIFY u TERM small := 0; TERM large := 1; METHOD: CoGS; DEFAULT := 0; END_DEFUZZIFY
RULEBLOCK r
    RULE 1: IF a IS low THEN u IS small;
    RULE 2: IF a IS NOT low THEN u IS large;
END_RULEBLOCK
END_FUNCTION_BLOCK
"""


def test_of_one_input_the_only_column_is_any_and_what_is_no_cell_stands_beside():
    shown = matrices(loads(ONE).function_block)
    assert as_csv(shown.matrices) == "u\na,*\nlow,small\nhigh,\n"
    assert [rule.label for rule in shown.beside] == ["2"]
