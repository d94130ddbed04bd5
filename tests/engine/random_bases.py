"""Random rule bases and inputs, from a seed: everything that the engine evaluates."""

from dataclasses import replace
from random import Random

from fcl_sim.model import (
    Accumulation,
    Activation,
    And,
    AndOperator,
    Conclusion,
    Condition,
    Defuzzification,
    Degree,
    FunctionBlock,
    Fuzzification,
    Is,
    Member,
    Method,
    Not,
    Or,
    OrOperator,
    Point,
    Points,
    Rule,
    RuleBlock,
    Singleton,
    Structure,
    Term,
    Variable,
)

INPUTS = ("a", "b", "c")
DEGREES = ("d", "shade.light")
"""Brought in from outside; the second is a member of a structure."""
MOVERS = ("m", "n")
OUTPUTS = ("y", "z")
GIVEN_OUT = "q"
LOCALS = ("l", "k")
AND = (AndOperator.MIN, AndOperator.PROD, AndOperator.BDIF)
OR = (OrOperator.MAX, OrOperator.ASUM, OrOperator.BSUM)
ACT = (Activation.MIN, Activation.PROD)
ACCU = (Accumulation.MAX, Accumulation.BSUM, Accumulation.NSUM)
NORMS = (
    (AndOperator.HPROD, AndOperator.EPROD),
    (OrOperator.HSUM, OrOperator.ESUM),
    (Accumulation.SUM, Accumulation.ASUM, Accumulation.HSUM, Accumulation.ESUM),
)
"""Of the Open Level, those without jumps: AND, OR, and what accumulates singletons."""
FOR_AREAS = (Method.COG, Method.COG, Method.COA, Method.LM, Method.RM, Method.MM)
FOR_SINGLETONS = (Method.COGS, Method.COGS, Method.LM, Method.RM, Method.MM)


def random_base(seed: int, rules: int, *, chained: bool = True, norms: bool = False) -> FunctionBlock:
    """Return a rule base of `rules` rules.

    Its inputs a, b, c are fuzzified, d and shade.light come in as degrees, m
    and n move points and singletons; y and z are outputs with terms. With
    `chained` q is an output without terms, l and k are local, and conditions
    ask for what rules before have concluded. With `norms` the operators are
    those of the Open Level, and so is what accumulates singletons.
    """
    random = Random(seed)  # noqa: S311  nothing secret
    plain = random.random() < 0.4
    moving = random.random() < 0.3
    fuzzifications = tuple(
        Fuzzification(
            name, tuple(_term(random, n, moving=moving and n == 1) for n in range(random.randint(1, 7)))
        )
        for name in INPUTS
    )
    defuzzifications = tuple(_output(random, name, moving=moving) for name in OUTPUTS)
    first = random.randint(0, rules)
    accumulations = (random.choice(ACCU), random.choice(ACCU))
    if random.random() < 0.5:
        accumulations = accumulations[:1] * 2
    asked: list[Condition] = []
    rule_blocks = []
    for name, accumulation, numbers in (
        ("first", accumulations[0], range(first)),
        ("second", accumulations[1], range(first, rules)),
    ):
        own = []
        for number in numbers:
            rule = _rule(
                random, str(number), fuzzifications, defuzzifications, asked, plain=plain, chained=chained
            )
            own.append(rule)
            if chained:
                asked += [
                    Degree(each.variable) if each.term is None else Is(each.variable, each.term)
                    for each in rule.conclusions
                ]
        rule_blocks.append(
            RuleBlock(
                name=name,
                and_operator=random.choice(AND[: 2 if plain else 3]),
                or_operator=random.choice(OR),
                activation=random.choice(ACT),
                accumulation=accumulation,
                rules=tuple(own),
            )
        )
    inputs = (*INPUTS, *DEGREES, *MOVERS)
    initials = [random.choice((None, 0.5)) for _ in inputs]
    base = FunctionBlock(
        name="random",
        inputs=tuple(
            Variable(name, initial=initial, structure="shades" if "." in name else None)
            for name, initial in zip(inputs, initials, strict=True)
        ),
        outputs=tuple(
            Variable(name, initial=random.choice((None, 1.5)))
            for name in (*OUTPUTS, *([GIVEN_OUT] if chained else []))
        ),
        variables=tuple(map(Variable, LOCALS)),
        fuzzifications=fuzzifications,
        defuzzifications=defuzzifications,
        rule_blocks=tuple(rule_blocks),
        structures=(Structure("shades", (Member("light"),)),),
    )
    return _with_norms(random, base) if norms else base


def _with_norms(random: Random, base: FunctionBlock) -> FunctionBlock:
    """Return `base` with operators of the Open Level, and with its S-norms wherever singletons accumulate."""
    conjunctions, disjunctions, accumulations = NORMS
    return replace(
        base,
        rule_blocks=tuple(
            replace(each, and_operator=random.choice(conjunctions), or_operator=random.choice(disjunctions))
            for each in base.rule_blocks
        ),
        defuzzifications=tuple(
            replace(each, accumulation=random.choice(accumulations))
            if all(isinstance(term.shape, Singleton) for term in each.terms)
            else each
            for each in base.defuzzifications
        ),
    )


