"""A program in print: what `fcl-sim show program` gives."""

from collections.abc import Iterator
from math import prod

import numpy as np

from fcl_sim.arithmetic.curves import ARITIES
from fcl_sim.arithmetic.membership import PAIR_SIZE
from fcl_sim.engine import program as p
from fcl_sim.engine.conditions import AND_CODE, OR_CODE
from fcl_sim.engine.program import Program
from fcl_sim.engine.show_outputs import Names, outputs_text, source_text, spots_text
from fcl_sim.model import CurveKind

KINDS = {p.ALL_MIN: "MIN", p.ALL_PROD: "PROD", p.CODE: "code"}
HOW = {0: "max", 1: "sum"}
OPERATORS = {
    p.NOT: "NOT",
    **{code: str(operator) for operator, code in (*AND_CODE.items(), *OR_CODE.items())},
    p.ONE: "any",
    p.VERY: "very",
    p.EXTREMELY: "extremely",
    p.SOMEWHAT: "somewhat",
    p.SELDOM: "seldom",
}


def program_text(program: Program) -> str:
    """Return a program in print: its memory, its grids by cell, rules and outputs (program.py)."""
    sizes = f"{program.ints.size} integers, {program.floats.size} floats, {program.size} words of memory"
    lines = [
        f"program {program.name}: {sizes}",
        *_memory(program),
        *_grids(program),
        *_joint(program),
        *_moved(program),
        *_rules(program),
        *outputs_text(program, _names(program)),
    ]
    return "\n".join(lines)


def _names(program: Program) -> dict[int, str]:
    """Return the name of every word of the memory that has one."""
    layout = program.layout
    names = dict(enumerate(program.input_names))
    names |= {program.outputs_at + i: name for i, name in enumerate(program.output_names)}
    names |= {program.active_at + i: f"{name} active" for i, name in enumerate(program.output_names)}
    names |= {program.degrees_at + i: f"rule {label}" for i, label in enumerate(program.rule_labels)}
    names |= {at: f"{variable} IS {term}" for (variable, term), at in layout.terms.items()}
    names |= {at: f"{variable} IS NOT {term}" for (variable, term), at in layout.complements.items()}
    for variable, at in layout.brought.items():
        names |= {at: f"degree {variable}", at + 1: f"NOT degree {variable}"}
    names |= {
        at: f"accumulated {_subject(key)}" for key, at in ({**layout.accumulated, **layout.asked}).items()
    }
    names |= {at: f"area {variable}" for variable, at in layout.areas.items()}
    names |= {at: f"place {_subject(key)}" for key, at in layout.places.items()}
    return names | {layout.clamps: "clamps"}


def _subject(key: tuple[str, str | None]) -> str:
    variable, term = key
    return variable if term is None else f"{variable} IS {term}"


def _memory(program: Program) -> Iterator[str]:
    yield ""
    yield f"memory (the first {program.recorded} words are recorded)"
    yield from (f"  m{at:<4} {name}" for at, name in sorted(_names(program).items()))


