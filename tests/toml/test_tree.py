"""Trees are laid over one another: what is not named stays, and a dotted key is a path."""

from hypothesis import given
from hypothesis import strategies as st

from fcl_sim.diagnostics import Source
from fcl_sim.scenario.document import parse
from fcl_sim.scenario.overrides import overrides_tree
from fcl_sim.toml.tree import overlaid

keys = st.sampled_from(["a", "b", "c", "d"])
leaves = st.integers(0, 9) | st.text('xyz "\\\n', max_size=3) | st.booleans() | st.lists(st.integers(0, 3))
trees = st.recursive(leaves, lambda each: st.dictionaries(keys, each, max_size=3), max_leaves=8)
tables = st.dictionaries(keys, trees, max_size=3)


def merged(base: object, over: object) -> object:
    if not (isinstance(base, dict) and isinstance(over, dict)):
        return over
    return {**base, **{key: merged(base[key], each) if key in base else each for key, each in over.items()}}


@given(tables, tables)
def test_an_overlay_is_a_deep_merge(base, over):
    assert overlaid(overrides_tree(base), overrides_tree(over)).plain() == merged(base, over)


@given(tables)
def test_laying_nothing_or_itself_over_a_tree_changes_nothing(base):
    tree = overrides_tree(base)
    assert overlaid(tree, overrides_tree({})).plain() == base
    assert overlaid(tree, tree).plain() == base


@given(tables)
def test_overrides_come_back_as_they_were_given(values):
    assert overrides_tree(values).plain() == values


def test_a_dotted_key_is_a_path_in_quotes_and_without():
    quoted = parse(Source("x", '"a.b.c" = 1\na."b.d" = 2'))
    assert quoted.plain() == {"a": {"b": {"c": 1, "d": 2}}}
    assert [name for name, _ in quoted.leaves()] == ["a.b.c", "a.b.d"]


def test_a_key_that_only_looks_dotted_stays_whole():
    assert parse(Source("x", '"a." = 1\n"." = 2')).plain() == {"a.": 1, ".": 2}


def test_another_type_replaces_the_table():
    base = overrides_tree({"f": {"type": "lag", "time": "1 s", "input": "x"}})
    over = overrides_tree({"f": {"type": "gain", "gain": 2}})
    same = overrides_tree({"f": {"type": "lag", "time": "2 s"}})
    assert overlaid(base, over).plain() == {"f": {"type": "gain", "gain": 2}}
    assert overlaid(base, same).plain() == {"f": {"type": "lag", "time": "2 s", "input": "x"}}


def test_an_entry_points_at_the_text_it_came_from():
    base, over = parse(Source("base", "a = { b = 1, c = 2 }")), parse(Source("over", '"a.c" = 3'))
    tree = overlaid(base, over)
    where = {name: (each.span.source.name, each.span.text, each.key.text) for name, each in tree.leaves()}
    assert where == {"a.b": ("base", "1", "b"), "a.c": ("over", "3", '"a.c"')}
