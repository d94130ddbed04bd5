import itertools

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from fcl_sim.report.stretches import stretches


@given(st.lists(st.booleans()))
def test_stretches_put_the_flags_together_again(flags):
    built = np.zeros(len(flags), dtype=bool)
    for start, end in stretches(np.array(flags, dtype=bool)):
        assert not built[start:end].any()
        assert start < end
        built[start:end] = True
    assert built.tolist() == flags


@given(st.lists(st.booleans()))
def test_no_stretch_begins_where_another_ends(flags):
    found = stretches(np.array(flags, dtype=bool))
    assert all(end < start for (_, end), (start, _) in itertools.pairwise(found))
