"""Hypothesis strategies for whole models, as the reader makes them."""

import string
from dataclasses import replace

from hypothesis import strategies as st

from fcl_sim.model import (
    Accumulation,
    Activation,
    And,
    AndOperator,
    Conclusion,
    DataType,
    Defuzzification,
    Degree,
    FunctionBlock,
    Fuzzification,
    Hedge,
    Is,
    Member,
    Method,
    Not,
    Or,
    OrOperator,
    Rule,
    RuleBlock,
    Structure,
    Term,
    Variable,
)
from tests.laws.shapes import DEGREES, NUMBERS, areas, singletons

RESERVED = frozenset(
    ("IF", "THEN", "IS", "AND", "OR", "NOT", "WITH", "TERM", "RULE", "ANY", "NAN", "INF", "INFINITY")
)
"""Names that the reader takes for something else somewhere: ANY is always a hedge, INF infinity."""
KEYWORDS = (
    *("time", "Type", "true", "range", "method", "lm", "nc", "default", "act", "accu", "max"),
    *("very", "gauss", "function", "pi", "lock", "enabled", "struct"),
)
NAMES = st.one_of(
    st.from_regex(r"[A-Za-z_][A-Za-z0-9_]{0,12}", fullmatch=True),
    st.sampled_from(KEYWORDS),
    st.sampled_from(("temp", "pressure", "Füllstand", "a" * 60)),
).filter(lambda name: name.upper() not in RESERVED)
LABELS = st.from_regex(r"[A-Za-z0-9_]{1,8}", fullmatch=True) | st.sampled_from(("1", "3a", "IF", "then"))
RANGES = st.tuples(NUMBERS, NUMBERS).map(sorted).map(tuple).filter(lambda limits: limits[0] < limits[1])
OPTIONS = st.text(string.ascii_lowercase + string.digits + " \n\t.,;:=+-'@§", max_size=30)

INITIALS = {
    DataType.REAL: NUMBERS,
    DataType.LREAL: NUMBERS,
    DataType.BOOL: st.sampled_from((0.0, 1.0)),
    DataType.LINT: st.integers(-(2**63), 2**63 - 1).map(float),
    DataType.ULINT: st.integers(0, 2**64 - 1).map(float),
}


def some(names, least=0, most=3):
    return st.lists(names, min_size=least, max_size=most, unique_by=str.upper)


# -- the interface


@st.composite
def _typed(draw):
    """Draw a data type and an initial value that it holds."""
    data_type = draw(st.sampled_from((DataType.REAL, DataType.REAL, *DataType)))
    initials = INITIALS.get(data_type, st.integers(0, 127).map(float))
    return data_type, draw(st.none() | initials)


@st.composite
def structures(draw):
    names = NAMES.filter(lambda name: name.upper() not in {*DataType, "STRUCT"})
    return tuple(
        Structure(name, tuple(Member(each, *draw(_typed())) for each in draw(some(NAMES, 1))))
        for name in draw(some(names, most=2))
    )


@st.composite
def variables(draw, names, types, *, ranged):
    """Draw variables; one of a structure type is a variable for each member."""
    found = []
    for name in names:
        structure = draw(st.sampled_from((None, None, *types)))
        if structure is None:
            limits = draw(st.none() | RANGES) if ranged else None
            found.append(Variable(name, *draw(_typed()), range=limits))
        else:
            found += [
                Variable(f"{name}.{each.name}", each.type, each.initial, structure=structure.name)
                for each in structure.members
            ]
    return tuple(found)


# -- terms


@st.composite
def fuzzifications(draw, inputs):
    chosen = [each for each in inputs if draw(st.booleans())]
    return tuple(
        Fuzzification(
            name,
            tuple(Term(term, draw(areas(inputs))) for term in draw(some(NAMES, 1))),
            enabled=draw(st.sampled_from((True, True, False))),
            clamped=draw(st.sampled_from((False, False, True))),
        )
        for name in chosen
    )


@st.composite
def defuzzification(draw, name, inputs, outputs):
    if draw(st.booleans()):
        shapes = singletons(inputs, outputs)
        methods = (Method.COGS, Method.LM, Method.RM, Method.MM, Method.SUM)
    else:
        shapes = areas(inputs, of_output=True)
        methods = (Method.COG, Method.COA, Method.LM, Method.RM, Method.MM)
    default = draw(st.none() | NUMBERS | st.just(float("nan")))
    return Defuzzification(
        variable=name,
        terms=tuple(Term(each, draw(shapes)) for each in draw(some(NAMES, 1))),
        method=draw(st.sampled_from(methods)),
        default=default,
        range=draw(st.none() | RANGES),
        held=draw(st.booleans()),
        clamped=draw(st.booleans()),
        enabled=draw(st.booleans()),
    )


