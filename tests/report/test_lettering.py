"""Letters are as wide in every copy of the process as in this one."""

import sys
from functools import partial
from pathlib import Path

import pytest

from fcl_sim.forked import FEW, do_all
from fcl_sim.report import lettering


@pytest.mark.skipif(sys.platform != "linux", reason="copies of a process")
def test_copies_of_a_process_measure_the_same_letters_at_the_same_time(tmp_path):
    letters = [chr(each) for each in range(0x100, 0x400)]

    def measured() -> str:
        lettering._advance.cache_clear()
        return " ".join(str(lettering._advance(each, bold=False)) for each in letters)

    def into(file: Path) -> None:
        try:
            told = measured()
        except RuntimeError as error:
            told = str(error)
        file.write_text(told, encoding="utf-8")

    alone = measured()
    do_all([partial(into, tmp_path / str(each)) for each in range(FEW + 4)], lambda _: None, workers=4)
    assert {each.read_text(encoding="utf-8") for each in tmp_path.iterdir()} == {alone}
