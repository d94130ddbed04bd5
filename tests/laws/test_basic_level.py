"""What is rewritten for the Basic Level computes the same, to the last bit (Table 8, 5.2.4)."""

import numpy as np
from hypothesis import event, given, settings
from hypothesis import strategies as st

import fcl_sim
from fcl_sim import fcl
from fcl_sim.diagnostics import InputFault, Source

INPUTS = ("a", "b")
OUTPUTS = ("y", "z")
TERMS = ("s", "t", "u")
XS = st.integers(-8, 8).map(lambda n: n / 4)

subconditions = st.builds("{} IS {}".format, st.sampled_from(INPUTS), st.sampled_from(TERMS))


def joined(inner):
    several = st.lists(inner, min_size=2, max_size=3)
    return st.builds(
        lambda word, parts: f"({f' {word} '.join(parts)})", st.sampled_from(("AND", "OR")), several
    )


conditions = st.recursive(subconditions, joined, max_leaves=6)
conclusions = st.lists(
    st.builds("{} IS {}".format, st.sampled_from(OUTPUTS), st.sampled_from(TERMS)),
    min_size=1,
    max_size=3,
    unique=True,
).map(", ".join)


def often(value, *others):
    """Draw mostly `value`: the others are refused where they matter."""
    return st.sampled_from((value,) * 5 + others)


@st.composite
def terms(draw):
    """Draw up to three points, sometimes more; many have a level stretch before or behind them."""
    degrees = draw(often([0, 1, 0], [1, 0], [0, 1, 1, 0]))
    degrees = [*degrees[:1] * draw(st.integers(0, 1)), *degrees, *degrees[-1:] * draw(st.integers(0, 2))]
    xs = sorted(draw(st.lists(XS, min_size=len(degrees), max_size=len(degrees))))
    return " ".join(f"({x}, {degree})" for x, degree in zip(xs, degrees, strict=True))


@st.composite
def rule_blocks(draw, name):
    rules = draw(st.lists(st.tuples(conditions, conclusions), min_size=1, max_size=4))
    lines = [
        f"RULE {n}: IF {condition} THEN {conclusion};" for n, (condition, conclusion) in enumerate(rules)
    ]
    return f"""RULEBLOCK {name}
    AND: {draw(often("MIN", "PROD"))}; OR: {draw(often("MAX", "ASUM"))};
    ACT: {draw(st.sampled_from(("MIN", "PROD")))}; ACCU: {draw(often("MAX", "BSUM", "NSUM"))};
    {" ".join(lines)}
END_RULEBLOCK"""


@st.composite
def rule_bases(draw):
    parts = ["FUNCTION_BLOCK basic\nVAR_INPUT a, b: REAL; END_VAR VAR_OUTPUT y, z: REAL; END_VAR"]
    for name in INPUTS:
        written = " ".join(f"TERM {each} := {draw(terms())};" for each in TERMS)
        parts += [f"FUZZIFY {name} {written} END_FUZZIFY"]
    for name in OUTPUTS:
        places = " ".join(f"TERM {each} := {draw(XS)};" for each in TERMS)
        rest = "RANGE := (-9 .. 9); METHOD: CoGS; DEFAULT := 0.125;"
        parts += [f"DEFUZZIFY {name} {places} {rest} END_DEFUZZIFY"]
    parts += [draw(rule_blocks(name)) for name in ("one", "two")[: draw(st.integers(1, 2))]]
    return "\n".join([*parts, "END_FUNCTION_BLOCK"])


@settings(max_examples=150, deadline=None)
@given(rule_bases(), st.integers(0, 2**32 - 1))
def test_a_rule_base_of_the_basic_level_computes_the_same_to_the_last_bit(text, seed):
    try:
        rewritten = fcl.rewrite(Source("t", text), basic=True)
    except InputFault:
        event("refused")
        return
    event("rewritten")
    random = np.random.default_rng(seed)
    values = {name: random.uniform(-2.5, 2.5, 200) for name in INPUTS}
    values["a"][:50] = random.integers(-10, 11, 50) / 4
    before = fcl_sim.loads(text).evaluate(values)
    after = fcl_sim.loads(rewritten).evaluate(values)
    for name in OUTPUTS:
        assert before[name].tobytes() == after[name].tobytes()
    assert " OR " not in rewritten
    assert rewritten.count("RULEBLOCK ") == 1
