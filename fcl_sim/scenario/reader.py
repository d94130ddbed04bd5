"""Scenario file → Scenario: read, lay overrides and variants over it, hold everything against its shape."""

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from types import MappingProxyType
from typing import Any

from fcl_sim.diagnostics import InputFault
from fcl_sim.scenario.bench import bench_of, name_of
from fcl_sim.scenario.document import SCENARIO, parse
from fcl_sim.scenario.envelope import envelope_faults
from fcl_sim.scenario.kinds import File, check_kind
from fcl_sim.scenario.model import BASE, Axis, Scenario, Setup
from fcl_sim.scenario.overrides import overrides_tree
from fcl_sim.scenario.points import check_values
from fcl_sim.scenario.reading import Reading
from fcl_sim.scenario.requirements import requirement_texts
from fcl_sim.scenario.setup import setup_of
from fcl_sim.scenario.variants import variant_trees
from fcl_sim.scenario.vary import VARY, axes_of, varied
from fcl_sim.toml.tree import Entry, overlaid


def read(path: Path | str, overrides: Mapping[str, Any] | None = None) -> Scenario:
    """Return the scenario of a file, every variant spelled out.

    `overrides`, by dotted key, are laid over the file, and the variants over
    that. InputFault carries every fault of the scenario, its controllers and
    its requirements; what needs the plant or the rule base is looked up by `bind`.
    """
    check_kind(Path(path), File.SCENARIO, "RUN105")
    reading = Reading(Path(path))
    file = reading.open(reading.path, SCENARIO)
    if file is None:
        raise InputFault(reading.faults)
    tree = parse(file.source)
    if overrides:
        tree = _overridden(tree, overrides_tree(overrides))
    trees, faults = variant_trees(tree)
    first = axes_of(trees[BASE].get(VARY), faults)
    grids = {name: axes_of(each.get(VARY), faults, first) for name, each in trees.items()}
    reading.note(faults)
    require = tree.get("require")
    requirements, faults = requirement_texts(require.items if require else (), tuple(trees), reading)
    reading.note(faults)
    reading.note(envelope_faults(requirements, grids, lenient=bool(overrides) or _switched_off(tree)))
    setups = {name: _setup(reading, name, each, grids[name]) for name, each in trees.items()}
    if reading.faults:
        raise InputFault(reading.faults_in_order())
    variants = _told_apart({name: setup for name, setup in setups.items() if setup is not None})
    return Scenario(
        path=reading.path,
        name=name_of(reading.path),
        title=variants[BASE].title,
        description=variants[BASE].description,
        bench=bench_of(reading.path),
        variants=MappingProxyType(variants),
        requirements=requirements,
        files=tuple(reading.files.values()),
        overrides=MappingProxyType(dict(overrides or {})),
    )


def _overridden(tree: Entry, over: Entry) -> Entry:
    vary = varied(tree.get(VARY), over)
    whole = overlaid(tree.without(VARY), over.without(VARY))
    return whole if vary is None else whole.keeping({**whole.table, VARY: vary})


def _switched_off(tree: Entry) -> bool:
    vary = tree.get(VARY)
    return vary is not None and vary.value is False


def _setup(reading: Reading, name: str, tree: Entry, grid: tuple[Axis, ...]) -> Setup | None:
    setup = setup_of(reading, name, tree.without(VARY))
    if setup is None:
        return None
    varied_setup = replace(setup, vary=grid)
    check_values(reading, varied_setup)
    return varied_setup


def _told_apart(setups: dict[str, Setup]) -> dict[str, Setup]:
    """Return setups where a variant without its own title has its name in it; the base tells the story."""
    base = setups[BASE]
    told = {BASE: base}
    for name, setup in setups.items():
        if name != BASE:
            title = f"{base.title}: {name.replace('_', ' ')}" if setup.title == base.title else setup.title
            description = "" if setup.description == base.description else setup.description
            told[name] = replace(setup, title=title, description=description)
    return told
