"""What a fuzzy block of a scenario computes in, and in INT what its counts are."""

from dataclasses import replace

from fcl_sim.diagnostics import Diagnostic, InputFault
from fcl_sim.loop.diagram import FuzzyNode
from fcl_sim.scenario.quantities import converted
from fcl_sim.toml.tree import NOTHING, Entry, finding
from fcl_sim.units import parse_unit

Faults = list[Diagnostic]


def in_arithmetic(node: FuzzyNode, block: Entry, faults: Faults) -> FuzzyNode:
    """Return a node in the arithmetic that its table asks for, else in that of its data types (S36).

    What that arithmetic cannot do is added to `faults`.
    """
    asked, rounding = block.get("arithmetic"), block.get("rounding")
    arithmetic = str(asked.value) if asked else node.block.declared_arithmetic
    if arithmetic != "INT" and asked is None:
        for key in ("scale", "rounding"):
            entry = block.get(key)
            if entry is not None:
                message = f"`{key}` is of INT, and the data types of `{node.name}` are those of {arithmetic}"
                faults.append(finding("SCN201", message, entry.key, 'ask for it: arithmetic = "INT"'))
    chosen = replace(
        node,
        arithmetic=arithmetic,
        scale=_scale(node, block, faults),
        rounding=str(rounding.value) if rounding else node.rounding,
    )
    try:
        _assembled(chosen)
    except InputFault as fault:
        faults += fault.diagnostics
    return chosen


def _assembled(node: FuzzyNode) -> None:
    """Assemble the block, to have its faults; the wiring tells the variables of `scale` that it lacks."""
    program = node.program
    known = (*program.input_names, *program.output_names)
    if node.in_int:
        scale = {name: each for name, each in node.scale.items() if name in known}
        replace(node, scale=scale).integer_instance()


def _scale(node: FuzzyNode, block: Entry, faults: Faults) -> dict[str, tuple[float, float]]:
    """Return by variable factor and offset of its counts, in its unit; without those at fault."""
    scale = {}
    entry = block.get("scale")
    for name, each in (entry.table if entry else NOTHING).items():
        unit = parse_unit(node.units.get(name, ""))
        first, *rest = each.items or (each,)
        factor = converted(first, unit, f"a count of `{name}`", faults)
        offset = converted(rest[0], unit, f"the count 0 of `{name}`", faults) if rest else 0.0
        if factor is not None and factor <= 0:
            faults.append(finding("SCN203", f"a count of `{name}` must be greater than 0", first))
        elif factor is not None and offset is not None:
            scale[name] = (factor, offset)
    return scale
