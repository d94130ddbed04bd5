"""An evaluation in fractions, in words and as JSON's types."""

from collections.abc import Iterator
from typing import Any

from fcl_sim.engine.explain import Origin
from fcl_sim.proof.exact import Exactly, ExactOutput
from fcl_sim.proof.words import in_full

Json = dict[str, Any]

REMARKS = {
    Origin.RULES: "",
    Origin.DEFAULT: "  (no rule is active: DEFAULT)",
    Origin.PREVIOUS: "  (no rule is active: NC keeps the initial value)",
}


def exact_lines(found: Exactly, *, explain: bool) -> Iterator[str]:
    """Yield a line for each output; with `explain` before that the degrees above 0 of terms and rules."""
    if explain:
        yield from _degrees(found)
    for each in found.outputs:
        yield f"{each.variable} = {_number(each)}{REMARKS[each.origin]}"
    if found.rounded:
        yield f"rounded, since they are no fractions: {', '.join(found.rounded)}"


def _degrees(found: Exactly) -> Iterator[str]:
    for name, value in found.inputs.items():
        own = [
            f"{term} {in_full(degree)}"
            for variable, term, degree in found.terms
            if variable.casefold() == name.casefold() and degree > 0
        ]
        terms = f": {', '.join(own)}" if own else ""
        yield f"{name} = {in_full(value)}{terms}"
    fired = [(label, degree) for label, degree in found.rules if degree > 0]
    width = max((len(label) for label, _ in fired), default=0)
    yield from (f"rule {label:{width}}  {in_full(degree)}" for label, degree in fired)
    if not fired:
        yield "no rule fires"


def _number(output: ExactOutput) -> str:
    return "nan" if output.value is None else in_full(output.value)


def exact_json(found: Exactly, name: str) -> Json:
    """Return an evaluation as JSON's types: numbers, and beside them the fractions as texts."""
    values = {each.variable: each.value for each in found.outputs}
    return {
        "schema": 1,
        "block": name,
        "arithmetic": "fractions",
        "inputs": {each: float(value) for each, value in found.inputs.items()},
        "outputs": {each: None if value is None else float(value) for each, value in values.items()},
        "active": {each.variable: each.origin is Origin.RULES for each in found.outputs},
        "degrees": {label: float(degree) for label, degree in found.rules},
        "exact": {
            "inputs": {each: str(value) for each, value in found.inputs.items()},
            "outputs": {each: None if value is None else str(value) for each, value in values.items()},
            "degrees": {label: str(degree) for label, degree in found.rules},
            "rounded": list(found.rounded),
        },
    }
