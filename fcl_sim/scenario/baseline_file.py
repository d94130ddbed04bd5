"""Baselines in and out: a text beside the scenario, for people, editors and `git diff`.

`baselines/SCENARIO.VARIANT.toml` in the folder of the scenario. What it is
about is a noun of `judge.baseline`; here it has its place and its form.
"""

import hashlib
import json
import os
import tomllib
from collections.abc import Collection, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from pydantic import ValidationError

from fcl_sim.diagnostics import InputFault
from fcl_sim.judge.baseline import (
    DIGITS,
    Baseline,
    Figure,
    MetricReference,
    RuleBaseReference,
    SignalReference,
)
from fcl_sim.scenario.baseline_shape import WORDS, BaselineFile
from fcl_sim.scenario.bench import BASELINES
from fcl_sim.scenario.document import BASELINE_FILE, parse, read_file
from fcl_sim.scenario.model import SourceFile
from fcl_sim.scenario.shape import shape_faults
from fcl_sim.toml.tree import Entry, finding
from fcl_sim.units import Quantity, UnitError, nanoseconds, parse_quantity, parse_unit, short

LONGEST = 200
"""Bytes of a file's name; of a longer one the rest is a digest, for file systems take 255."""

HEAD = """\
# What this run came to when it was last accepted. `fcl-sim baseline update --reason "..."` writes it;
# the tolerances are yours to change, and an update keeps them.
"""


def path_of(scenario: Path, variant: str) -> Path:
    """Return the file of a variant's baseline."""
    name = f"{scenario.stem}.{variant}"
    if len(name.encode()) > LONGEST:
        digest = hashlib.sha256(name.encode()).hexdigest()[:12]
        name = f"{name.encode()[:LONGEST].decode(errors='ignore')}.{digest}"
    return scenario.parent / BASELINES / f"{name}.toml"


def read(scenario: Path, variant: str) -> Baseline | None:
    """Return the baseline of a variant; None where nobody has written one.

    InputFault with the places of all that is wrong in the file.
    """
    path = path_of(scenario, variant)
    if not path.exists():
        return None
    file = read_file(path, BASELINE_FILE)
    try:
        given = BaselineFile.model_validate(tomllib.loads(file.source.text))
        return _baseline(given, file)
    except (ValueError, RecursionError) as error:  # tomllib's and pydantic's among them
        raise _faults(file, error) from error


def of_no_run(scenario: Path, variants: Collection[str]) -> tuple[Path, ...]:
    """Return the baselines of runs of a scenario that it no longer has: of none of its `variants`.

    A file belongs to the scenario and the variant by whose names it would be
    found. Its `variant` says where the one ends and the other begins, as
    scenarios may have dots in their names; what does not say it is no baseline.
    """
    begin = f"{scenario.stem}.".encode()[:LONGEST].decode(errors="ignore")
    kept = {path_of(scenario, variant) for variant in variants}
    files = sorted(set((scenario.parent / BASELINES).glob("*.toml")) - kept)  # of which few are to be read
    named = [(_variant_in(file), file) for file in files if file.name.startswith(begin)]
    return tuple(
        file for variant, file in named if variant is not None and path_of(scenario, variant) == file
    )


def _variant_in(file: Path) -> str | None:
    try:
        variant = tomllib.loads(file.read_text("utf-8")).get("variant")
    except (OSError, ValueError, RecursionError):
        return None
    return variant if isinstance(variant, str) else None


def _faults(file: SourceFile, error: Exception) -> InputFault:
    """Return what is wrong with a file, each with its place: looked up only now, for it takes time."""
    tree = parse(file.source)
    found = shape_faults(BaselineFile, tree, "the baseline")
    if not found and isinstance(error, UnitError):
        found = list(_misfits(tree))
    if not found and not isinstance(error, ValidationError):
        raise error
    return InputFault(found)


def _misfits(tree: Entry) -> Iterator[Any]:
    """Yield tolerances that are not in a unit of what they are of."""
    for row in (*_rows(tree, "metrics"), *_rows(tree, "signal")):
        value = row.get("value")
        unit = row.get("unit")
        own = parse_unit(str(unit.value)) if unit else parse_unit("")
        if value is not None:
            own = parse_quantity(value.value).unit if value.value not in WORDS else own
        for key in ("absolute", "thinned"):
            given = row.get(key)
            if given is not None and not _fits(given.value, own):
                yield finding("SCN404", f"`{key}` is in {own}", given, f'write it as in "1 {own}"')


def _rows(tree: Entry, key: str) -> tuple[Entry, ...]:
    found = tree.get(key)
    return found.items if found else ()


def _fits(given: Any, unit: Any) -> bool:
    quantity = parse_quantity(given)
    return quantity.value == 0 or quantity.unit.commensurate(unit)


def _baseline(given: BaselineFile, file: SourceFile) -> Baseline:
    return Baseline(
        scenario=given.scenario,
        variant=given.variant,
        date=given.date.isoformat(),
        reason=given.reason,
        setting=tuple(given.setting),
        metrics=tuple(map(_metric, given.metrics)),
        signals=tuple(map(_signal, given.signal)),
        left_out=given.left_out,
        rule_bases=tuple(
            RuleBaseReference(block=each.block, arithmetic=each.arithmetic, text=each.fcl)
            for each in given.rule_base
        ),
        file=file.name,
    )


