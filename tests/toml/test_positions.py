"""Every key and value that tomllib reads is found where it stands in the text."""

import tomllib
from collections.abc import Iterator

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fcl_sim.diagnostics import Source
from fcl_sim.toml.positions import KeyPath, positions


def paths_of(value, path: KeyPath = ()) -> Iterator[tuple[KeyPath, object]]:
    if path:
        yield path, value
    if isinstance(value, dict):
        for key, each in value.items():
            yield from paths_of(each, (*path, key))
    elif isinstance(value, list):
        for index, each in enumerate(value):
            yield from paths_of(each, (*path, index))


def check(text: str) -> None:
    """Each path has a position; a key's text is its last key, a leaf's text is its value."""
    data = tomllib.loads(text)
    found = positions(Source("x.toml", text))
    expected = dict(paths_of(data))
    assert set(found) == set(expected)
    for path, value in expected.items():
        position = found[path]
        if isinstance(path[-1], str):
            assert list(tomllib.loads(f"{position.key.text} = 0")) == [path[-1]]
        if not isinstance(value, dict | list):
            assert tomllib.loads(f"x = {position.value.text}")["x"] == value


NUMBERS = ["1", "-17", "0xFF", "1_000", "1.5", "-1e-3", "inf", "true", "false"]
DATES = ["1979-05-27", "1979-05-27 07:32:00", "07:32:00", "1979-05-27T07:32:00.5Z"]
SHORT = ['"20 t"', '""', r'"a\"b # [x] = {y}"', r'"\\"', "'C:\\x'", "''", "'#'"]
BASIC = ['"""one\ntwo # no comment"""', r'"""quo"te \""" end"""', '"""two""""']
LITERAL = ["'''it''s\n\"x\" = 1'''", "''''a'''''"]
LEAVES = [*NUMBERS, *DATES, *SHORT, *BASIC, *LITERAL]
KEYS = ["a", "b-c", "d_1", '"e f"', "'g.h'", '""', r'"\u00e9\"="', "1", "'#'", '"]"']
names = st.sampled_from(KEYS)
space = st.sampled_from(["", " ", "\t", "  "])
comment = st.sampled_from(["", " # note", "# [x] 'y\" = {"])
newline = st.sampled_from(["\n", "\r\n", "\n\n", "\n# comment = [\n"])


@st.composite
def values(draw: st.DrawFn, depth: int = 2) -> str:
    kind = draw(st.integers(0, 5)) if depth else 0
    if kind == 4:
        parts = draw(st.lists(values(depth - 1), max_size=3))
        gap = draw(st.sampled_from([" ", "\n  ", " # note ]\n"]))
        trailing = "," if parts and draw(st.booleans()) else ""
        return "[" + gap + f",{gap}".join(parts) + trailing + gap + "]"
    if kind == 5:
        chosen = draw(st.lists(names, max_size=3, unique_by=decoded))
        pairs = [f"{key}{draw(space)}={draw(space)}{draw(values(depth - 1))}" for key in chosen]
        return "{" + draw(space) + ", ".join(pairs) + draw(space) + "}"
    return draw(st.sampled_from(LEAVES))


def decoded(key: str) -> str:
    return next(iter(tomllib.loads(f"{key} = 0")))


@st.composite
def documents(draw: st.DrawFn) -> str:
    lines: list[str] = []
    for section in range(draw(st.integers(0, 4))):
        if section:
            header = draw(space).join(
                ["", *draw(st.sampled_from([["x"], ["x", ".", "y"], ["'q'", ".", "z"]]))]
            )
            style = draw(st.sampled_from([("[", "]"), ("[[", "]]")]))
            lines.append(
                f"{draw(space)}{style[0]}{header.replace('x', f'x{section}')}{style[1]}{draw(comment)}"
            )
            if style[0] == "[[" and draw(st.booleans()):
                lines.append(lines[-1])
        for key in draw(st.lists(names, max_size=4, unique_by=decoded)):
            dotted = draw(st.lists(st.sampled_from(["s", "t"]), max_size=2))
            whole = f"{draw(space)}.{draw(space)}".join([key, *dotted])
            lines.append(f"{draw(space)}{whole}{draw(space)}={draw(space)}{draw(values())}{draw(comment)}")
    return "".join(line + draw(newline) for line in lines)


@given(documents())
@settings(max_examples=150)
def test_positions_agree_with_tomllib_on_any_document(text: str) -> None:
    try:
        tomllib.loads(text)
    except tomllib.TOMLDecodeError:
        return  # some sections clash; most do not
    check(text)


@pytest.mark.parametrize(
    "text",
    [
        "",
        "# only a comment",
        "a = 1",
        'a.b."c d" = 2\na.b.e = [1, [2, 3], {f = "x"}]',
        "[[r]]\nid = 1\n[r.s]\nt = 1\n[[r]]\nid = 2\n[r.s]\nt = 2\n[[r.u]]\nv = 1\n[[r.u]]\nv = 2\n",
        "[a.b.c]\n[a]\nx = 1\n[a.b]\ny = 2",
        "a = {b = {c = {}}}\n[ d . 'e' ] # note\nf = [ # note\n  1, # two\n  2,\n]",
        "a = \"\"\"\n  x = [\n\"\"\"\nb = '''\n[y]\n'''",
    ],
)
def test_positions_agree_with_tomllib(text: str) -> None:
    check(text)


def test_a_position_counts_lines_and_columns() -> None:
    text = 'title = "x"\n\n[plant]\nparameters = { mass = "20 t",\r\n cable = 3 }\n'
    found = positions(Source("x.toml", text))
    where = {path: (each.key.line, each.key.column, each.value.text) for path, each in found.items()}
    assert where["plant",] == (3, 2, "plant")
    assert where["plant", "parameters", "mass"] == (4, 16, '"20 t"')
    assert where["plant", "parameters", "cable"] == (5, 2, "3")
