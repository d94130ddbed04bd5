"""The order in which the blocks of a loop execute, or the algebraic loop that has none."""

from collections.abc import Callable, Sequence

from fcl_sim.diagnostics import Diagnostic, InputFault, Place
from fcl_sim.loop.settings import AnyNode, signals_of


def in_order(nodes: Sequence[AnyNode], sources: Callable[[AnyNode], Sequence[str]]) -> tuple[AnyNode, ...]:
    """Return the nodes so that each comes after those it takes signals from, else as they were written.

    `sources` gives the full names of the signals that a node takes as they are
    in this scan; for those of the last scan it waits for nobody. An algebraic
    loop is an InputFault that walks it.
    """
    by_signal = {name: node for node in nodes for name in signals_of(node)}
    waits = {node.name: [by_signal[each] for each in sources(node) if each in by_signal] for node in nodes}
    done: dict[str, AnyNode] = {}
    left = list(nodes)
    while left:
        ready = [node for node in left if all(each.name in done for each in waits[node.name])]
        if not ready:
            raise _algebraic_loop(left, waits)
        done[ready[0].name] = ready[0]
        left.remove(ready[0])
    return tuple(done.values())


def _algebraic_loop(left: Sequence[AnyNode], waits: dict[str, list[AnyNode]]) -> InputFault:
    names = {node.name for node in left}
    walk = [left[0]]
    while walk.count(walk[-1]) == 1:
        walk.append(next(each for each in waits[walk[-1].name] if each.name in names))
    loop = walk[walk.index(walk[-1]) :][::-1]
    path = " → ".join(f"`{node.name}`" for node in loop)
    places = tuple(Place(span=node.span) for node in loop[:-1] if node.span)
    message = f"these blocks wait for each other in every scan: {path}"
    hint = (
        "no order of execution suits an algebraic loop: put a `unit_delay` into it, or take a connection away"
    )
    return InputFault([Diagnostic(code="WIR301", message=message, places=places, hint=hint)])