def _metric(row: Any) -> MetricReference:
    if row.value in WORDS:
        quantity, figure = Quantity(0.0), Figure(None, row.value)
        unit = parse_unit("")
    else:
        quantity = parse_quantity(row.value)
        figure, unit = Figure(quantity.value), quantity.unit
    if figure.value is None:
        unit = parse_quantity(row.absolute).unit
    return MetricReference(
        id=row.id,
        about=row.about,
        figure=figure,
        unit=unit.symbol,
        absolute=_in(row.absolute, unit),
        relative=float(row.relative),
    )


def _signal(row: Any) -> SignalReference:
    unit = parse_unit(row.unit)
    times, values = np.array(row.samples, dtype=np.float64).T
    return SignalReference(
        name=row.name,
        unit=unit.symbol,
        ticks=np.rint(times * 1e9).astype(np.int64),
        values=np.ascontiguousarray(values),
        thinned=_in(row.thinned, unit),
        absolute=_in(row.absolute, unit),
        relative=float(row.relative),
        leading=nanoseconds(parse_quantity(row.leading)),
        lagging=nanoseconds(parse_quantity(row.lagging)),
    )


def _in(given: Any, unit: Any) -> float:
    quantity = parse_quantity(given)
    return 0.0 if quantity.value == 0 else abs(quantity.to(unit))


def write(baseline: Baseline, path: Path) -> None:
    """Write a baseline in one step, so that nobody sees half of it; OSError where the system refuses."""
    path.parent.mkdir(parents=True, exist_ok=True)
    work = path.with_name(f".{os.getpid()}")
    try:
        work.write_text(text_of(baseline), encoding="utf-8", newline="\n")
        work.replace(path)
    finally:
        work.unlink(missing_ok=True)


def text_of(baseline: Baseline) -> str:
    """Return a baseline as the text of its file: the same for the same baseline, to the last byte."""
    lines = [
        "schema   = 1",
        f"scenario = {_text(baseline.scenario)}",
        f"variant  = {_text(baseline.variant)}",
        f"date     = {baseline.date}",
        f"reason   = {_text(baseline.reason)}",
    ]
    if baseline.left_out:
        lines.append(f"left_out = {_text(baseline.left_out)}")
    lines += _list("setting", [_text(each) for each in baseline.setting])
    lines += _list("metrics", [_metric_row(each) for each in baseline.metrics])
    for rule_base in baseline.rule_bases:
        lines += _rule_base(rule_base)
    for signal in baseline.signals:
        lines += _signal_table(signal)
    return HEAD + "\n".join(lines) + "\n"


def _list(name: str, rows: Sequence[str]) -> list[str]:
    return ["", f"{name} = [", *(f"  {row}," for row in rows), "]"] if rows else []


def _metric_row(metric: MetricReference) -> str:
    figure = metric.figure
    value = f"{figure.value:.{DIGITS}g}" if figure.value is not None else ""
    pairs = {
        "id": _text(metric.id),
        "about": _text(metric.about),
        "value": _text(figure.word) if figure.value is None else _quantity(float(value) + 0.0, metric.unit),
        "absolute": _quantity(metric.absolute, metric.unit),
        "relative": short(metric.relative),
    }
    return f"{{ {', '.join(f'{key} = {each}' for key, each in pairs.items())} }}"


def _rule_base(rule_base: RuleBaseReference) -> list[str]:
    quote = "'''" if _plain(rule_base.text) else ""
    return [
        "",
        "[[rule_base]]",
        f"block      = {_text(rule_base.block)}",
        f"arithmetic = {_text(rule_base.arithmetic)}",
        f"fcl        = {quote}" + (f"\n{rule_base.text}{quote}" if quote else _text(rule_base.text)),
    ]


def _plain(text: str) -> bool:
    """Return whether a text can stand in a literal as it is: no quotes and no control characters."""
    controls = any(each < " " or each == "\x7f" for each in text if each not in "\t\n")
    return not controls and "'''" not in text


def _signal_table(signal: SignalReference) -> list[str]:
    settings: Mapping[str, str] = {
        "name": _text(signal.name),
        "unit": _text(signal.unit),
        "thinned": _quantity(signal.thinned, signal.unit),
        "absolute": _quantity(signal.absolute, signal.unit),
        "relative": short(signal.relative),
        "leading": _text(f"{short(signal.leading / 1e9)} s"),
        "lagging": _text(f"{short(signal.lagging / 1e9)} s"),
    }
    rows = zip(signal.ticks.tolist(), signal.values.tolist(), strict=True)
    return [
        "",
        "[[signal]]",
        *(f"{key:<8} = {each}" for key, each in settings.items()),
        "samples  = [",
        *(f"  [{short(tick / 1e9)}, {short(value + 0.0)}]," for tick, value in rows),
        "]",
    ]


def _quantity(value: float, unit: str) -> str:
    return _text(f"{short(value)} {unit}") if unit else short(value)


def _text(text: str) -> str:
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007F")
