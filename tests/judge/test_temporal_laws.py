"""Formulae mean what their definition says, and keep the laws of temporal logic."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from fcl_sim.formula.text import plain
from fcl_sim.judge.temporal.evaluate import HIGH, LOW, POSSIBLE, SURE, evaluate
from fcl_sim.judge.temporal.formula import Formula, Statement, read
from fcl_sim.judge.temporal.tree import Edge, Interval, Junction, Not, Truth, Until, Window
from fcl_sim.judge.temporal.verdict import Truth as Outcome
from fcl_sim.judge.temporal.verdict import consider
from fcl_sim.judge.temporal.write import written
from tests.judge.formulae import SPAN, STEP, intervals, meaning, traces, trees


def rows(tree, run):
    return evaluate(tree, run).rows


def same(one, other, run) -> bool:
    return np.array_equal(rows(one, run), rows(other, run))


def window(operator, interval, operand):
    return Window(operator, interval, operand, SPAN)


def no(operand):
    return Not(operand, SPAN)


@settings(max_examples=300)
@given(trees(), traces())
def test_at_every_scan_a_formula_means_what_its_definition_says(tree, run):
    expected = [meaning(tree, scan, run) for scan in range(len(run.ticks))]
    assert rows(tree, run).T.tolist() == [list(each) for each in expected]


@settings(max_examples=200)
@given(trees(), traces(regular=True))
def test_so_it_does_where_all_scans_are_equally_far_apart(tree, run):
    expected = [meaning(tree, scan, run) for scan in range(len(run.ticks))]
    assert rows(tree, run).T.tolist() == [list(each) for each in expected]


@given(trees(), traces())
def test_a_text_is_read_back_as_the_tree_that_it_was_written_from(tree, run):
    assert read(plain(written(tree))).tree == tree


@given(trees(), traces())
def test_the_sign_of_the_robustness_is_sound(tree, run):
    found = rows(tree, run)
    assert (found[LOW] <= found[HIGH]).all()
    assert (found[SURE] <= found[POSSIBLE]).all()
    assert (found[SURE][found[LOW] > 0] > 0).all()
    assert (found[POSSIBLE][found[HIGH] < 0] < 0).all()


@given(trees(), trees(), intervals(), traces())
def test_each_operator_has_its_dual(p, q, interval, run):
    assert same(no(no(p)), p, run)
    assert same(no(window("always", interval, p)), window("eventually", interval, no(p)), run)
    assert same(no(Junction("and", p, q, SPAN)), Junction("or", no(p), no(q), SPAN), run)
    assert same(Junction("implies", p, q, SPAN), Junction("or", no(p), q, SPAN), run)
    assert same(Edge("fall", p, SPAN), Edge("rise", no(p), SPAN), run)


@given(trees(), intervals(), traces())
def test_eventually_is_until_with_nothing_to_hold(p, interval, run):
    assert same(window("eventually", interval, p), Until(interval, Truth(True, SPAN), p, SPAN), run)


@given(trees(), trees(), traces())
def test_windows_distribute_over_their_junction(p, q, run):
    to = Interval(STEP, 3 * STEP)
    for operator, joined in (("always", "and"), ("eventually", "or")):
        both = Junction(joined, window(operator, to, p), window(operator, to, q), SPAN)
        assert same(window(operator, to, Junction(joined, p, q, SPAN)), both, run)


@given(trees(), traces(regular=True))
def test_windows_within_each_other_add_up_where_they_end_on_scans(p, run):
    inner, outer, whole = Interval(STEP, 2 * STEP), Interval(0, 3 * STEP), Interval(STEP, 5 * STEP)
    for operator in ("always", "eventually"):
        assert same(window(operator, outer, window(operator, inner, p)), window(operator, whole, p), run)


@given(trees(), traces(), traces())
def test_what_is_decided_stays_decided_however_the_trace_goes_on(tree, run, more):
    """Of formulae without windows to the end, which mean the end that there is."""
    if "end]" in (text := written(tree)) or "always (" in text or "eventually (" in text or "until (" in text:
        return
    ticks = np.concatenate([run.ticks, run.ticks[-1] + STEP // 2 + more.ticks])
    longer = type(run)(ticks, run.names, run.units, np.vstack([run.values, more.values]))
    now, then = rows(tree, run), rows(tree, longer)[:, : len(run.ticks)]
    assert (now[LOW] <= then[LOW]).all()
    assert (now[HIGH] >= then[HIGH]).all()
    assert (now[SURE] <= then[SURE]).all()
    assert (now[POSSIBLE] >= then[POSSIBLE]).all()


@settings(max_examples=300)
@given(trees(), traces())
def test_what_fails_names_scans_that_make_it_fail(tree, run):
    """With the others unknown it still fails, but for the one before: an edge is seen from there."""
    found = consider(Formula(Statement(tree, ""), tree, ("x", "y"), ""), run)
    if found.truth is Outcome.FAILS:
        first, last = found.violation
        assert 0 <= first <= last < len(run.ticks)
        values = np.full_like(run.values, np.nan)
        shown = slice(max(first - 1, 0), last + 1)
        values[shown] = run.values[shown]
        hidden = type(run)(run.ticks, run.names, run.units, values)
        assert rows(tree, hidden)[POSSIBLE][0] < 0
    else:
        assert found.violation is None


@given(trees(), traces())
def test_a_robustness_is_the_margin_of_the_comparison_that_decides(tree, run):
    found = consider(Formula(Statement(tree, ""), tree, ("x", "y"), ""), run)
    if found.robustness is not None:
        assert (found.robustness >= 0) == (found.truth is Outcome.HOLDS) or found.robustness == 0
        comparison, scan = found.decided_by
        assert abs(meaning(comparison, scan, run)[0]) == abs(found.robustness)


@settings(max_examples=300)
@given(trees(), traces(), st.data())
def test_a_sample_that_is_missing_is_told_or_makes_no_difference(tree, run, data):
    missing = data.draw(st.sets(st.integers(0, len(run.ticks) - 1), min_size=1))
    values = run.values.copy()
    values[sorted(missing), data.draw(st.integers(0, 1))] = np.nan
    whole = Formula(Statement(tree, ""), tree, ("x", "y"), "")
    found = consider(whole, type(run)(run.ticks, run.names, run.units, values))
    expected = consider(whole, run)
    if found.truth is not Outcome.BROKEN:
        assert (found.truth, found.robustness) == (expected.truth, expected.robustness)
