"""Outputs become records: how what has accumulated becomes a number."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

from fcl_sim.arithmetic.polyline import LEVEL_SIZE, POINT_SIZE, VERTEX_SIZE
from fcl_sim.engine import program as p
from fcl_sim.engine.assemble_curved import put_curved, scratch_of, vertices_of
from fcl_sim.engine.assemble_rules import GROUP_KIND, accumulation
from fcl_sim.engine.buffers import Buffers, word_source
from fcl_sim.engine.formulas import depth, postfix
from fcl_sim.engine.grid import Base
from fcl_sim.engine.plan import Plan
from fcl_sim.engine.plan_areas import AreaPlan, Pair, Part, points_of
from fcl_sim.model import Activation, Defuzzification, Formula, FunctionBlock, Method, Singleton, Term

METHODS = {
    Method.COG: p.METHOD_COG,
    Method.COGS: p.METHOD_COG,
    Method.COA: p.METHOD_COA,
    Method.LM: p.METHOD_LM,
    Method.RM: p.METHOD_RM,
    Method.MM: p.METHOD_MM,
    Method.SUM: p.METHOD_SUM,
}


@dataclass(frozen=True, slots=True)
class Outputs:
    """Where the records of outputs begin, and what they take of the memory.

    `size` is where the memory ends; `areas` are the result words of outputs
    with areas, `places` those of formulae by variable and term.
    """

    at: int
    size: int
    areas: dict[str, int]
    places: dict[tuple[str, str], int]


def put_outputs(buffers: Buffers, block: FunctionBlock, own: Plan, room: int) -> Outputs:
    """Append a record for every output; words of the memory are taken from `room` on.

    An output that nothing is said about keeps its value.
    """
    by_name = {each.variable.casefold(): each for each in block.defuzzifications}
    records: list[int] = []
    areas: dict[str, int] = {}
    places: dict[tuple[str, str], int] = {}
    for index, variable in enumerate(block.outputs):
        name = variable.name.casefold()
        output = by_name.get(name)
        value, active = len(own.inputs) + index, len(own.inputs) + len(own.outputs) + index
        if output is not None and name in own.areas:
            record, taken = _with_area(buffers, own, output, room)
            areas[name] = room
            room += taken
        else:
            formulae = _formulae(output)
            places |= {(name, term): room + number for number, term in enumerate(formulae)}
            words, room = _formula_records(buffers, own, formulae, room)
            record = _without_area(buffers, own, name, output, places, words)
        records += [value, active, *record, _output_limits(buffers, output)]
    return Outputs(buffers.put(records), room, areas, places)


def _formulae(output: Defuzzification | None) -> dict[str, Formula]:
    """Return the formulae of an output by their terms."""
    terms = () if output is None else output.terms
    return {term.name.casefold(): term.shape for term in terms if isinstance(term.shape, Formula)}


def _formula_records(
    buffers: Buffers, own: Plan, formulae: dict[str, Formula], room: int
) -> tuple[list[int], int]:
    """Return number and records of formulae, and the next free word; values come first, then the stack."""

    def source(value: float | str) -> int:
        if isinstance(value, str) and value.casefold() in own.outputs:
            return word_source(len(own.inputs) + own.outputs[value.casefold()])
        return buffers.source(own, value)

    codes = [postfix(each.expression, source) for each in formulae.values()]
    stack = room + len(codes)
    words = [len(codes)]
    for number, code in enumerate(codes):
        words += [room + number, stack, len(code), *code]
    return words, stack + max(map(depth, codes), default=0)


def _without_area(
    buffers: Buffers,
    own: Plan,
    name: str,
    output: Defuzzification | None,
    calculated: Mapping[tuple[str, str], int],
    formulae: Sequence[int],
) -> tuple[int, ...]:
    """Return the rest of the record of an output with singletons, or with nothing but a degree."""
    if name not in own.accumulators:
        return p.BY_COGS, 0, 0, 0, 0, 0, 1, 0, 0
    terms, at, groups, kinds = accumulation(buffers, own.accumulators[name])
    if output is None:
        return p.BY_DEGREE, terms, buffers.put_floats([0.0] * (terms + 1)), at, groups, kinds, 0, 0, 0

    def source(term: Term) -> int:
        if isinstance(term.shape, Singleton):
            return buffers.source(own, term.shape.value)
        return word_source(calculated[name, term.name.casefold()])

    spare = [0.0] * (terms - len(output.terms))
    constants = [_constant(term) for term in output.terms]
    places = buffers.put_floats([*(each or 0.0 for each in constants), *spare, _default(output)])
    plain = METHODS[output.method] == p.METHOD_COG and None not in constants and not is_limited(output)
    sources = [] if plain else [*map(source, output.terms), *map(buffers.constant, spare), *formulae]
    more = buffers.put(sources)
    kind = p.BY_COGS if plain else p.BY_SINGLETONS
    keep = int(holds(output))
    return kind, terms, places, at, groups, kinds, keep, METHODS[output.method], more


def _constant(term: Term) -> float | None:
    """Return the place of a constant singleton, else None."""
    if isinstance(term.shape, Singleton) and not isinstance(term.shape.value, str):
        return term.shape.value
    return None


def holds(output: Defuzzification) -> bool:
    """Return whether the previous value stays while no rule is active."""
    return output.held or output.default is None


def is_limited(output: Defuzzification) -> bool:
    """Return whether the result is taken no further than the range."""
    return output.clamped and output.range is not None


def _output_limits(buffers: Buffers, output: Defuzzification | None) -> int:
    if output is None or output.range is None or not is_limited(output):
        return 0
    return buffers.put_floats(output.range)


def _default(output: Defuzzification) -> float:
    return 0.0 if output.default is None else output.default


def _with_area(
    buffers: Buffers, own: Plan, output: Defuzzification, room: int
) -> tuple[tuple[int, ...], int]:
    """Return the rest of the record of an output with areas, and how many words of memory it takes."""
    area = own.areas[output.variable.casefold()]
    pairs = max((len(part.pairs) for _, parts in area.groups for part in parts), default=0)
    vertices = [count for group in range(len(area.groups)) for count in vertices_of(output, area, group)]
    size = VERTEX_SIZE * (4 * sum(vertices) + 8)
    levels = room + 2
    part_at = levels + LEVEL_SIZE * (pairs + 1)
    line_at = part_at + VERTEX_SIZE * max(vertices, default=0)
    terms_at = line_at + size * (3 if len(area.groups) > 1 else 2)
    moves, sources, ends, scratch_at = _terms(buffers, own, output, area, terms_at)
    taken = scratch_at + scratch_of(area)
    groups = [
        word
        for group, (kind, parts) in enumerate(area.groups)
        for word in (
            put_curved(buffers, own, area, group, sources, ends, scratch_at)
            if area.curved[group]
            else _group(buffers, own, GROUP_KIND[kind], parts, sources, ends)
        )
    ]
    record = (
        buffers.put_floats(area.limits or (0.0, 0.0)),
        int(area.limits is None),
        len(moves),
        buffers.put(word for move in moves for word in move),
        len(area.groups),
        buffers.put(groups),
        levels,
        part_at,
        line_at,
        size,
        room,
    )
    places = buffers.put_floats([_default(output)])
    keep = int(holds(output))
    more = buffers.put(record)
    return (p.BY_AREA, 0, places, 0, 0, 0, keep, METHODS[output.method], more), taken - room


def _terms(
    buffers: Buffers, own: Plan, output: Defuzzification, area: AreaPlan, at: int
) -> tuple[list[list[int]], list[int], list[int], int]:
    """Return records of moved terms; sources and ends of all terms' points; and the next free word."""
    if area.bases is not None:
        sources = [buffers.put_floats(_points(base)) for base in area.bases]
        return [], sources, [-1 - len(base) for base in area.bases], at
    moves, sources, ends = [], [], []
    for term, count in zip(output.terms, area.counts, strict=True):
        points = points_of(term)
        end, at = at, at + 1
        moves.append([at, end, len(points), *buffers.spots(own, points)])
        sources.append(word_source(at))
        ends.append(end)
        at += POINT_SIZE * count
    return moves, sources, ends, at


