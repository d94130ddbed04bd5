"""Completeness → findings: where an output is undefined, hardly defined, or was not looked at."""

from collections.abc import Iterator, Mapping, Sequence
from math import isnan

from fcl_sim.diagnostics import Severity, Span
from fcl_sim.model import Defuzzification, FunctionBlock
from fcl_sim.proof.completeness import Certainty, Completeness, Gap
from fcl_sim.proof.finding import Finding, found
from fcl_sim.proof.nearest import Missing
from fcl_sim.proof.space import Side
from fcl_sim.proof.universe import Universe
from fcl_sim.proof.words import assignments, box, command, over, percent, quoted, rules_named
from fcl_sim.units import short

LOSING_HINT = "BDIF is 0 unless degrees add up to more than 1: take AND: MIN, or let the terms overlap more"
SHOWN = 3
"""Boxes that a message names."""


def told_gaps(
    block: FunctionBlock,
    proved: Completeness,
    universe: Universe,
    epsilon: float,
    bare: Mapping[str, Sequence[Side]],
) -> Iterator[Finding]:
    """Yield the findings on one output; `bare` are the stretches of inputs without a term, by name."""
    output = _output(block, proved)
    name = proved.output
    if proved.gap is not None:
        message = f"`{name}` is undefined ({instead(output)}){_where(proved, proved.gap, universe)}"
        if proved.parts is not None:
            message = f"{message}; and in parts of {_boxes(proved.parts, universe)}"
        causes = list(_causes(block, proved.gap, universe, bare))
        yield _gap(block, proved, proved.gap, message, causes)
    elif proved.parts is not None:
        message = f"`{name}` is undefined ({instead(output)}) in parts of {_boxes(proved.parts, universe)}"
        yield _gap(block, proved, proved.parts, message)
    if proved.weak is not None:
        few = (
            f"by tails alone: every rule asks for a term below {percent_of(epsilon)} of its input's strongest"
        )
        message = f"`{name}` is hardly defined ({few}){_where(proved, proved.weak, universe)}"
        yield _gap(block, proved, proved.weak, message)
    open_ = proved.certainty is Certainty.BOUNDED and proved.doubt != 0 and proved.parts is None
    if not proved.whole or open_:
        yield _open(output, proved)


def _output(block: FunctionBlock, proved: Completeness) -> Defuzzification:
    return next(each for each in block.defuzzifications if each.variable == proved.output)


def percent_of(epsilon: float) -> str:
    """Return a threshold in percent."""
    return f"{short(float(f'{100 * epsilon:.4g}'))} %"


def _causes(
    block: FunctionBlock, gap: Gap, universe: Universe, bare: Mapping[str, Sequence[Side]]
) -> Iterator[tuple[Span | None, str]]:
    """Yield the inputs without a term over a stretch that the gap has all of, with what to say there."""
    for name, sides in bare.items():
        own = [over(each, universe.unit(name)) for each in sides if gap.has_all_of(name, each)]
        if own:
            (span,) = [
                each.span for each in block.fuzzifications if each.variable.casefold() == name.casefold()
            ]
            yield span, f"no term is above 0 {' and '.join(own)}"


def _coupled(block: FunctionBlock, gap: Gap) -> str:
    """Return what is to be said where several degrees from outside would have to be 0 together."""
    terms = {each.variable.casefold() for each in block.fuzzifications}
    sides = gap.boxes[0].sides
    degrees = [name for name, side in sides.items() if side.is_point and name.casefold() not in terms]
    if len(degrees) < 2 or len(degrees) < len(sides):
        return ""
    return f"; or say that it cannot be, by --assume '{' + '.join(degrees)} = 1'"


def _gap(
    block: FunctionBlock,
    proved: Completeness,
    gap: Gap,
    message: str,
    causes: Sequence[tuple[Span | None, str]] = (),
) -> Finding:
    span = _output(block, proved).span
    is_part = gap is proved.parts
    shown = command(span, gap.witness, thin=is_part or gap.boxes[0].is_thin)
    helpful = LOSING_HINT if is_part else f"{_missing(gap.missing)}{_coupled(block, gap)}"
    return found(
        "FCL602" if gap is proved.weak else "FCL601",
        message,
        [span],
        f"{helpful}; see `{shown}`",
        others=causes,
        certainty=proved.certainty,
        variable=proved.output,
        witness=gap.witness,
        share=None if is_part else gap.share,
        boxes=gap.boxes,
        more=gap.more,
    )


def _boxes(gap: Gap, universe: Universe) -> str:
    """Return the first boxes of a gap, and how many more there are."""
    told = [box(each.sides, universe) for each in gap.boxes[:SHOWN]]
    rest = len(gap.boxes) - len(told)
    if rest > 0:
        more = "at least " if gap.more else ""
        told.append(f"and {more}{rest} more box{'' if rest == 1 else 'es'}")
    return "; ".join(told)


def _where(proved: Completeness, gap: Gap, universe: Universe) -> str:
    """Return how much of the universe a gap takes, and where it is."""
    where = _boxes(gap, universe)
    if not gap.boxes[0].sides:
        return " everywhere"
    if gap.share is None:
        return f" for {where}"
    least = "" if proved.certainty is Certainty.EXACT else "at least "
    if not gap.share:
        return f" {least}on edges without area: {where}"
    return f" in {least}{percent(gap.share)} of the universe: {where}"


def instead(output: Defuzzification) -> str:
    """Return what is given out where no rule is active (S30)."""
    if output.held:
        return "it keeps its value"
    if output.default is None:
        return "NC: it keeps its value"
    return f"DEFAULT {'nan' if isnan(output.default) else short(output.default)} is given out"


def _missing(missing: Missing) -> str:
    if missing.off:
        return f"its rules stand in {quoted(missing.off)}, which is switched off"
    if missing.without:
        return f"no term of {quoted(missing.without)} is above 0 there: let one reach it"
    if missing.silent:
        fires = "fires" if len(missing.silent) == 1 else "fire"
        return f"{rules_named(missing.silent)} {fires} there, to no effect"
    near = [f"rule {each.label} lacks `{' AND '.join(each.lacking)}`" for each in missing.rules]
    nearest = f"nearest to firing: {', '.join(near)}" if near else ""
    if not missing.asks:
        return nearest or "no rule concludes on it"
    return f"a rule for `{' AND '.join(missing.asks)}` would help" + (f"; {nearest}" if nearest else "")


def _open(output: Defuzzification, proved: Completeness) -> Finding:
    if not proved.whole:
        part = percent(proved.proved) if proved.proved < 1 else "all"
        rest = "the rest is" if proved.proved < 1 else "edges of it are"
        message = f"`{output.variable}` is proved on {part} of the universe: {rest} beyond the budget"
        hint = "raise --budget, or narrow the universe"
    else:
        doubt = f" in {percent(proved.doubt)} of the universe" if proved.doubt else " somewhere"
        message = f"whether `{output.variable}` is defined is not known{doubt}"
        hint = "--universe bounds what moves points and weights; BDIF, NMIN and DPROD leave room for both"
        if proved.example is not None:
            at = assignments(proved.example)
            message = f"`{output.variable}` is undefined at {at}; where else it is so is not known"
            hint = f"{hint}; see `{command(output.span, proved.example, thin=True)}`"
    return found(
        "FCL615",
        message,
        [output.span],
        hint,
        Severity.NOTE,
        certainty=Certainty.BOUNDED,
        variable=output.variable,
        witness=proved.example if proved.whole else None,
    )
