"""Which rules fire when: no firing is lost in the picture, whoever dominates has a line, texts are told."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fcl_sim.report import activation
from fcl_sim.report.canvas import Image, Line, Shape, Text
from tests.report.legible import clashes, cut
from tests.report.synthetic import LONG, crane, of_all_rules, run, trace


@pytest.fixture(scope="module")
def firing_of():
    def made(texts):
        """Return a firing of rules with such texts."""
        nothing = np.zeros((3, len(texts)))
        labels = tuple(str(each) for each in range(len(texts)))
        return activation.Firing(
            labels=labels, texts=tuple(texts), time=np.arange(3.0), degrees=nothing, dominant=nothing > 0.0
        )

    return made


@pytest.fixture
def firing(tmp_path):
    """Return a run in which rule 3 never fires, rule 1 leads at first and nothing fires at last."""
    made = run(tmp_path)
    node, found = made.diagram.nodes[0], of_all_rules(trace(), crane())
    record = found.fuzzy["controller.rules"]
    record.degrees[:] = 0.2
    record.degrees[:10, 0] = 0.9
    record.degrees[:, 2] = 0.0
    record.degrees[100:] = 0.0
    return activation.firing_of(node, record, found.time)


def test_the_rules_have_their_labels_and_texts(firing):
    assert firing.labels == ("1", "2", "3", "4", "5", "6")
    assert firing.texts[0] == "IF distance IS far AND angle IS zero THEN power IS pos_medium"
    assert activation.brief(firing.texts[0]) == "distance far, angle zero: power pos_medium"


@pytest.mark.parametrize(
    ("condition", "told"),
    [
        ("a IS lo AND b IS lo AND c IS lo", "a lo, b lo, c lo: u small"),
        ("a IS lo OR b IS lo AND c IS lo", "a lo OR b lo AND c lo: u small"),
        ("NOT (a IS lo AND b IS lo)", "NOT (a lo AND b lo): u small"),
    ],
)
def test_a_comma_stands_for_and_only_where_nothing_else_joins(condition, told):
    assert activation.brief(f"IF {condition} THEN u IS small") == told


def test_a_line_stands_where_a_rule_dominates_and_hatching_where_none_fires(firing):
    (axes, _) = activation.draw(firing, firing.idle).axes
    (line,) = axes.of(Line, "dominant")
    (hatched,) = [each for each in axes.of(Shape) if each.hatched]
    first = np.array(line.x)[np.array(line.y) == 0.5]
    assert first.min() == 0.0
    assert np.nanmin(hatched.x) == pytest.approx(50.0, abs=0.5)
    assert not (np.array(line.y) == 2.5).any()
    assert len(axes.of(Image)) == 1


def test_rows_of_unlike_heights_are_parted_where_they_meet(firing_of):
    (axes, _) = activation.draw(firing_of([LONG, "short", "short"]), np.zeros(3, np.bool_)).axes
    (parting,) = [each for each in axes.of(Line) if each.parts and not each.free]
    places = sorted({round(float(each), 9) for each in parting.y if not np.isnan(each)}, reverse=True)
    first, second, third = -np.diff(places)
    assert (places[0], places[-1]) == (1.0, 0.0)
    assert first > 1.5 * second
    assert second == pytest.approx(third)


def test_it_is_told_in_words(firing):
    told = activation.alt(firing)
    assert "Degrees of 6 rules from 0 s to 60 s, in 121 samples." in told
    assert "Rules that never fire: 3." in told
    assert "No rule fires in 17.4 % of the samples." in told


@settings(max_examples=50)
@given(st.lists(st.floats(0.0, 1.0), min_size=2, max_size=60), st.integers(1, 80))
def test_the_largest_degree_is_in_the_picture_however_coarse(degrees, count):
    time = np.arange(len(degrees), dtype=float)
    edges = np.linspace(0.0, time[-1] + 1.0, count + 1)
    found = activation._largest(time, np.array(degrees)[:, None], edges)
    assert found.shape == (1, count)
    assert found.max() == max(degrees)
    assert set(found.ravel()) <= set(degrees)


def test_each_rule_base_is_shown_by_the_first_run_that_uses_it(tmp_path):
    first, second = run(tmp_path), run(tmp_path, "again")
    assert activation.first_users([first, second]) == [first]


def test_a_long_rule_takes_lines_and_is_never_cut(firing):
    long = "IF " + " AND ".join(f"{LONG} IS term_{each}" for each in range(4)) + " THEN valve IS open"
    texts = (firing.texts[0], long, *firing.texts[2:])
    drawn = activation.draw(replace(firing, texts=texts), firing.idle)
    written = [each.text for each in drawn.axes[0].of(Text)]
    shown = ["".join(each.split()) for each in written]
    assert "".join(activation.brief(long).split()) in shown
    assert not any("…" in each for each in written)
    assert cut(drawn) == []
    assert clashes(drawn) == []


@given(st.lists(st.integers(1, 8), min_size=1, max_size=150))
@settings(max_examples=30)
def test_rules_are_parted_into_pages_that_hold_them(firing_of, words):
    made = firing_of(["IF " + " AND ".join(["distance IS somewhat_far"] * each) for each in words])
    parted = activation._parted(made)
    assert [row for each in parted for row in range(len(words))[each]] == list(range(len(words)))
    for each in parted:
        assert activation._edges(made.rows(each))[-1] <= activation.MOST_ROWS


def test_a_last_scan_in_which_no_rule_fires_can_be_seen(firing):
    idle = np.zeros(len(firing.time), np.bool_)
    idle[-1] = True
    (axes, _) = activation.draw(firing, idle).axes
    (hatched,) = [each for each in axes.of(Shape) if each.hatched]
    part = (max(hatched.x) - min(hatched.x)) / (axes.x[1] - axes.x[0])
    assert part * axes.width > 0.5
    assert max(hatched.x) <= axes.x[1]


def test_rules_on_several_figures_are_told_each_where_it_is(firing_of):
    many = firing_of([LONG] * 80)
    slices = activation._parted(many)
    assert len(slices) > 1
    told = [activation.alt(many.rows(each), (), many.idle) for each in slices]
    assert len(set(told)) == len(slices)
    assert all(
        each.startswith(f"Degrees of {part.stop - part.start} rules")
        for each, part in zip(told, slices, strict=True)
    )
    assert "Here rules 0 to " in activation._which(many.rows(slices[0]))