def _grids(program: Program) -> Iterator[str]:
    ints, floats, names = program.ints, program.floats, _names(program)
    summary = int(ints[p.SUMMARY])
    for index in range(int(ints[p.GRIDS])):
        grid = ints[ints[p.GRID] + index * p.GRID_SIZE :]
        count, width = int(grid[p.GRID_COUNT]), int(grid[p.GRID_WIDTH])
        knots = floats[grid[p.GRID_KNOTS] :][:count]
        knots = knots[~np.isnan(knots)]
        yield ""
        yield f"grid {names[int(grid[p.GRID_INPUT])]}: {len(knots)} knots, up to {width} degrees in a cell"
        for cell in range(2 * len(knots) + 1):
            row = ints[grid[p.GRID_ROWS] + cell * grid[p.GRID_ROW_SIZE] :][: grid[p.GRID_ROW_SIZE]]
            rules = row[1 + width + summary :] if ints[p.WORDS] > 1 else row
            segments = floats[grid[p.GRID_CELLS] + cell * grid[p.GRID_PIECES] + p.EDGES_SIZE :]
            yield f"  {_place(knots, cell):18}  rules {_mask(rules, program)}"
            for k, slot in enumerate(row[1 : 1 + width].tolist()):
                if slot in names:
                    origin, value, run = segments[PAIR_SIZE * (k // 2) + k % 2 :: 2][:3]
                    rise = "" if np.isinf(run) else f" + (x - {origin:g}) / {run:g}"
                    yield f"      {names[slot]} = {value:g}{rise}"


def _place(knots: p.Floats, cell: int) -> str:
    left = f"{knots[(cell - 1) // 2]:g}" if cell > 0 else "-inf"
    if cell % 2:
        return f"x = {left}"
    right = f"{knots[cell // 2]:g}" if cell // 2 < len(knots) else "inf"
    return f"{left} < x < {right}"


def _mask(words: np.ndarray[tuple[int], np.dtype[np.int64]], program: Program) -> str:
    labels = [
        label
        for rule, label in enumerate(program.rule_labels)
        if int(words[rule // p.MASK_BITS]) >> (rule % p.MASK_BITS) & 1
    ]
    return ", ".join(labels) or "none"


def _joint(program: Program) -> Iterator[str]:
    """Yield how many ways there are in which cells meet, where rules are listed by them."""
    ints = program.ints
    if ints[p.JOINT] > 0:
        grids = ints[ints[p.GRID] :][: ints[p.GRIDS] * p.GRID_SIZE].reshape(-1, p.GRID_SIZE)
        cells = (
            2 * int(np.isfinite(program.floats[at : at + count]).sum()) + 1
            for at, count in grids[:, [p.GRID_KNOTS, p.GRID_COUNT]]
        )
        yield ""
        yield f"joint cells: {prod(cells)}, each with the list of the rules that can fire in it"


def _moved(program: Program) -> Iterator[str]:
    ints, names = program.ints, _names(program)
    record = int(ints[p.MOVE])
    for _ in range(int(ints[p.MOVED])):
        count = int(ints[record + p.MOVE_COUNT])
        yield ""
        if count < 0:
            yield f"{names[int(ints[record + p.MOVE_SLOT])]}: {_curve_text(record, program, names)}"
            record += p.CURVE_SIZE
            continue
        points = spots_text(record + p.MOVE_SPOTS, count, program, names)
        yield f"{names[int(ints[record + p.MOVE_SLOT])]}: {points}"
        record += p.MOVE_SPOTS + p.SPOT_SIZE * count


def _curve_text(record: int, program: Program, names: Names) -> str:
    """Return height, kind and parameters of a curve."""
    sources = program.ints[record + p.CURVE_HEIGHT : record + p.CURVE_SIZE].tolist()
    height, *parameters = (source_text(source, program, names) for source in sources)
    code = -1 - int(program.ints[record + p.MOVE_COUNT])
    return f"{height} * {tuple(CurveKind)[code]}({', '.join(parameters[: ARITIES[code]])})"


def _rules(program: Program) -> Iterator[str]:
    ints, names = program.ints, _names(program)
    yield ""
    yield "rules"
    for number, label in enumerate(program.rule_labels):
        rule = ints[ints[ints[p.RULE] + p.rule_entry(number)] :].tolist()
        length = rule[p.RULE_LENGTH]
        code = rule[p.RULE_BODY : p.RULE_BODY + length]
        body = "; ".join(_body(rule[p.RULE_KIND], code, program, names))
        yield f"  {label}: {KINDS[rule[p.RULE_KIND]]} [{body}]"
        for conclusion in range(rule[p.RULE_THEN]):
            then = rule[p.RULE_BODY + length + conclusion * p.THEN_SIZE :]
            how = _how(then[p.THEN_SUM], program)
            source = then[p.THEN_WEIGHT]
            weight = f", weight {source_text(source, program, names)}" if source != 0 else ""
            yield f"      {how} m{then[p.THEN_DEGREE]}{weight}"


def _how(how: int, program: Program) -> str:
    """Return by what a conclusion accumulates, and the hedges that come before."""
    if how > 1:
        record = program.ints[how:].tolist()
        hedges = record[p.HEDGED_FIRST :][: record[p.HEDGED_COUNT]]
        words = " ".join(OPERATORS[hedge] for hedge in reversed(hedges))
        return f"{words}: {_how(record[p.HEDGED_SUM], program)}"
    return HOW.get(how) or OPERATORS[how + p.OR_MAX - p.AND_MIN]


def _body(kind: int, code: list[int], program: Program, names: Names) -> Iterator[str]:
    """Yield the degrees that a condition takes, and its operators."""
    if kind != p.CODE:
        alone = kind == p.ALL_MIN and code[1:] == code[:1]
        yield from (names[slot] for slot in (code[:1] if alone else code))
        return
    words = iter(code)
    for word in words:
        if word >= 0:
            next(words)
            yield names[word]
        elif word <= p.LOOK:
            look = program.ints[p.LOOK - word :][: p.LOOK_SIZE].tolist()
            yield f"so far {names[look[p.LOOK_DEGREES] + look[p.LOOK_TERM]]}"
        else:
            yield OPERATORS[word]
