"""A program in print: what `fcl-sim show program` gives."""

from collections.abc import Iterator

import numpy as np

from fcl_sim.engine import program as p
from fcl_sim.engine.program import Program

KINDS = {p.ALL_MIN: "MIN", p.ALL_PROD: "PROD", p.CODE: "code"}
OPERATORS = {
    p.NOT: "NOT",
    p.AND_MIN: "MIN",
    p.AND_PROD: "PROD",
    p.AND_BDIF: "BDIF",
    p.OR_MAX: "MAX",
    p.OR_ASUM: "ASUM",
    p.OR_BSUM: "BSUM",
}
GROUPS = {p.GROUP_MAX: "MAX", p.GROUP_BSUM: "BSUM", p.GROUP_NSUM: "NSUM"}


def program_text(program: Program) -> str:
    """Return a program in print: its memory, its grids by cell, rules and outputs (program.py)."""
    sizes = f"{program.ints.size} integers, {program.floats.size} floats, {program.size} words of memory"
    lines = [
        f"program {program.name}: {sizes}",
        *_memory(program),
        *_grids(program),
        *_rules(program),
        *_outputs(program),
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
    names |= {at: f"accumulated {variable} IS {term}" for (variable, term), at in layout.accumulated.items()}
    return names | {layout.clamps: "clamps"}


def _memory(program: Program) -> Iterator[str]:
    yield ""
    yield f"memory (the first {program.recorded} words are recorded)"
    yield from (f"  m{at:<4} {name}" for at, name in sorted(_names(program).items()))


def _grids(program: Program) -> Iterator[str]:
    ints, floats, names = program.ints, program.floats, _names(program)
    words = int(ints[p.WORDS])
    for index in range(int(ints[p.GRIDS])):
        grid = ints[ints[p.GRID] + index * p.GRID_SIZE :]
        count, width = int(grid[p.GRID_COUNT]), int(grid[p.GRID_WIDTH])
        knots = floats[grid[p.GRID_KNOTS] :][:count]
        knots = knots[~np.isnan(knots)]
        yield ""
        yield f"grid {names[int(grid[p.GRID_INPUT])]}: {len(knots)} knots, up to {width} degrees in a cell"
        for cell in range(2 * len(knots) + 1):
            row = ints[grid[p.GRID_ROWS] + cell * (width + words) :][: width + words]
            segments = floats[grid[p.GRID_SEGMENTS] + cell * width * p.SEGMENT_SIZE :].reshape(-1)
            yield f"  {_place(knots, cell):18}  rules {_mask(row[width:], program)}"
            for k, slot in enumerate(row[:width].tolist()):
                if slot in names:
                    origin, value, run = segments[k * p.SEGMENT_SIZE :][: p.SEGMENT_SIZE]
                    rise = "" if np.isinf(run) else f" + (x - {origin:g}) / {run:g}"
                    yield f"      {names[slot]} = {value:g}{rise}"


def _place(knots: np.ndarray[tuple[int], np.dtype[np.float64]], cell: int) -> str:
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


def _rules(program: Program) -> Iterator[str]:
    ints, floats, names = program.ints, program.floats, _names(program)
    yield ""
    yield "rules"
    for number, label in enumerate(program.rule_labels):
        word, bit = divmod(number, p.MASK_BITS)
        place = word * p.MASK_BITS + (((p.DE_BRUIJN << bit) >> 27) & 31)
        rule = ints[ints[ints[p.RULE] + place] :].tolist()
        length = rule[p.RULE_LENGTH]
        code = rule[p.RULE_BODY : p.RULE_BODY + length]
        body = "; ".join(OPERATORS[each] if each < 0 else names[each] for each in code)
        yield f"  {label}: {KINDS[rule[p.RULE_KIND]]} [{body}]"
        for conclusion in range(rule[p.RULE_THEN]):
            then = rule[p.RULE_BODY + length + conclusion * p.THEN_SIZE :]
            how = "sum" if then[p.THEN_SUM] else "max"
            yield f"      {how} m{then[p.THEN_DEGREE]}{_weight(then[p.THEN_WEIGHT], floats, names)}"


def _weight(weight: int, floats: np.ndarray[tuple[int], np.dtype[np.float64]], names: dict[int, str]) -> str:
    if weight == 0:
        return ""
    return f", weight {floats[weight]:g}" if weight > 0 else f", weight {names[-1 - weight]}"


def _outputs(program: Program) -> Iterator[str]:
    ints, floats = program.ints, program.floats
    yield ""
    yield "outputs"
    for index, name in enumerate(program.output_names):
        output = ints[ints[p.OUTPUT] + index * p.OUTPUT_SIZE :][: p.OUTPUT_SIZE].tolist()
        count, at = output[p.OUT_TERMS], output[p.OUT_PLACES]
        terms = sum(variable == name.casefold() for variable, _ in program.layout.accumulated)
        places = ", ".join(f"{place:g}" for place in floats[at : at + terms])
        kinds = ints[output[p.OUT_KINDS] :][: output[p.OUT_GROUPS]].tolist()
        algorithms = " and ".join(GROUPS[kind] for kind in kinds) or "MAX"
        default = "NC" if output[p.OUT_KEEP] else f"{floats[at + count]:g}"
        yield f"  {name}: {algorithms} at m{output[p.OUT_DEGREES]}, places {places}, DEFAULT {default}"
