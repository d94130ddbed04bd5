"""Which columns of a log are the variables of a rule base."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from fcl_sim.diagnostics import Diagnostic, InputFault, Place, nearest
from fcl_sim.diagnostics.spelling import listed
from fcl_sim.engine.program import Program
from fcl_sim.loop.trace import Trace
from fcl_sim.loop.trace_columns import Table, table


@dataclass(frozen=True, slots=True, kw_only=True)
class Columns:
    """The columns of a log by variable: all inputs, and those outputs that were recorded."""

    table: Table
    inputs: Mapping[str, str]
    outputs: Mapping[str, str]


def columns_of(log: Trace, program: Program, given: Mapping[str, str], name: str) -> Columns:
    """Return where the variables of a program stand in a log that is called `name`.

    `given` says by column which variable it is. A column that is called as the
    variable comes next, then what a trace of ours recorded of the only rule base with
    these inputs, then the only column that ends in `.variable`. Letter case is
    ignored (S1). InputFault for an input that is not found, or could be in
    several columns.
    """
    found = table(log)
    wanted = {each.casefold(): each for each in (*program.input_names, *program.output_names)}
    faults = list(_unknown(found, given, wanted, name))
    chosen = {variable.casefold(): column for column, variable in given.items()}
    block = _recorded(log, program)
    by_variable: dict[str, str] = {}
    for folded, variable in wanted.items():
        candidates = [chosen[folded]] if folded in chosen else _candidates(found.names, variable, block)
        if len(candidates) == 1:
            by_variable[variable] = candidates[0]
        elif candidates:
            faults.append(_ambiguous(variable, candidates, name))
        elif variable in program.input_names:
            faults.append(_missing(variable, found.names, name))
    if faults:
        raise InputFault(faults)
    return Columns(
        table=found,
        inputs={each: by_variable[each] for each in program.input_names},
        outputs={each: by_variable[each] for each in program.output_names if each in by_variable},
    )


def _recorded(log: Trace, program: Program) -> str | None:
    """Return the only rule base in a trace of ours that has the inputs of a program."""
    names = {each.casefold() for each in program.input_names}
    fitting = [
        block
        for block, record in log.fuzzy.items()
        if {each.casefold() for each in record.input_names} == names
    ]
    return fitting[0] if len(fitting) == 1 else None


def _candidates(names: Sequence[str], variable: str, block: str | None) -> list[str]:
    folded = variable.casefold()
    for wanted in (folded, f"{block}.{folded}".casefold()):
        exact = [each for each in names if each.casefold() == wanted]
        if exact:
            return exact
    return [each for each in names if each.casefold().endswith(f".{folded}")]


def _unknown(
    found: Table, given: Mapping[str, str], wanted: Mapping[str, str], name: str
) -> list[Diagnostic]:
    faults = []
    for column, variable in given.items():
        if column not in found.names:
            message = f"there is no column `{column}`"
            faults.append(_finding("VER204", message, name, _near(column, found.names)))
        if variable.casefold() not in wanted:
            message = f"the rule base has no variable `{variable}`"
            faults.append(_finding("VER204", message, name, _near(variable, [*wanted.values()])))
    return faults


def _ambiguous(variable: str, candidates: Sequence[str], name: str) -> Diagnostic:
    message = f"`{variable}` could be {listed(candidates)}"
    return _finding("VER202", message, name, f"say which: --map {candidates[0]}={variable}")


def _missing(variable: str, names: Sequence[str], name: str) -> Diagnostic:
    near = nearest(variable, names)
    hint = f"if it is `{near}`, say so: --map {near}={variable}" if near else f"there is {listed(names)}"
    return _finding("VER201", f"no column is the input `{variable}`", name, hint)


def _near(name: str, known: Sequence[str]) -> str:
    near = nearest(name, known)
    return f"did you mean `{near}`?" if near else f"there is {listed(known)}"


def _finding(code: str, message: str, name: str, hint: str) -> Diagnostic:
    return Diagnostic(code=code, message=message, places=(Place(file=name),), hint=hint)