def _points(base: Base) -> list[float]:
    """Return points as the kernel takes them: abscissa, degree and run to the next (arithmetic.polyline)."""
    runs = [
        (right - left) / (high - low) if high != low else Fraction(0)
        for (left, low), (right, high) in pairwise(base)
    ]
    runs += [Fraction(0)] * (len(base) - len(runs))
    points = [(x, degree, run) for (x, degree), run in zip(base, runs, strict=True)]
    return [float(number) for point in points for number in point]


def _group(
    buffers: Buffers,
    own: Plan,
    kind: int,
    parts: Sequence[Part],
    sources: Sequence[int],
    ends: Sequence[int],
) -> list[int]:
    """Return an accumulation and its parts; a term that is 0 all over the range makes none."""
    there = [part for part in parts if ends[part.term] != -1]
    words = [kind, len(there)]
    for part in there:
        words += [sources[part.term], ends[part.term], len(part.pairs)]
        words += [word for pair in part.pairs for word in _pair(buffers, own, pair)]
    return words


def _pair(buffers: Buffers, own: Plan, pair: Pair) -> tuple[int, int]:
    """Return the sources of the degree that cuts off, and of the factor."""
    if pair.activation is Activation.PROD:
        return 0, word_source(pair.word)
    return word_source(pair.word), buffers.weight(own, pair.weight)
