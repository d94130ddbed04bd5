"""The grammar as data: productions, and texts drawn from them."""

import re

from hypothesis import strategies as st

COMMENT = re.compile(r"\(\*.*?\*\)", re.DOTALL)
PRODUCTION = re.compile(r"^(\w+) ::= (.*?)(?=\n\n|\Z)", re.DOTALL | re.MULTILINE)
WORD = re.compile(r"'[^']*'|\w+|[\[\]{}()|]")
CLOSING = {"[": "]", "{": "}", "(": ")"}
DEEPEST = 12
NUMBERS = ("0", "1.5", "16#FF", "1E-3", ".5", "REAL#2")
LEAVES = {
    "any_text": st.sampled_from(("", "scan = 50 ms", "§ 'x' (")),
    "label": st.sampled_from(("1", "3a", "first", "007")),
    "integer_literal": st.sampled_from(NUMBERS),
    "real_literal": st.sampled_from(NUMBERS),
    "data_type": st.sampled_from(("REAL", "INT", "colour")),
    "algorithm": st.sampled_from(("MIN", "CoGS", "whatever")),
    "shape_name": st.sampled_from(("TRIAN", "Discrete", "SINGLETONS", "Linear")),
    "function_name": st.sampled_from(("sin", "abs", "EXP")),
}
NAMES = st.sampled_from(("a", "b", "temp", "x_1", "time", "very", "type"))


def productions(text):
    """Return the right side of each production as written, spaces made one."""
    return {name: " ".join(right.split()) for name, right in PRODUCTION.findall(COMMENT.sub("", text))}


def parsed(right):
    """Return a right side as nested tuples: ("|", …), (",", …), ("[", x), ("{", x), or a word."""
    words = WORD.findall(right)
    tree, at = _alternatives(words, 0)
    assert at == len(words)
    return tree


def _alternatives(words, at):
    found = []
    while True:
        sequence = []
        while at < len(words) and words[at] not in {"|", "]", "}", ")"}:
            if words[at] in CLOSING:
                inner, end = _alternatives(words, at + 1)
                assert words[end] == CLOSING[words[at]]
                sequence.append((words[at], inner))
                at = end + 1
            else:
                sequence.append(words[at])
                at += 1
        found.append((",", *sequence))
        if at == len(words) or words[at] != "|":
            return ("|", *found), at
        at += 1


def words_of(tree):
    """Return the words of a right side, names and terminals."""
    return {tree} if isinstance(tree, str) else {word for each in tree[1:] for word in words_of(each)}


@st.composite
def sentences(draw, grammar, start):
    """Draw a text from `start`, a word to a line; loops end and choices take the first where it gets deep."""
    out = []

    def expand(tree, depth):
        if isinstance(tree, str):
            if tree.startswith("'"):
                out.append(tree[1:-1])
            elif tree in grammar:
                expand(grammar[tree], depth + 1)
            else:
                out.append(draw(LEAVES.get(tree, NAMES)))
            return
        kind, *parts = tree
        if kind == "|":
            expand(parts[0] if depth > DEEPEST else draw(st.sampled_from(parts)), depth)
        elif kind == ",":
            for each in parts:
                expand(each, depth)
        elif kind == "(":
            expand(parts[0], depth)
        elif depth <= DEEPEST:
            for _ in range(draw(st.integers(0, 2 if kind == "{" else 1))):
                expand(parts[0], depth + 1)

    expand(grammar[start], 0)
    return "\n".join(out).replace("\n%\n", " % ")  # a line that begins with % is a comment
