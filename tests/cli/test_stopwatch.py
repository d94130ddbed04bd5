"""What a stopwatch prints adds up to the time since the command was called."""

import re
from time import perf_counter

from fcl_sim.cli.stopwatch import Stopwatch


def test_what_went_before_is_the_start_and_all_parts_make_the_whole():
    watch = Stopwatch(perf_counter() - 2.0)
    watch.lap("drawing")
    assert re.fullmatch(r"2\.\d s: starting 2\.\d s", str(watch))


def test_without_a_call_it_counts_from_now():
    assert str(Stopwatch()) == "0.0 s"
