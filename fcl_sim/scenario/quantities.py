"""A value as written → a number in the unit that is wanted, or the fault and its mend."""

from fcl_sim.diagnostics import Diagnostic
from fcl_sim.toml.tree import Entry, finding
from fcl_sim.units import Unit, UnitError, conversion_hint, parse_quantity


def converted(entry: Entry | None, unit: Unit, what: str, faults: list[Diagnostic]) -> float | None:
    """Return the number that an entry gives in `unit`; None where there is none, or a fault.

    `what` begins the sentence of a fault. A bare number is refused unless the
    unit is dimensionless.
    """
    if entry is None:
        return None
    if isinstance(entry.value, bool) or not isinstance(entry.value, str | int | float):
        faults.append(finding("SCN404", f"{what} is a quantity", entry, f'write it as in "1 {unit}"'))
        return None
    try:
        quantity = parse_quantity(entry.value)
        if quantity.unit.commensurate(unit):
            return quantity.to(unit)
    except UnitError as error:
        faults.append(finding("SCN404", f"{what}: {error}", entry, error.hint))
        return None
    faults.append(_misfit(entry, quantity.unit, unit, what))
    return None


def _misfit(entry: Entry, given: Unit, unit: Unit, what: str) -> Diagnostic:
    if not given.symbol:
        message, hint = f"{what} is in {unit}, and this has no unit", f'write "{entry.value} {unit}"'
    elif unit.symbol:
        message = f"{what} is in {unit}, and this is in {given}"
        hint = conversion_hint(given, unit)
    else:
        message, hint = f"{what} is a plain number, and this is in {given}", "write the number alone"
    return finding("SCN404", message, entry, hint)
