"""Blocks that the tests of interop share."""

from pathlib import Path

import fcl_sim
from fcl_sim.block import Block
from fcl_sim.engine.assemble import assemble
from fcl_sim.model import AndOperator, FunctionBlock
from tests.engine.bases import tabulated

BENCH = Path(__file__).parents[2]

NARROW = """
FUNCTION_BLOCK narrow
VAR_INPUT x: LREAL; END_VAR
VAR_OUTPUT y: LREAL := 0.75; END_VAR
FUZZIFY x
  TERM low := (0, 1) (1, 0);
  TERM high := (2, 0) (3, 1);
END_FUZZIFY
DEFUZZIFY y
  TERM small := -1;
  TERM big := 4;
  METHOD: CoGS;
  DEFAULT := {default};
END_DEFUZZIFY
RULEBLOCK r
  AND: MIN; ACCU: MAX;
  RULE 1: IF x IS low THEN y IS small;
  RULE 2: IF x IS high THEN y IS big;
END_RULEBLOCK
END_FUNCTION_BLOCK
"""
"""No rule between 1 and 2."""


def built(block: FunctionBlock) -> Block:
    return Block(block, assemble(block))


def narrow(default: str = "NC") -> Block:
    return fcl_sim.loads(NARROW.format(default=default))


def crane() -> Block:
    return fcl_sim.load(BENCH / "scenarios" / "crane" / "crane_completed.fcl")


def linear(peaks: dict[str, tuple[float, ...]], gains: tuple[float, ...], norm=AndOperator.PROD) -> Block:
    """A base that equals the gains times its inputs between the first and the last peak of each (A.3)."""

    def law(*values):
        return sum(gain * value for gain, value in zip(gains, values, strict=True))

    return built(tabulated(peaks, law, norm))
