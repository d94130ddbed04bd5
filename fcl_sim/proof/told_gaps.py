"""Completeness → findings: where an output is undefined, hardly defined, or was not looked at."""

from collections.abc import Iterator
from math import isnan

from fcl_sim.diagnostics import Severity
from fcl_sim.model import Defuzzification, FunctionBlock
from fcl_sim.proof.completeness import Certainty, Completeness, Gap
from fcl_sim.proof.finding import Finding, found
from fcl_sim.proof.nearest import Missing
from fcl_sim.proof.universe import Universe
from fcl_sim.proof.words import box, command, percent, quoted
from fcl_sim.units import short

SHOWN = 3
"""Boxes that a message names."""


def told_gaps(
    block: FunctionBlock, proved: Completeness, universe: Universe, epsilon: float
) -> Iterator[Finding]:
    """Yield the findings on one output."""
    output = next(each for each in block.defuzzifications if each.variable == proved.output)
    name = proved.output
    if proved.gap is not None:
        message = f"`{name}` is undefined ({_instead(output)}){_where(proved, proved.gap, universe)}"
        yield _gap("FCL601", message, output, proved, proved.gap)
    if proved.weak is not None:
        few = f"every rule there has a term below {percent_of(epsilon)} of the strongest one"
        message = f"`{name}` is hardly defined ({few}){_where(proved, proved.weak, universe)}"
        yield _gap("FCL602", message, output, proved, proved.weak)
    if not proved.whole or (proved.certainty is Certainty.BOUNDED and proved.doubt != 0):
        yield _open(output, proved)


def percent_of(epsilon: float) -> str:
    """Return a threshold in percent."""
    return f"{short(float(f'{100 * epsilon:.4g}'))} %"


def _gap(code: str, message: str, output: Defuzzification, proved: Completeness, gap: Gap) -> Finding:
    return found(
        code,
        message,
        [output.span],
        f"{_missing(gap.missing)}; see `{command(output.span, gap.witness, thin=gap.boxes[0].is_thin)}`",
        certainty=proved.certainty,
        variable=proved.output,
        witness=gap.witness,
        share=gap.share,
        boxes=gap.boxes,
        more=gap.more,
    )


def _where(proved: Completeness, gap: Gap, universe: Universe) -> str:
    """Return how much of the universe a gap takes, and where it is."""
    told = [box(each.sides, universe) for each in gap.boxes[:SHOWN]]
    rest = len(gap.boxes) - len(told)
    if rest > 0:
        more = "at least " if gap.more else ""
        told.append(f"and {more}{rest} more box{'' if rest == 1 else 'es'}")
    where = "; ".join(told)
    if gap.share is None:
        return f" for {where}"
    if not gap.share:
        return f" on edges without area: {where}"
    least = "" if proved.certainty is Certainty.EXACT else "at least "
    return f" in {least}{percent(gap.share)} of the universe: {where}"


def _instead(output: Defuzzification) -> str:
    """Return what is given out where no rule is active (S30)."""
    if output.held:
        return "it keeps its value"
    if output.default is None:
        return "NC: it keeps its value"
    return f"DEFAULT {'nan' if isnan(output.default) else short(output.default)} is given out"


def _missing(missing: Missing) -> str:
    if missing.without:
        return f"no term of {quoted(missing.without)} holds at this point"
    near = [f"rule {each.label} lacks `{' AND '.join(each.lacking)}`" for each in missing.rules]
    nearest = f"nearest to firing: {', '.join(near)}" if near else ""
    if not missing.terms:
        return nearest or "no rule concludes on it"
    terms = " AND ".join(f"{variable} IS {term}" for variable, term in missing.terms)
    return f"a rule for `{terms}` would help" + (f"; {nearest}" if nearest else "")


def _open(output: Defuzzification, proved: Completeness) -> Finding:
    if not proved.whole:
        part = percent(proved.proved) if proved.proved < 1 else "all"
        rest = "the rest is" if proved.proved < 1 else "edges of it are"
        message = f"`{output.variable}` is proved on {part} of the universe: {rest} beyond the budget"
        hint = "raise --budget, or narrow the universe"
    else:
        doubt = f" in {percent(proved.doubt)} of the universe" if proved.doubt else " somewhere"
        message = f"whether `{output.variable}` is defined is not known{doubt}"
        hint = "points or weights that variables move, BDIF, NMIN and DPROD leave room for both"
    return found(
        "FCL615",
        message,
        [output.span],
        hint,
        Severity.NOTE,
        certainty=Certainty.BOUNDED,
        variable=output.variable,
    )