# -- rules


def subcondition(variable, term):
    """Draw hedges before a term; NOT alone is no hedge, and ANY alone needs no term."""
    several = st.lists(st.sampled_from(Hedge), max_size=3).map(tuple)
    fitting = several.filter(lambda hedges: not hedges or hedges[0] is not Hedge.NOT)
    hedged = fitting.map(lambda hedges: Is(variable, term, hedges=hedges))
    return st.one_of(st.just(Is(variable, term)), hedged, st.just(Is(variable, "", hedges=(Hedge.ANY,))))


def concluded_hedges(term):
    """Draw hedges before a concluded term; a variable alone has none."""
    if term is None:
        return st.just(())
    fitting = (Hedge.VERY, Hedge.EXTREMELY, Hedge.SOMEWHAT, Hedge.SELDOM)
    return st.lists(st.sampled_from(fitting), max_size=2).map(tuple)


def conditions(leaves):
    """Draw conditions of any nesting."""

    def joined(inner):
        several = st.lists(inner, min_size=2, max_size=4).map(tuple)
        return st.one_of(several.map(And), several.map(Or), inner.map(Not))

    one = st.integers(0, len(leaves) - 1).flatmap(leaves.__getitem__)
    return st.recursive(one, joined, max_leaves=12)


@st.composite
def rules(draw, leaves, ends, inputs):
    """Draw the rules of a block; outputs and local variables are used once a rule has concluded on them."""
    found = []
    for label in draw(st.lists(LABELS, max_size=4)) if leaves and ends else ():
        concluded = draw(st.lists(st.sampled_from(ends), min_size=1, max_size=3))
        weights = st.one_of(st.just(1.0), DEGREES, st.sampled_from(inputs))
        conclusions = tuple(
            Conclusion(variable, term, draw(weights), hedges=draw(concluded_hedges(term)))
            for variable, term in concluded
        )
        found.append(Rule(label, draw(conditions(leaves)), conclusions))
        leaves += [
            st.just(Degree(variable)) if term is None else subcondition(variable, term)
            for variable, term in concluded
        ]
    return tuple(found)


@st.composite
def rule_blocks(draw, inputs, fuzzified, outputs, local):
    leaves = [subcondition(each.variable, term.name) for each in fuzzified for term in each.terms]
    leaves += [st.just(Degree(each)) for each in inputs]
    ends = [(each.variable, term.name) for each in outputs for term in each.terms]
    ends += [(each, None) for each in local]
    return tuple(
        RuleBlock(
            name=name,
            and_operator=draw(st.sampled_from(AndOperator)),
            or_operator=draw(st.sampled_from(OrOperator)),
            activation=draw(st.sampled_from(Activation)),
            accumulation=draw(st.sampled_from(Accumulation)),
            enabled=draw(st.sampled_from((True, True, False))),
            rules=draw(rules(leaves, ends, inputs)),
        )
        for name in draw(some(NAMES))
    )


@st.composite
def function_blocks(draw):
    """Draw a function block in which every name means something."""
    names = draw(some(NAMES, 2, 9))
    first, second = sorted(draw(st.tuples(st.integers(1, len(names) - 1), st.integers(1, len(names)))))
    types = draw(structures())
    inputs = draw(variables(names[:first], types, ranged=True))
    outputs = draw(variables(names[first:second], (), ranged=False))
    local = draw(variables(names[second:], (), ranged=True))
    of_inputs, of_outputs, of_local = ([each.name for each in part] for part in (inputs, outputs, local))
    fuzzified = draw(fuzzifications(of_inputs))
    defuzzified = tuple(draw(defuzzification(each, of_inputs, of_outputs)) for each in of_outputs)
    blocks = draw(rule_blocks(of_inputs, fuzzified, defuzzified, of_local))
    return FunctionBlock(
        name=draw(NAMES),
        inputs=inputs,
        outputs=outputs,
        variables=local,
        fuzzifications=fuzzified,
        defuzzifications=tuple(draw(accumulated(each, blocks)) for each in defuzzified),
        rule_blocks=blocks,
        options=tuple(f" {each} " for each in draw(st.lists(OPTIONS, max_size=2))),
        structures=types,
    )


@st.composite
def accumulated(draw, output, blocks):
    """Draw an ACCU for an output; one that all its rule blocks have is not its own."""
    own = draw(st.none() | st.sampled_from(Accumulation))
    concluding = {
        each.accumulation
        for each in blocks
        if any(part.variable == output.variable for rule in each.rules for part in rule.conclusions)
    }
    return replace(output, accumulation=None if concluding == {own} else own)
