"""The tree of one run, and the controller file that it names, → Setup."""

from collections.abc import Iterator
from pathlib import Path
from types import MappingProxyType

from fcl_sim.diagnostics import Diagnostic, InputFault, Place, nearest
from fcl_sim.diagnostics.spelling import listed
from fcl_sim.loop.blocks import BLOCKS
from fcl_sim.scenario.document import BLOCK_FILE, CONTROLLER_FILE, RULE_BASE
from fcl_sim.scenario.model import CONTROLLER, ControllerSetup, PlantSetup, Setup, SourceFile
from fcl_sim.scenario.reading import Reading
from fcl_sim.scenario.schema import ControllerFile, ScenarioFile
from fcl_sim.scenario.shape import block_faults, flat, is_fuzzy, shape_faults
from fcl_sim.scenario.timing import integration_of, timing_of
from fcl_sim.scenario.variants import without_unknown_blocks
from fcl_sim.toml.tree import NOTHING, Entry, finding, overlaid

Faults = list[Diagnostic]

LAID_OVER = ("scan", "timing", "blocks", "outputs")
"""What [controller] lays over the controller file; `file` and `inputs` it says for itself."""


def setup_of(reading: Reading, variant: str, tree: Entry) -> Setup | None:
    """Return what a variant says, or None where a fault was found in it."""
    faults = shape_faults(ScenarioFile, tree, "the scenario")
    named = tree.get(CONTROLLER)
    controller = _controller_tree(reading, named, faults) if named and named.is_table else None
    blocks = _blocks(tree, "", faults)
    if controller is not None:
        blocks |= _blocks(controller, f"{CONTROLLER}.", faults)
    rule_bases = _rule_bases(reading, blocks)
    block_files = _block_files(reading, blocks)
    timing = None
    if not faults and (named is None or controller is not None):
        timing, more = timing_of(tree, controller)
        faults += more
        faults += (*_loose_inputs(named, controller), *_clashes(controller)) if named and controller else ()
    if reading.note(faults) or timing is None:
        return None
    return Setup(
        variant=variant,
        title=_text(tree, "title"),
        description=_text(tree, "description"),
        timing=timing,
        integration=integration_of(tree),
        plant=_plant(tree.table["plant"]),
        controller=_controller(reading, named, controller) if named and controller else None,
        blocks=MappingProxyType(blocks),
        rule_bases=MappingProxyType(rule_bases),
        block_files=MappingProxyType(block_files),
        references=_references(tree),
        tree=tree,
    )


def _controller_tree(reading: Reading, named: Entry, faults: Faults) -> Entry | None:
    """Return the controller file with what the scenario lays over it; None where it cannot be read."""
    name = named.get("file")
    if name is None or not isinstance(name.value, str) or not name.value:
        return None
    file = reading.open(reading.beside(name), CONTROLLER_FILE, name)
    if file is None:
        return None
    try:
        tree = reading.parsed(file)
    except InputFault as fault:
        faults += fault.diagnostics
        return None
    laid = named.keeping({key: named.table[key] for key in LAID_OVER if key in named.table})
    over, unknown = without_unknown_blocks(tree.get("blocks"), laid, "the controller")
    whole = overlaid(tree, over)
    faults += unknown
    faults += shape_faults(ControllerFile, whole, "the controller")
    return whole


def _blocks(tree: Entry, prefix: str, faults: Faults) -> dict[str, Entry]:
    blocks = tree.get("blocks")
    found = {}
    for name, block in (blocks.table if blocks else NOTHING).items():
        if block.is_table:
            found[f"{prefix}{name}"] = flat(block)
            faults += block_faults(flat(block), name)
    return found


def _rule_bases(reading: Reading, blocks: dict[str, Entry]) -> dict[str, Path]:
    found = {}
    for name, block in blocks.items():
        file = block.get("file")
        if is_fuzzy(block) and file is not None and isinstance(file.value, str) and file.value:
            found[name] = reading.beside(file)
            reading.open(found[name], RULE_BASE, file)
    return found


def _block_files(reading: Reading, blocks: dict[str, Entry]) -> dict[tuple[str, str], SourceFile]:
    found = {}
    for name, block in blocks.items():
        type_ = block.get("type")
        kind = BLOCKS.get(type_.value) if type_ and isinstance(type_.value, str) else None
        for parameter in kind.parameters if kind else ():
            file = block.get(parameter.name)
            if parameter.kind == "file" and file and isinstance(file.value, str) and file.value.strip():
                opened = reading.open(reading.beside(file), BLOCK_FILE, file)
                if opened is not None:
                    found[name, parameter.name] = opened
    return found


def _loose_inputs(named: Entry, controller: Entry) -> Iterator[Diagnostic]:
    declared, wires = controller.get("inputs"), named.get("inputs")
    known = declared.table if declared else NOTHING
    given = wires.table if wires else NOTHING
    for name, wire in given.items():
        if name not in known:
            near = nearest(name, known)
            hint = f"did you mean `{near}`?" if near else f"it has {listed(known) or 'none'}"
            yield finding("SCN304", f"the controller has no input `{name}`", wire.key, hint)
    for name, unit in known.items():
        if name not in given:
            hint = f'say what it reads, a signal in {unit.value or "1"}: inputs = {{ {name} = "..." }}'
            yield finding("SCN305", f"the controller's input `{name}` is not connected", named.key, hint)


def _clashes(controller: Entry) -> Iterator[Diagnostic]:
    """Yield what shares its name: inputs, blocks and outputs have their paths side by side."""
    seen: dict[str, Entry] = {}
    for group in ("inputs", "blocks", "outputs"):
        for name, entry in controller.table[group].table.items():
            if name in seen:
                places = (Place(span=entry.key), Place(span=seen[name].key, label="the other one"))
                message = f"two things of the controller are called `{name}`"
                hint = "inputs, blocks and outputs need names of their own"
                yield Diagnostic(code="SCN307", message=message, places=places, hint=hint)
            seen.setdefault(name, entry)


def _controller(reading: Reading, named: Entry, tree: Entry) -> ControllerSetup:
    wires, inputs, outputs = named.get("inputs"), tree.get("inputs"), tree.get("outputs")
    return ControllerSetup(
        file=reading.beside(named.table["file"]),
        title=_text(tree, "title"),
        inputs=inputs.table if inputs else NOTHING,
        wires=wires.table if wires else NOTHING,
        outputs=outputs.table if outputs else NOTHING,
        span=named.key,
    )


def _plant(plant: Entry) -> PlantSetup:
    model, name = plant.table["model"], plant.get("name")
    parameters, start, inputs = (plant.get(each) for each in ("parameters", "start", "inputs"))
    outputs, units = plant.get("outputs"), plant.get("units")
    return PlantSetup(
        model=model,
        name=str(name.value if name else model.value),
        parameters=parameters.table if parameters else NOTHING,
        start=start.table if start else NOTHING,
        inputs=inputs.table if inputs else NOTHING,
        span=plant.key,
        outputs=outputs.items if outputs else (),
        units=units.table if units else NOTHING,
    )


def _references(tree: Entry) -> tuple[Entry, ...] | None:
    signals = tree.get("baseline", "signals")
    return None if signals is None else signals.items


def _text(tree: Entry, key: str) -> str:
    entry = tree.get(key)
    return str(entry.value).strip() if entry else ""
