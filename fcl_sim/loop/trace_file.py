"""A trace as a file: CSV for people and spreadsheets, NPZ for programs."""

import csv
import os
from collections.abc import Callable, Mapping
from io import TextIOWrapper
from pathlib import Path
from typing import BinaryIO

import numpy as np

from fcl_sim.diagnostics import InputFault
from fcl_sim.diagnostics.spelling import listed
from fcl_sim.loop.trace import Trace
from fcl_sim.loop.trace_columns import table


def write(trace: Trace, path: Path) -> None:
    """Write a trace to `path`, whole or not at all; its ending decides the format.

    `.csv`: one line per sample, `time [s]` first, each column with its unit in
    the header, numbers to the last digit. `.npz`: the arrays `ticks` (n,) in
    nanoseconds, `values` (n, columns), `names`, `units`. The columns are those
    of `trace_columns`. InputFault for another ending; OSError where the system
    refuses.
    """
    writer = WRITERS.get(path.suffix.lower())
    if writer is None:
        raise InputFault.at_file(
            "RUN104",
            str(path),
            f"a trace is not written as `{path.suffix or path.name}`",
            f"end the name in {listed(WRITERS)}",
        )
    unfinished = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        with unfinished.open("wb") as file:
            writer(trace, file)
        unfinished.replace(path)
    finally:
        unfinished.unlink(missing_ok=True)


def _write_csv(trace: Trace, file: BinaryIO) -> None:
    columns = table(trace)
    names = zip(columns.names, columns.units, strict=True)
    header = ["time [s]", *(f"{name} [{unit or '1'}]" for name, unit in names)]
    rows = np.column_stack([trace.time, columns.values]).tolist()
    text = TextIOWrapper(file, encoding="utf-8", newline="")
    lines = csv.writer(text, lineterminator="\n")
    lines.writerow(header)
    lines.writerows(rows)
    text.detach()


def _write_npz(trace: Trace, file: BinaryIO) -> None:
    columns = table(trace)
    np.savez_compressed(
        file,
        ticks=trace.ticks,
        values=columns.values,
        names=np.array(columns.names, dtype=np.str_),
        units=np.array(columns.units, dtype=np.str_),
    )


WRITERS: Mapping[str, Callable[[Trace, BinaryIO], None]] = {".csv": _write_csv, ".npz": _write_npz}
