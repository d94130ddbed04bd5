"""Rules → matrices."""

from collections.abc import Iterator
from dataclasses import dataclass

from fcl_sim.diagnostics import Diagnostic, InputFault, Place
from fcl_sim.matrix.matrix import ANY, Cell, Entry, Matrix, Word
from fcl_sim.model import And, Condition, FunctionBlock, Is, Not, Or, Rule

MOST_NAMED = 8


@dataclass(frozen=True, slots=True)
class Found:
    """The matrices of a rule base, one for each output, and the rules that stand in none."""

    matrices: tuple[Matrix, ...]
    beside: tuple[Rule, ...]


def matrices(block: FunctionBlock) -> Found:
    """Return the rules of a block as matrices: down its first input, across its second.

    An output on which no cell concludes has none.
    InputFault where its rules take terms of more than two inputs, or of none.
    """
    named = {each.variable.casefold(): each for each in block.fuzzifications}
    rules = [rule for rule_block in block.rule_blocks for rule in rule_block.rules]
    asked = {name for rule in rules for name in _variables(rule.condition)}
    inputs = [each.name for each in block.inputs if each.name.casefold() in asked & named.keys()]
    if not 1 <= len(inputs) <= 2:
        raise _no_matrix(block, inputs)
    terms = [tuple(term.name for term in named[name.casefold()].terms) for name in inputs]
    placed = [(rule, _place(rule, inputs)) for rule in rules]
    inside = [(rule, place) for rule, place in placed if place is not None]
    outputs = [each.variable for each in block.defuzzifications]
    made = [_matrix(output, inputs, terms, inside) for output in outputs]
    shown = tuple(each for each in made if any(cell for row in each.cells for cell in row))
    return Found(shown, tuple(rule for rule, place in placed if place is None))


Spot = tuple[str, str]
"""The terms of the first and of the second input that a rule takes, in folded letters; ANY for none."""


def _matrix(
    output: str, inputs: list[str], terms: list[tuple[str, ...]], placed: list[tuple[Rule, Spot]]
) -> Matrix:
    found: dict[Spot, list[Entry]] = {}
    for rule, place in placed:
        for each in rule.conclusions:
            if each.variable.casefold() == output.casefold() and each.term is not None:
                found.setdefault(place, []).append(Entry(Word(each.term), each.weight))
    down, across = inputs[0], inputs[1] if len(inputs) == 2 else ""
    rows = (*terms[0], *([ANY] if any(place[0] == ANY for place in found) else []))
    columns = (*(terms[1] if across else ()), *([ANY] if _is_needed(found, across) else []))
    return Matrix(
        output=Word(output),
        down=Word(down),
        across=Word(across),
        rows=tuple(map(Word, rows)),
        columns=tuple(map(Word, columns)),
        cells=tuple(tuple(_cell(found, row, column) for column in columns) for row in rows),
    )


def _is_needed(found: dict[Spot, list[Entry]], across: str) -> bool:
    return not across or any(place[1] == ANY for place in found)


def _cell(found: dict[Spot, list[Entry]], row: str, column: str) -> Cell:
    return tuple(found.get((row.casefold(), column.casefold()), ()))


def _place(rule: Rule, inputs: list[str]) -> Spot | None:
    """Return the cell of a rule; None where it is more, or something else, than a cell can hold."""
    condition = rule.condition
    parts = condition.arguments if isinstance(condition, And) else (condition,)
    taken: dict[str, str] = {}
    for part in parts:
        if not isinstance(part, Is) or part.hedges or part.variable.casefold() in taken:
            return None
        taken[part.variable.casefold()] = part.term.casefold()
    plain = all(each.term is not None and not each.hedges for each in rule.conclusions)
    if not plain or not taken.keys() <= {each.casefold() for each in inputs}:
        return None
    first, *second = (taken.get(each.casefold(), ANY) for each in inputs)
    return first, second[0] if second else ANY


def _variables(condition: Condition) -> Iterator[str]:
    match condition:
        case And() | Or():
            for each in condition.arguments:
                yield from _variables(each)
        case Not():
            yield from _variables(condition.argument)
        case Is():
            yield condition.variable.casefold()


def _no_matrix(block: FunctionBlock, inputs: list[str]) -> InputFault:
    shown = ", ".join(f"`{each}`" for each in inputs[:MOST_NAMED])
    told = f"of {len(inputs)} inputs: {shown}" if inputs else "of no input"
    place = Place(block.span) if block.span else Place(file=block.name)
    return InputFault(
        [
            Diagnostic(
                code="MTX101",
                message=f"the rules of `{block.name}` take terms {told}; a matrix has two",
                places=(place,),
                hint="look at its rules with `fcl-sim show model`, and at slices of it with `fcl-sim plot`",
            )
        ]
    )