def random_values(seed: int, base: FunctionBlock) -> dict[str, float]:
    """Return a value for every input: between, on and beyond base points; some degrees outside [0, 1]."""
    random = Random(seed)  # noqa: S311  nothing secret
    values = {}
    for each in base.fuzzifications:
        knots = [
            point.x for term in each.terms for point in term.shape.points if not isinstance(point.x, str)
        ] or [0.0]
        values[each.variable] = random.choice(
            (
                random.uniform(-11, 11),
                random.choice(knots),
                random.choice(knots) + random.uniform(-1e-9, 1e-9),
            )
        )
    for name in DEGREES:
        values[name] = random.choice((0.0, 1.0, random.random(), random.uniform(-0.5, 1.5)))
    for name in MOVERS:
        values[name] = random.choice((float(random.randint(-9, 9)), random.uniform(-12, 12)))
    return values


def _term(random: Random, number: int, *, moving: bool) -> Term:
    """Return a term of 1 to 5 points; some share an abscissa (a vertical edge), some are moved."""
    count = random.randint(1, 5)
    grid = random.choice((1.0, 0.25, 0.1, 1e-3))
    xs: list[float | str] = sorted(round(random.uniform(-10, 10) / grid) * grid for _ in range(count))
    if count > 1 and random.random() < 0.3:
        xs[1] = xs[0]
    degrees = [random.choice((0.0, 0.0, 1.0, 1.0, random.random())) for _ in xs]
    if moving:
        xs[random.randrange(count)] = random.choice(MOVERS)
    return Term(f"t{number}", Points(tuple(map(Point, xs, degrees))))


def _output(random: Random, name: str, *, moving: bool) -> Defuzzification:
    count = random.randint(1, 6)
    with_area = random.random() < 0.6
    limits = random.choice((None, (-10.0, 10.0), tuple(sorted(random.sample(range(-12, 13), 2)))))
    return Defuzzification(
        variable=name,
        terms=tuple(
            _area(random, n, moving=moving and n == 0) if with_area else _singleton(random, n, moving=moving)
            for n in range(count)
        ),
        method=random.choice(FOR_AREAS if with_area else FOR_SINGLETONS),
        default=random.choice((None, 0.0, random.uniform(-5, 5))),
        range=limits if with_area else None,
        accumulation=random.choice((None, None, None, random.choice(ACCU))),
    )


def _area(random: Random, number: int, *, moving: bool) -> Term:
    """Return an output's term: a triangle, a trapezium, a rectangle, or anything."""
    kind = random.randrange(5)
    if kind < 3 and not moving:
        grid = random.choice((1.0, 0.25, 0.1))
        a, b, c, d = sorted(round(random.uniform(-10, 10) / grid) * grid for _ in range(4))
        xs, degrees = (((a, b, d), (0, 1, 0)), ((a, b, c, d), (0, 1, 1, 0)), ((a, a, d, d), (0, 1, 1, 0)))[
            kind
        ]
        return Term(
            f"t{number}",
            Points(tuple(Point(x, float(degree)) for x, degree in zip(xs, degrees, strict=True))),
        )
    return _term(random, number, moving=moving)


def _singleton(random: Random, number: int, *, moving: bool) -> Term:
    place: float | str = random.choice((random.uniform(-100, 100), float(random.randint(-9, 9))))
    if moving and random.random() < 0.3:
        place = random.choice(MOVERS)
    return Term(f"t{number}", Singleton(place))


def _rule(
    random: Random,
    label: str,
    fuzzifications: tuple[Fuzzification, ...],
    defuzzifications: tuple[Defuzzification, ...],
    asked: list[Condition],
    *,
    plain: bool,
    chained: bool,
) -> Rule:
    count = random.choice((1, 1, 1, 2, 3))
    conclusions = []
    for _ in range(count):
        weight = random.choice((1.0, 1.0, 1.0, random.random(), 0.0, random.choice(DEGREES)))
        if chained and random.random() < 0.15:
            conclusions.append(Conclusion(random.choice((GIVEN_OUT, *LOCALS)), None, weight))
            continue
        output = random.choice(defuzzifications)
        conclusions.append(Conclusion(output.variable, random.choice(output.terms).name, weight))
    if plain:
        chosen = random.sample(fuzzifications, random.randint(1, 3))
        parts = tuple(Is(each.variable, random.choice(each.terms).name) for each in chosen)
        condition: Condition = And(parts) if len(parts) > 1 else parts[0]
    else:
        condition = _condition(random, fuzzifications, random.choice((0, 1, 1, 2, 3)), asked)
    return Rule(label, condition, tuple(conclusions))


def _condition(
    random: Random, fuzzifications: tuple[Fuzzification, ...], depth: int, asked: list[Condition]
) -> Condition:
    if depth == 0 or random.random() < 0.1:
        each = random.choice(fuzzifications)
        leaf: Condition = Is(each.variable, random.choice(each.terms).name)
        if random.random() < 0.15:
            leaf = Degree(random.choice(DEGREES))
        if asked and random.random() < 0.15:
            leaf = random.choice(asked)
        return Not(leaf) if random.random() < 0.2 else leaf
    if random.random() < 0.1:
        return Not(_condition(random, fuzzifications, depth - 1, asked))
    joined = And if random.random() < 0.6 else Or
    count = random.randint(2, 3)
    return joined(tuple(_condition(random, fuzzifications, depth - 1, asked) for _ in range(count)))
