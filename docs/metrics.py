"""The page of metrics, from their table."""

from fcl_sim.judge.metric import RESTART_AT, WINDOW, Argument, Better, Combined, Kind, Metric, Reads
from fcl_sim.judge.metrics import METRICS
from fcl_sim.units import parse_unit, short

DIRECTIONS = {
    Better.LOWER: "lower is better",
    Better.HIGHER: "higher is better",
    Better.NEITHER: "no direction",
}
KINDS = {
    Kind.SIGNAL: ", in the unit of the signal",
    Kind.DIFFERENCE: ", in the unit of the signal, K for degC",
    Kind.TIME: ", a time",
    Kind.TIMES: ", a list of times",
    Kind.NUMBER: "",
}
HEAD = """\
# Metrics

What `metric` of a [requirement](scenarios.md#requirements) can name. What never happens takes an infinite
time; where there is nothing to measure the verdict is UNTESTED; NaN never passes.

Every metric takes these arguments:
"""


def page() -> str:
    """Return the page in Markdown."""
    shared = "\n".join(_argument(each) for each in (*WINDOW, RESTART_AT))
    return "\n\n".join([f"{HEAD}\n{shared}", *(_metric(each) for each in METRICS.values())]) + "\n"


def _metric(metric: Metric) -> str:
    facts = [f"Unit: {_unit(metric)}", DIRECTIONS[metric.better]]
    summed = metric.combined is Combined.SUM
    facts.append("with restarts the sum counts" if summed else "with restarts the worst counts")
    if metric.reads is Reads.UNDEFINED:
        facts.append("taken of an output of a rule base")
    definition = metric.definition[0].upper() + metric.definition[1:]
    lines = [f"## {metric.name}", f"{definition}.", "; ".join(facts) + "."]
    if metric.arguments:
        lines.append("\n".join(_argument(each) for each in metric.arguments))
    return "\n\n".join(lines)


def _unit(metric: Metric) -> str:
    unit = metric.unit.unit(parse_unit("m")).symbol
    if not metric.unit.signal:
        return f"`{unit}`" if unit else "none"
    return f"`{unit}` for a signal in `m`"


def _argument(argument: Argument) -> str:
    default = "" if argument.default is None else f"; {short(argument.default)} unless given"
    return f"- `{argument.name}`{KINDS[argument.kind]}: {argument.meaning}{default}"
