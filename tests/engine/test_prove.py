"""The proof against the oracle, on a few bases; that the many of `make prove` use everything is counted."""

from itertools import product

from fcl_sim.engine.precision import REAL
from fcl_sim.model import AndOperator, RuleBlock
from tests.engine.agreement import BOUNDS, errors, is_remainder
from tests.engine.bases import block, every, output, points, rule, singleton
from tests.engine.features import features
from tests.engine.prove import CHUNK, SIZES, prove, report
from tests.engine.random_bases import (
    ACCU,
    ACT,
    AND,
    FOR_AREAS,
    FOR_SINGLETONS,
    NORMS,
    OR,
    random_base,
    random_values,
)
from tests.oracle import evaluate

EXPECTED = {
    *(f"AND {a} OR {b}" for a, b in (*product(AND, OR), *product(*NORMS[:2]))),
    *(f"ACT {each}" for each in ACT),
    *(f"ACCU {each}" for each in ACCU),
    *(f"ACCU of the output {each}" for each in (*ACCU, *NORMS[2])),
    *(f"METHOD {each} of areas" for each in FOR_AREAS),
    *(f"METHOD {each} of singletons" for each in FOR_SINGLETONS),
    *(f"{whose}: {count} points" for whose in ("input", "output") for count in range(1, 6)),
    *(f"{whose}: {what}" for whose in ("input", "output") for what in ("points moved", "vertical edge")),
    *("singleton", "singleton moved", "RANGE given", "RANGE missing", "DEFAULT NC", "DEFAULT number"),
    *("weight 0", "weight 1", "weight between 0 and 1", "weight by a variable"),
    *("several rule blocks", "several rule blocks that disagree on ACCU", "several conclusions"),
    *("degree in", "degree out", "local variable concluded", "member of a structure"),
    *("NOT Is", "NOT And", "NOT Or", "OR within AND", "what rules before concluded, IS"),
}


def test_random_bases_use_every_operator_method_and_shape():
    used = set()
    for seed in range(3 * CHUNK):
        used.update(features(random_base(seed, SIZES[seed % len(SIZES)], norms=seed % 4 == 3)))
    assert used >= EXPECTED


def test_a_chunk_of_bases_agrees_with_the_oracle(monkeypatch):
    monkeypatch.setattr("tests.engine.prove.CHUNK", 40)
    found = prove(10**6)
    assert found.wrong == []
    assert report(found)[-1].startswith("40 rule bases in LREAL and in REAL: ")


def test_a_base_that_is_off_is_told(monkeypatch):
    monkeypatch.setattr("tests.engine.prove.CHUNK", 1)
    monkeypatch.setattr("tests.engine.prove.errors", lambda *_: iter([("y by CoG", 2e-3, 1e-3)]))
    assert prove(7).wrong == [
        "seed 7: y by CoG is off by 0.002, more than 0.001 (LREAL norms CoG)",
        "seed 7: y by CoG is off by 0.002, more than 0.001 (REAL norms CoG)",
    ]


def test_what_rounding_leaves_of_a_bounded_difference_that_just_misses_is_no_error():
    base = random_base(63_668, SIZES[63_668 % len(SIZES)])
    assert {each.and_operator for each in base.rule_blocks} == {AndOperator.BDIF}
    values = random_values(63_668 + 3 * 10**9, base)
    assert all(error <= bound for _, error, bound in errors(base, [values], REAL))


def test_a_degree_that_is_0_by_structure_is_to_be_0_to_the_last_bit():
    def is_excused(operator, ours):
        base = one_rule(operator)
        opinion = evaluate(base, {"a": 0.5 if operator is AndOperator.BDIF else 0.0, "b": 0.5})
        assert opinion.rules == (0,)
        return is_remainder(base, opinion, "q", [ours], BOUNDS[REAL].rule)

    assert is_excused(AndOperator.BDIF, 3e-8)
    assert not is_excused(AndOperator.BDIF, 2e-6)
    assert not is_excused(AndOperator.MIN, 3e-8)


def one_rule(and_operator):
    term = points("t", (0, 0), (1, 1))
    only = rule("1", every(("a", "t"), ("b", "t")), ("q", "on"))
    rules = RuleBlock(name="first", and_operator=and_operator, rules=(only,))
    return block({"a": (term,), "b": (term,)}, (output("q", singleton("on", 1)),), rules)
