"""Tables in CSV or TOML → matrices, with every fault and its place."""

import re
from collections.abc import Iterator, Sequence

from fcl_sim.diagnostics import Diagnostic, InputFault, Place, Source, Span
from fcl_sim.matrix.csv_cells import lines_of
from fcl_sim.matrix.matrix import Cell, Entry, Matrix, Word
from fcl_sim.toml.document import parse
from fcl_sim.toml.tree import Entry as Given

_CONCLUSION = re.compile(r"\s*(\S+)(?:\s+WITH\s+(\S+))?\s*", re.IGNORECASE)
_EMPTY = {"", "-"}
_KEYS = ("output", "rows", "columns", "rules")


def read(source: Source) -> tuple[Matrix, ...]:
    """Return the matrices of a table: TOML where the source's name ends so, else CSV.

    InputFault with every fault of the table.
    """
    toml = source.name.casefold().endswith(".toml")
    faults: list[Diagnostic] = []
    made = [*(_from_toml if toml else _from_csv)(source, faults)]
    if not made and not faults:
        hint = "begin with the name of the output, then a line with the inputs and the terms of the second"
        faults.append(_fault("MTX103", Span(source, 0, 0), "there is no matrix in this table", hint))
    if faults:
        raise InputFault(faults)
    return tuple(made)


def _from_csv(source: Source, faults: list[Diagnostic]) -> Iterator[Matrix]:
    part: list[list[Word]] = []
    for line in [*lines_of(source), []]:
        if line:
            part.append(line)
        elif part:
            yield from _part(part, faults)
            part = []


def _part(part: Sequence[Sequence[Word]], faults: list[Diagnostic]) -> Iterator[Matrix]:
    """Yield the matrix of some lines that belong together."""
    (output, *more), *table = part
    if any(each.text for each in more) or not table:
        message = "a matrix begins with a line that names its output, and nothing else"
        faults.append(
            _fault("MTX103", output.span, message, "put the output's name on a line before the table")
        )
        return
    corner = table[0][0]
    down, _, across = (each.strip() for each in corner.text.partition("\\"))
    if not down:
        hint = "write it as in `distance \\ angle`: down the rows, then across the columns"
        faults.append(_fault("MTX103", corner.span, "the first cell of the table names the inputs", hint))
        return
    names = (output, Word(down, corner.span), Word(across, corner.span))
    yield from _matrix(names, table, faults)


def _from_toml(source: Source, faults: list[Diagnostic]) -> Iterator[Matrix]:
    tree = parse(source, not_toml="MTX102", twice="MTX102")
    given = tree.get("matrix")
    for key, each in tree.table.items():
        if key != "matrix":
            faults.append(
                _fault("MTX103", each.key, f"there is no `{key}` in a file of matrices", "it has [[matrix]]")
            )
    for table in given.items if given else ():
        wrong = [each for key, each in table.table.items() if key not in _KEYS]
        faults += [
            _fault("MTX103", each.key, "a matrix has no such key", f"it has {', '.join(_KEYS)}")
            for each in wrong
        ]
        names = [_word(table.get(key)) for key in _KEYS[:3]]
        rows = table.get("rules")
        lines = [[_word(cell) for cell in row.items] for row in (rows.items if rows else ())]
        if not (names[0].text and names[1].text and lines and all(lines)):
            message = "a matrix has an `output`, `rows` that name an input, and `rules`: a list of rows"
            faults.append(_fault("MTX103", table.key, message, ""))
            continue
        yield from _matrix((names[0], names[1], names[2]), lines, faults)


def _word(given: Given | None) -> Word:
    return Word(given.value.strip(), given.span) if given and isinstance(given.value, str) else Word("")


def _matrix(
    names: tuple[Word, Word, Word], table: Sequence[Sequence[Word]], faults: list[Diagnostic]
) -> Iterator[Matrix]:
    head, *lines = table
    width = len(head)
    before = len(faults)
    for line in lines:
        if len(line) != width:
            message = f"this row has {len(line)} cells, and the first has {width}"
            faults.append(
                _fault("MTX103", line[0].span, message, "leave a cell empty where there is no rule")
            )
    for words in (head[1:], [line[0] for line in lines]):
        faults += _repeated(words)
    if not lines or width < 2:
        message = "a table has a row of terms and a column of terms"
        faults.append(_fault("MTX103", head[0].span, message, "write * for the column of a single input"))
    cells = tuple(tuple(_cell(each, faults) for each in line[1:]) for line in lines)
    if len(faults) == before:
        yield Matrix(
            output=names[0],
            down=names[1],
            across=names[2],
            rows=tuple(line[0] for line in lines),
            columns=tuple(head[1:]),
            cells=cells,
        )


def _repeated(words: Sequence[Word]) -> Iterator[Diagnostic]:
    seen: dict[str, Word] = {}
    for each in words:
        if not each.text:
            yield _fault("MTX103", each.span, "a row or column has no term", "write * for any term")
        elif each.key in seen:
            yield _fault(
                "MTX103", each.span, f"`{each.text}` has a row or column already", "take them together"
            )
        seen[each.key] = each


def _cell(word: Word, faults: list[Diagnostic]) -> Cell:
    if word.text in _EMPTY:
        return ()
    made = []
    for part in word.text.split(","):
        match = _CONCLUSION.fullmatch(part)
        weight = _weight(match[2]) if match else None
        if match is None or weight is None:
            hint = "write a term of the output, or `term WITH 0.5`; several are parted by commas"
            faults.append(_fault("MTX105", word.span, f"`{part.strip()}` is no conclusion", hint))
            continue
        made.append(Entry(Word(match[1], word.span), weight))
    return tuple(made)


def _weight(text: str | None) -> float | str | None:
    """Return a weight: a number from 0 to 1, or a name; None where it is another number."""
    if text is None:
        return 1.0
    try:
        number = float(text)
    except ValueError:
        return text
    return number if 0.0 <= number <= 1.0 else None


def _fault(code: str, span: Span | None, message: str, hint: str) -> Diagnostic:
    return Diagnostic(code=code, message=message, places=(Place(span),) if span else (), hint=hint)
