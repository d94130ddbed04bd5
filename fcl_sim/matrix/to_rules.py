"""Matrices → rules."""

from collections.abc import Iterable, Iterator, Sequence

from fcl_sim.diagnostics import Diagnostic, InputFault, Place, Span, nearest
from fcl_sim.diagnostics.spelling import listed
from fcl_sim.matrix.matrix import ANY, Entry, Matrix, Word
from fcl_sim.model import And, Conclusion, Condition, FunctionBlock, Is, Rule


def rules(found: Sequence[Matrix], block: FunctionBlock) -> tuple[Rule, ...]:
    """Return the rules that matrices stand for, row by row, with the names of `block`, labelled from 1.

    Cells of several outputs at the same place make one rule. InputFault with
    every name that the block does not have.
    """
    names = _Names(block)
    placed: dict[tuple[tuple[str, str], ...], list[Conclusion]] = {}
    for matrix in found:
        down, across = names.input(matrix.down), names.input(matrix.across) if matrix.across.text else ""
        output = names.output(matrix.output)
        rows = [names.term(down, each) for each in matrix.rows]
        columns = [names.term(across, each) for each in matrix.columns]
        for row, line in zip(rows, matrix.cells, strict=True):
            for column, cell in zip(columns, line, strict=True):
                place = tuple(each for each in ((down, row), (across, column)) if each[1] != ANY)
                made = [names.conclusion(output, each) for each in cell]
                if made and not place:
                    names.fault(
                        cell[0].term, "a rule needs a term of one input at least", "name a row or column"
                    )
                elif made:
                    placed.setdefault(place, []).extend(made)
    if names.faults:
        raise InputFault(names.faults)
    return tuple(_numbered(placed))


def _numbered(placed: dict[tuple[tuple[str, str], ...], list[Conclusion]]) -> Iterator[Rule]:
    for number, (place, made) in enumerate(placed.items(), start=1):
        parts = tuple(Is(variable, term) for variable, term in place)
        condition: Condition = And(parts) if len(parts) > 1 else parts[0]
        yield Rule(str(number), condition, tuple(dict.fromkeys(made)))


class _Names:
    """The names of a block as it declares them, and what was asked of it that it does not have."""

    def __init__(self, block: FunctionBlock) -> None:
        self.faults: list[Diagnostic] = []
        self._name = block.name
        self._inputs = {each.variable: [term.name for term in each.terms] for each in block.fuzzifications}
        self._outputs = {each.variable: [term.name for term in each.terms] for each in block.defuzzifications}
        self._weights = [each.name for each in block.inputs]

    def input(self, word: Word) -> str:
        return self._known(word, self._inputs, f"`{self._name}` has no fuzzified input")

    def output(self, word: Word) -> str:
        return self._known(word, self._outputs, f"`{self._name}` has no defuzzified output")

    def term(self, variable: str, word: Word) -> str:
        if word.text == ANY:
            return ANY
        return (
            self._known(word, self._inputs.get(variable, ()), f"`{variable}` has no term") if variable else ""
        )

    def conclusion(self, output: str, entry: Entry) -> Conclusion:
        term = (
            self._known(entry.term, self._outputs.get(output, ()), f"`{output}` has no term")
            if output
            else ""
        )
        weight = entry.weight
        if isinstance(weight, str):
            weight = self._known(Word(weight, entry.term.span), self._weights, f"`{self._name}` has no input")
        return Conclusion(output, term, weight)

    def fault(self, word: Word, message: str, hint: str) -> None:
        self.faults.append(_finding("MTX104", word.span, message, hint))

    def _known(self, word: Word, names: Iterable[str], message: str) -> str:
        """Return a name as it is declared; remember a fault, and return nothing, where it is not."""
        known = [*names]
        for each in known:
            if each.casefold() == word.key:
                return each
        near = nearest(word.text, known)
        hint = f"did you mean `{near}`?" if near else f"there is {listed(known)}" if known else ""
        self.fault(word, f"{message} `{word.text}`", hint)
        return ""


def _finding(code: str, span: Span | None, message: str, hint: str) -> Diagnostic:
    return Diagnostic(code=code, message=message, places=(Place(span),) if span else (), hint=hint)
