"""What the engine evaluates as base points although the text says it otherwise."""

from dataclasses import replace

from fcl_sim.engine.smooth import polyline
from fcl_sim.engine.switches import spikes
from fcl_sim.model import (
    Curve,
    Defuzzification,
    FunctionBlock,
    Fuzzification,
    Points,
    Singletons,
    Term,
)


def straightened(block: FunctionBlock) -> FunctionBlock:
    """Return `block` with single values of inputs as edges, and curves of outputs as polylines (S33).

    Every output with curves has a RANGE: `refuse` sees to that.
    """
    return replace(
        block,
        fuzzifications=tuple(_input(each) for each in block.fuzzifications),
        defuzzifications=tuple(_output(each) for each in block.defuzzifications),
    )


def _input(fuzzification: Fuzzification) -> Fuzzification:
    terms = tuple(
        replace(term, shape=spikes(term.shape)) if isinstance(term.shape, Singletons) else term
        for term in fuzzification.terms
    )
    return replace(fuzzification, terms=terms)


def _output(output: Defuzzification) -> Defuzzification:
    def straight(term: Term) -> Term:
        if isinstance(term.shape, Curve) and output.range is not None:
            return replace(term, shape=Points(polyline(term.shape, *output.range)))
        return term

    return replace(output, terms=tuple(straight(term) for term in output.terms))
