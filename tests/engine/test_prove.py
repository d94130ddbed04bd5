"""The proof against the oracle, on a few bases; that the many of `make prove` use everything is counted."""

from itertools import product

from tests.engine.features import features
from tests.engine.prove import CHUNK, SIZES, prove, report
from tests.engine.random_bases import ACCU, ACT, AND, FOR_AREAS, FOR_SINGLETONS, NORMS, OR, random_base

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
