"""Scan, duration and integration of a run, from the tables that give them."""

from dataclasses import replace

from fcl_sim.diagnostics import Diagnostic, InputFault, Place
from fcl_sim.loop import clock
from fcl_sim.loop.diagram import SKIP, Integration, Overruns, Restart, Timing
from fcl_sim.toml.tree import Entry, finding, overlaid
from fcl_sim.units import ONE, nanoseconds, parse_quantity


def timing_of(tree: Entry, controller: Entry | None) -> tuple[Timing | None, list[Diagnostic]]:
    """Return the timing of a run whose tables have their right shape, or what contradicts in it."""
    scan, faults = _scan(tree, controller)
    duration = tree.get("duration")
    if scan is None or duration is None:
        return None, faults
    table = _table(tree, controller)
    seed, cycle = table.get("seed"), table.get("cycle_time")
    timing = Timing(
        scan=_ticks(scan),
        duration=_ticks(duration),
        latency=_ticks(table.get("latency")),
        jitter=_ticks(table.get("jitter")),
        seed=int(seed.value) if seed else 0,
        measured=cycle is not None and cycle.value == "measured",
        overruns=_overruns(table.get("overruns")),
        restarts=_restarts(tree.get("restart")),
    )
    try:
        clock.check(timing)
    except InputFault as fault:
        return None, [replace(each, places=_places(each, table, tree, scan)) for each in fault.diagnostics]
    return timing, faults


def _table(tree: Entry, controller: Entry | None) -> Entry:
    """Return [timing] of the controller, with the scenario's laid over it."""
    tables = [each.get("timing") for each in (controller, tree) if each is not None]
    merged = tree.keeping({})
    for table in tables:
        merged = overlaid(merged, table) if table is not None else merged
    return merged


def _places(fault: Diagnostic, table: Entry, tree: Entry, scan: Entry) -> tuple[Place, ...]:
    """Return where the values stand that a fault of the clock speaks of."""
    entries = [tree.get("duration")]
    if "latency" in fault.message:
        entries = [table.get("latency"), table.get("jitter")]
    elif "overrun" in fault.message:
        entries = [table.get("overruns")]
    elif "restart" in fault.message:
        return tuple(Place(span=each.span) for each in [tree.get("restart")] if each is not None)
    return tuple(Place(span=each.span) for each in (*entries, scan) if each is not None)


def _overruns(table: Entry | None) -> Overruns:
    if table is None:
        return Overruns()
    policy, chance, scans = (table.get(each) for each in ("policy", "chance", "scans"))
    pairs = [each.items for each in scans.items] if scans else []
    return Overruns(
        policy=str(policy.value) if policy else SKIP,
        listed=tuple((int(number.value), _ticks(length)) for number, length in pairs),
        chance=parse_quantity(chance.value).to(ONE) if chance else 0.0,
        longest=_ticks(table.get("longest")),
    )


def _restarts(tables: Entry | None) -> tuple[Restart, ...]:
    return tuple(
        Restart(
            at=_ticks(each.table["at"]), kind=str(each.table["kind"].value), lasts=_ticks(each.get("lasts"))
        )
        for each in (tables.items if tables else ())
    )


def _scan(tree: Entry, controller: Entry | None) -> tuple[Entry | None, list[Diagnostic]]:
    own = tree.get("scan")
    if controller is None:
        if own is not None:
            return own, []
        hint = 'give the scan time, as in scan = "50 ms", or a controller file that has one'
        return None, [finding("SCN202", "the scenario has no `scan`", tree.get("duration"), hint)]
    if own is not None:
        hint = "to run it at another scan time, write controller.scan"
        return None, [finding("SCN303", "the scan time belongs to the controller", own.key, hint)]
    return controller.get("scan"), []


def integration_of(tree: Entry) -> Integration:
    """Return how the plant is integrated."""
    table, default = tree.get("integration"), Integration()
    if table is None:
        return default
    scheme, rtol, step = table.get("scheme"), table.get("rtol"), table.get("step")
    return Integration(
        scheme=str(scheme.value) if scheme else default.scheme,
        rtol=float(rtol.value) if rtol else default.rtol,
        step=parse_quantity(step.value).to("s") if step else default.step,
    )


def _ticks(entry: Entry | None) -> int:
    return nanoseconds(parse_quantity(entry.value)) if entry else 0
