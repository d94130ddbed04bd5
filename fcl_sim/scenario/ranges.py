"""From where to where the inputs of a fuzzy block go, as its table declares: `ranges`, beside `units`."""

from collections.abc import Mapping

from fcl_sim.diagnostics import Diagnostic, nearest
from fcl_sim.diagnostics.spelling import listed
from fcl_sim.loop.diagram import FuzzyNode
from fcl_sim.scenario.quantities import converted
from fcl_sim.toml.tree import NOTHING, Entry, finding
from fcl_sim.units import parse_unit

Faults = list[Diagnostic]
Ends = tuple[float, float]


def ranges_of(node: FuzzyNode, block: Entry, faults: Faults) -> Mapping[str, Ends]:
    """Return the ends of each input that has a range, in its unit, by declared name; not those at fault."""
    found: dict[str, Ends] = {}
    declared = {each.casefold(): each for each in node.block.inputs}
    units = {name.casefold(): unit for name, unit in node.units.items()}
    entry = block.get("ranges")
    for name, each in (entry.table if entry else NOTHING).items():
        if name.casefold() not in declared:
            near = nearest(name, declared.values())
            hint = f"did you mean `{near}`?" if near else f"there is {listed(tuple(declared.values()))}"
            faults.append(finding("SCN201", f"`{node.name}` has no input `{name}`", each.key, hint))
            continue
        unit, what = parse_unit(units.get(name.casefold(), "")), f"an end of the range of `{name}`"
        ends = [converted(own, unit, what, faults) for own in each.items]
        if ends[0] is None or ends[1] is None:
            continue
        if ends[0] >= ends[1]:
            message = f"the range of `{name}` does not go from below to above"
            faults.append(finding("SCN203", message, each, "exchange its ends"))
        else:
            found[declared[name.casefold()]] = (ends[0], ends[1])
    return found
