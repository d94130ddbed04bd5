"""The outputs of a program in print."""

from collections.abc import Iterator, Mapping

from fcl_sim.engine import program as p
from fcl_sim.engine.conditions import AND_CODE, OR_CODE
from fcl_sim.engine.program import Program

GROUPS = {
    p.GROUP_MAX: "MAX",
    p.GROUP_BSUM: "BSUM",
    p.GROUP_NSUM: "NSUM",
    p.GROUP_SUM: "SUM",
    p.GROUP_NORM: "S-norm",
}
METHODS = {
    p.METHOD_COG: "CoG",
    p.METHOD_COA: "CoA",
    p.METHOD_LM: "LM",
    p.METHOD_RM: "RM",
    p.METHOD_MM: "MM",
    p.METHOD_SUM: "COGSS",
}

OPERATORS = {code: str(operator) for operator, code in (*AND_CODE.items(), *OR_CODE.items())}

Names = Mapping[int, str]


def source_text(source: int, program: Program, names: Names) -> str:
    """Return what a source means (program.py)."""
    if source == 0:
        return "1"
    if source > 0:
        return f"{program.floats[source]:g}"
    return names.get(-1 - source, f"m{-1 - source}")


def spots_text(at: int, count: int, program: Program, names: Names) -> str:
    """Return points, moved ones among them."""
    spots = program.ints[at : at + count * p.SPOT_SIZE].reshape(count, p.SPOT_SIZE).tolist()
    return " ".join(f"({source_text(x, program, names)}, {program.floats[degree]:g})" for x, degree in spots)


def outputs_text(program: Program, names: Names) -> Iterator[str]:
    """Yield the lines of all outputs."""
    yield ""
    yield "outputs"
    ints, floats = program.ints, program.floats
    for index, name in enumerate(program.output_names):
        output = ints[ints[p.OUTPUT] + index * p.OUTPUT_SIZE :][: p.OUTPUT_SIZE].tolist()
        default = "NC" if output[p.OUT_KEEP] else f"{floats[output[p.OUT_PLACES] + output[p.OUT_TERMS]]:g}"
        if output[p.OUT_LIMITS]:
            low, high = floats[output[p.OUT_LIMITS] :][:2]
            default += f", result within {low:g} .. {high:g}"
        if output[p.OUT_KIND] == p.BY_AREA:
            method = METHODS[output[p.OUT_METHOD]]
            yield f"  {name}: {method}, {_limits(output[p.OUT_MORE], program)}, DEFAULT {default}"
            yield from _area(output[p.OUT_MORE], program, names)
        else:
            yield f"  {name}: {_degrees(name, output, program, names)}, DEFAULT {default}"


def _degrees(name: str, output: list[int], program: Program, names: Names) -> str:
    ints, floats = program.ints, program.floats
    terms = sum(variable == name.casefold() for variable, _ in program.layout.accumulated)
    kinds = ints[output[p.OUT_KINDS] :][: output[p.OUT_GROUPS]].tolist()
    text = f"{' and '.join(GROUPS[kind] for kind in kinds) or 'MAX'} at m{output[p.OUT_DEGREES]}"
    if output[p.OUT_KIND] == p.BY_DEGREE:
        return f"{text}, given out"
    if output[p.OUT_KIND] == p.BY_SINGLETONS:
        sources = ints[output[p.OUT_MORE] :][:terms].tolist()
        places = ", ".join(source_text(source, program, names) for source in sources)
        return f"{METHODS[output[p.OUT_METHOD]]}, {text}, places {places}"
    places = ", ".join(f"{place:g}" for place in floats[output[p.OUT_PLACES] :][:terms])
    return f"{text}, places {places}"


def _limits(area: int, program: Program) -> str:
    if program.ints[area + p.AREA_HULL]:
        return "range the hull of its points"
    low, high = program.floats[program.ints[area + p.AREA_LOW] :][:2]
    return f"range {low:g} .. {high:g}"


def _area(area: int, program: Program, names: Names) -> Iterator[str]:
    ints = program.ints
    record = int(ints[area + p.AREA_MOVE])
    for _ in range(int(ints[area + p.AREA_MOVED])):
        count = int(ints[record + p.TERM_COUNT])
        points = spots_text(record + p.TERM_SPOTS, count, program, names)
        yield f"      m{ints[record + p.TERM_AT]} = {points}"
        record += p.TERM_SPOTS + p.SPOT_SIZE * count
    part = int(ints[area + p.AREA_GROUP])
    for _ in range(int(ints[area + p.AREA_GROUPS])):
        if ints[part] == p.GROUP_CURVED:
            yield from _curved(int(ints[part + 1]), program, names)
            part += 2
            continue
        yield f"      {GROUPS[int(ints[part])]}"
        count = int(ints[part + 1])
        part += 2
        for _ in range(count):
            pairs = ints[part + p.PART_PAIR :][: 2 * int(ints[part + p.PART_PAIRS])].tolist()
            terms = [
                f"{source_text(factor, program, names)} · MIN({source_text(cut, program, names)}, μ)"
                for cut, factor in zip(pairs[::2], pairs[1::2], strict=True)
            ]
            yield f"          {' + '.join(terms)} of {_points(part, program)}"
            part += p.PART_PAIR + len(pairs)


def _curved(record: int, program: Program, names: Names) -> Iterator[str]:
    """Yield an accumulation by norms of the Open Level."""
    ints = program.ints
    kind, terms, pairs = ints[record : record + 3].tolist()
    yield f"      {GROUPS[kind] if kind >= 0 else OPERATORS[kind + p.OR_MAX - p.AND_MIN]}"
    first = record + p.CURVED_FIRST
    words = ints[first + p.CURVED_TERM * terms :][: p.CURVED_PAIR * pairs].reshape(-1, p.CURVED_PAIR)
    for term, operator, degree, weight in words.tolist():
        activated = f"{OPERATORS[operator]}({source_text(degree, program, names)}, μ)"
        points = _points(first + p.CURVED_TERM * term, program)
        yield f"          {source_text(weight, program, names)} · {activated} of {points}"


def _points(part: int, program: Program) -> str:
    source, end = int(program.ints[part + p.PART_TERM]), int(program.ints[part + p.PART_END])
    if source < 0:
        return f"m{-1 - source}"
    points = program.floats[source:][: 3 * (-1 - end)].reshape(-1, 3).tolist()
    return " ".join(f"({x:g}, {degree:g})" for x, degree, _ in points)
