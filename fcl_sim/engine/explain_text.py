"""An explanation as text, in the order and the words of A.2.1 to A.2.4."""

from collections.abc import Iterator

from fcl_sim.engine.explain import Accumulated, Activated, Defuzzified, Explanation, Origin
from fcl_sim.engine.words import number

VERTICES_IN_A_ROW = 6

CENTRES = ("CoG", "CoGS")
MEANINGS = {
    "CoG": "centre of gravity",
    "CoA": "half of the area on each side",
    "LM": "leftmost maximum",
    "RM": "rightmost maximum",
    "MM": "mean of the maxima",
}


def explanation_text(explanation: Explanation) -> str:
    """Return an explanation as lines of plain text; numbers have four digits."""
    return "\n".join(
        [
            f"FUNCTION_BLOCK {explanation.name}",
            *_fuzzification(explanation),
            *_aggregation(explanation),
            *_activation(explanation),
            *_accumulation(explanation),
            *_defuzzification(explanation),
        ]
    )


def _fuzzification(explanation: Explanation) -> Iterator[str]:
    yield ""
    yield "Fuzzification"
    for each in explanation.fuzzified:
        yield f"  {each.variable} = {number(each.value)}"
        width = max(len(degree.term) for degree in each.degrees)
        yield from (f"    {degree.term:{width}}  {number(degree.degree)}" for degree in each.degrees)
    for brought in explanation.brought:
        clamped = f", taken as {number(brought.degree)}" if brought.degree != brought.value else ""
        yield f"  {brought.variable} = {number(brought.value)}{clamped}"


def _aggregation(explanation: Explanation) -> Iterator[str]:
    yield ""
    yield "Aggregation"
    width = max((len(each.rule) for each in explanation.aggregated), default=0)
    for each in explanation.aggregated:
        formula = "" if each.formula == number(each.degree) else f"{each.formula} = "
        yield f"  RULE {each.rule:{width}}  {formula}{number(each.degree)}"
        yield f"       {'':{width}}  IF {each.condition}"


def _activation(explanation: Explanation) -> Iterator[str]:
    yield ""
    yield "Activation"
    active = [each for each in explanation.activated if each.degree > 0.0]
    width = max((len(each.rule) for each in active), default=0)
    yield from (f"  RULE {each.rule:{width}}  {_activated(each)}" for each in active)
    quiet = [each.rule for each in explanation.aggregated if each.degree == 0.0]
    if quiet:
        yield f"  not fired: {', '.join(quiet)}"


def _activated(each: Activated) -> str:
    return f"{subject(each)}: {activation_formula(each)}"


def subject(each: Activated) -> str:
    """Return what is concluded, without its weight."""
    return f"{each.variable} IS {each.term}" if each.term else each.variable


def activation_formula(each: Activated) -> str:
    """Return how a conclusion is activated and weighted, such as `0.5 · MIN(0.8, μ)`."""
    if each.algorithm:
        weight = f"{number(each.weight)} · " if each.weight != 1.0 else ""
        degree = number(each.activated)
        membership = f"{degree} · μ" if each.algorithm == "PROD" else f"{each.algorithm}({degree}, μ)"
        return f"{weight}{membership}"
    weighted = f"{number(each.activated)} · WITH {number(each.weight)} = " if each.weight != 1.0 else ""
    return f"{weighted}{number(each.degree)}"


def _accumulation(explanation: Explanation) -> Iterator[str]:
    yield ""
    yield "Accumulation"
    for each in explanation.accumulated:
        yield f"  {each.variable} ({accumulation_words(each)})"
        width = max((len(degree.term) + 2 for degree in each.degrees if degree.term), default=0)
        yield from (f"    {degree.term:{width}}{number(degree.degree)}" for degree in each.degrees)
        for row in range(0, len(each.area), VERTICES_IN_A_ROW):
            vertices = each.area[row : row + VERTICES_IN_A_ROW]
            yield "    " + " ".join(f"({number(x)}, {number(degree)})" for x, degree in vertices)


def accumulation_words(each: Accumulated) -> str:
    """Return by what the results of the rules are accumulated (S26)."""
    algorithm = ", then MAX over the rule blocks" if len(each.algorithms) > 1 else ""
    return f"{' and '.join(each.algorithms) or 'no rule'}{algorithm}"


def _defuzzification(explanation: Explanation) -> Iterator[str]:
    yield ""
    yield "Defuzzification"
    by_variable = {each.variable.casefold(): each for each in explanation.accumulated}
    for each in explanation.defuzzified:
        yield f"  {each.variable} = {defuzzification_formula(each, by_variable[each.variable.casefold()])}"


def defuzzification_formula(each: Defuzzified, accumulated: Accumulated) -> str:
    """Return how an output gets its value, and the value."""
    value = number(each.value)
    if each.origin is not Origin.RULES:
        why = "the accumulated area is 0" if accumulated.area else "no rule is active"
        what = "DEFAULT" if each.origin is Origin.DEFAULT else "NC keeps the previous value"
        return f"{value}: {why}, {what}"
    if not each.method:
        return f"{value}  (degree given out)"
    if each.method not in CENTRES or accumulated.area:
        return f"{value}  ({each.method}{f': {MEANINGS[each.method]}' if each.method in MEANINGS else ''})"
    pairs = [
        (place, degree.degree)
        for place, degree in zip(each.places, accumulated.degrees, strict=True)
        if degree.degree > 0.0
    ]
    moments = " + ".join(f"{number(place)} · {number(degree)}" for place, degree in pairs)
    moments = moments.replace("+ -", "- ")
    degrees = " + ".join(number(degree) for _, degree in pairs)
    return f"({moments}) / ({degrees}) = {value}  ({each.method})"
