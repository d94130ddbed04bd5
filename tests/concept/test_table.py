"""The table of block types: names of the manual, and each row's kernel behind its opcode."""

import re

import numpy as np
import pytest

from fcl_sim import concept
from fcl_sim.concept.execute import execute_int, execute_real

LIBRARY = {f"{block}_{kind}" for block in ("FUZ_ATERM", "DEFUZ") for kind in ("INT", "REAL", "STI", "STR")}
LIBRARY |= {
    f"FUZ_{block}_{kind}" for block in ("STERM", "MIN", "MAX", "PROD", "SUM") for kind in ("INT", "REAL")
}


def test_the_table_has_every_block_of_the_library_and_no_other():
    assert set(concept.BLOCKS) == LIBRARY
    assert [each.name for each in concept.BLOCKS.values()] == [each.name for each in concept.TABLE]


def test_every_block_is_made_by_its_name():
    for name, kind in concept.BLOCKS.items():
        assert repr(getattr(concept, name)()).startswith(f"<instance of {kind.name}:")


@pytest.mark.parametrize("kind", concept.TABLE, ids=lambda each: each.name)
def test_a_row_declares_all_of_itself(kind):
    assert kind.number == ("REAL" if kind.name.endswith(("REAL", "STR")) else "INT")
    assert kind.summary
    assert kind.equation
    assert re.fullmatch(r"Concept 2\.6, FUZZY library, pp\. \d\d-\d\d", kind.source)
    words = kind.inputs(kind.most) + kind.outputs
    assert len(set(words)) == len(words)


@pytest.mark.parametrize("opcode", range(len(concept.TABLE)), ids=lambda each: concept.TABLE[each].name)
def test_an_opcode_runs_the_kernel_of_its_row(opcode):
    kind = concept.TABLE[opcode]
    integer = kind.number == "INT"
    assert integer == (opcode % 2 == 0)
    full, dtype = (10_000, np.int64) if integer else (1, np.float32)
    for count in (kind.least, min(kind.most, 9), kind.most + 1):
        for words in (np.arange(1, 60), np.arange(60, 1, -1), np.resize([3, 8, 1, 5], 59)):
            inputs = (words * full / 60).astype(dtype)[: len(kind.inputs(count))]
            ours, theirs = np.full((2, len(kind.outputs)), 7, dtype)
            if integer:
                event = execute_int(opcode, inputs, count, ours, 1)
                assert event == kind.kernel(inputs, count, theirs, 1)
            else:
                event = execute_real(opcode, inputs, count, ours)
                assert event == kind.kernel(inputs, count, theirs)
            assert np.array_equal(ours, theirs)
