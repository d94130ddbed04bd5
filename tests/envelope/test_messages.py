"""What a user reads after a slip in an envelope."""

import pytest

from fcl_sim.diagnostics import InputFault
from fcl_sim.scenario.reader import read
from fcl_sim.testbench import prepare, run

LIMIT = '[[require]]\nid = "E-1"\ntext = "E"\nmetric = { peak = { signal = "crane.sway" } }\nmax = "9 deg"\n'
SLIPS = [
    (
        '"plant.parameters.load_mass" = "20 t"',
        "SCN501",
        "`plant.parameters.load_mass` a text instead of a list",
    ),
    ('"plant.parameters.load_mass" = []', "SCN501", "no values"),
    ('"plant.parameters" = {}', "SCN501", "no values"),
    ("seed = { form = 1, to = 5, count = 5 }", "SCN501", "did you mean `from`?"),
    ("seed = { from = 1, count = 5 }", "SCN501", "lacks `to`"),
    ("seed = { from = 1, to = 5, count = 1 }", "SCN501", "`count` of `seed` must be 2 or more, not 1"),
    ('seed = { from = 1, to = 5, count = "5" }', "SCN501", "whole number, not a text"),
    (
        'duration = { from = "1 s", to = "5 m", count = 3 }',
        "SCN404",
        "`from` of `duration` is in s, and `to` is in m",
    ),
    ('duration = { from = "1 s", to = "5 sekunden", count = 3 }', "SCN204", "sekunden"),
    ('duration = ["1 s", "1.02 s"]', "RUN101", "1.02"),
    ('duration = ["1 s", 2]', "SCN204", "needs a unit"),
    ("require = [1]", "SCN502", "cannot change `require`"),
    ('"plant.paramters.load_mass" = ["20 t"]', "SCN201", "did you mean `parameters`?"),
    ('"plant.parameters.laod_mass" = ["20 t"]', "SCN309", "did you mean `load_mass`?"),
    ('"plant.parameters.load_mass" = ["20 t", "5 m"]', "SCN404", "in kg, and this is in m"),
    ('"plant.parameters.load_mass" = ["20 t", "-5 t"]', "SCN310", "cannot be -5 t"),
    ('"plant.parameters.load_mass" = { from = "-5 t", to = "5 t", count = 3 }', "SCN310", "cannot be -5 t"),
    ('"plant.parameters.load_mass" = [true]', "SCN203", "true or false"),
    ('"controller.blocks.rule.arithmetic" = ["REAL"]', "SCN301", "did you mean `rules`?"),
    ('"blocks.saw.noise" = ["1 cm"]', "SCN301", "no block `saw`"),
    ('"blocks.seen.nose" = ["1 cm"]', "SCN201", "did you mean `noise`?"),
    ('"plant.start.position" = { from = "-9 m", to = "-1 m", count = 200000 }', "SCN503", "200000 points"),
    (
        """
        "plant.start.position" = { from = "-9 m", to = "-1 m", count = 500 }
        timing.seed = { from = 1, to = 500, count = 500 }""",
        "SCN503",
        "250000 points, 500 x 500, and 100000 are the most",
    ),
]


def told(file):
    with pytest.raises(InputFault) as caught:
        prepare(read(file))
    return str(caught.value), {each.code for each in caught.value.diagnostics}


@pytest.mark.parametrize(("vary", "code", "words"), SLIPS, ids=[each[0] for each in SLIPS])
def test_a_slip_in_a_grid_is_told_where_it_stands(written, vary, code, words):
    text, codes = told(written(f"[vary]\n{vary}"))
    assert words in text
    assert codes == {code} or code.startswith("RUN")
    assert "own.toml:" in text


@pytest.mark.parametrize(
    ("asked", "words"),
    [
        ("at_least = 13", "E-1 must hold at 13 points, and the envelope of `base` has 2"),
        ('at_least = 1\nover = "mean"', "`at_least` counts nothing"),
        ('at_least = 1\nover = "nominal"', "`at_least` counts nothing"),
        ('at_least = "95"', "cannot be `95`"),
        ("at_least = 0.95", "a number of points or a share of them"),
        ("at_least = { basis = 1 }", "did you mean `base`?"),
        ('over = "median"', "did you mean `mean`?"),
    ],
)
def test_a_slip_in_what_is_asked_of_a_grid_is_told(written, asked, words):
    text, _ = told(written('[vary]\n"timing.seed" = [1, 2]', LIMIT + asked))
    assert words in text


@pytest.mark.parametrize("asked", ['over = "points"', 'over = "mean"', "at_least = 2"])
def test_without_an_envelope_nothing_can_be_asked_of_it(written, asked):
    text, codes = told(written("", LIMIT + asked))
    assert codes == {"SCN504"}
    assert "give the scenario a [vary]" in text


@pytest.mark.parametrize("asked", ['over = "points"', "at_least = 2"])
def test_nor_of_a_run_that_has_none_though_others_have(written, asked):
    grid = '[vary]\n"timing.seed" = [1, 2]\n[variants.alone]\nvary = false\n'
    text, codes = told(written(grid, LIMIT + 'runs = ["alone"]\n' + asked))
    assert codes == {"SCN504"}
    assert "E-1" in text


def test_only_a_metric_has_a_mean(written):
    asked = '[[require]]\nid = "F"\ntext = "F"\nformula = "never crane.sway > 4 deg"\nover = "mean"'
    text, codes = told(written('[vary]\n"timing.seed" = [1, 2]', asked))
    assert codes == {"SCN504"}
    assert 'over = "points"' in text


def test_values_that_only_together_make_no_sense_are_told_when_their_turn_comes(written):
    file = written('[vary]\nduration = ["10 s", "9.95 s"]\n"controller.scan" = ["50 ms", "100 ms"]')
    with pytest.raises(InputFault, match=r"own\.toml:\d+"):
        run(file)
