"""Random rule bases and inputs, from a seed: everything that the engine evaluates."""

from random import Random

from fcl_sim.model import (
    Accumulation,
    And,
    AndOperator,
    Conclusion,
    Condition,
    Defuzzification,
    Degree,
    FunctionBlock,
    Fuzzification,
    Is,
    Method,
    Not,
    Or,
    OrOperator,
    Point,
    Points,
    Rule,
    RuleBlock,
    Singleton,
    Term,
    Variable,
)

INPUTS = ("a", "b", "c")
DEGREES = ("d", "e")
OUTPUTS = ("y", "z")
AND = (AndOperator.MIN, AndOperator.PROD, AndOperator.BDIF)
OR = (OrOperator.MAX, OrOperator.ASUM, OrOperator.BSUM)
ACCU = (Accumulation.MAX, Accumulation.BSUM, Accumulation.NSUM)


def random_base(seed: int, rules: int) -> FunctionBlock:
    """Return a rule base of `rules` rules; its inputs a, b, c are fuzzified, d and e come in as degrees."""
    random = Random(seed)  # noqa: S311  nothing secret
    plain = random.random() < 0.4
    fuzzifications = tuple(
        Fuzzification(name, tuple(_term(random, n) for n in range(random.randint(1, 7)))) for name in INPUTS
    )
    defuzzifications = tuple(
        Defuzzification(
            variable=name,
            terms=tuple(
                Term(f"s{n}", Singleton(random.choice((random.uniform(-100, 100), random.randint(-9, 9)))))
                for n in range(random.randint(1, 6))
            ),
            method=Method.COGS,
            default=random.choice((None, 0.0, random.uniform(-5, 5))),
        )
        for name in OUTPUTS
    )
    first = random.randint(0, rules)
    rule_blocks = tuple(
        RuleBlock(
            name=name,
            and_operator=random.choice(AND[: 2 if plain else 3]),
            or_operator=random.choice(OR),
            accumulation=random.choice(ACCU),
            rules=tuple(
                _rule(random, str(n), fuzzifications, defuzzifications, plain=plain) for n in range(count)
            ),
        )
        for name, count in (("first", first), ("second", rules - first))
    )
    return FunctionBlock(
        name="random",
        inputs=tuple(Variable(name, initial=random.choice((None, 0.5))) for name in (*INPUTS, *DEGREES)),
        outputs=tuple(Variable(name, initial=random.choice((None, 1.5))) for name in OUTPUTS),
        fuzzifications=fuzzifications,
        defuzzifications=defuzzifications,
        rule_blocks=rule_blocks,
    )


def random_values(seed: int, base: FunctionBlock) -> dict[str, float]:
    """Return a value for every input: between, on and beyond base points; some degrees outside [0, 1]."""
    random = Random(seed)  # noqa: S311  nothing secret
    values = {}
    for each in base.fuzzifications:
        knots = [point.x for term in each.terms for point in term.shape.points]
        values[each.variable] = random.choice(
            (
                random.uniform(-11, 11),
                random.choice(knots),
                random.choice(knots) + random.uniform(-1e-9, 1e-9),
            )
        )
    for name in DEGREES:
        values[name] = random.choice((0.0, 1.0, random.random(), random.uniform(-0.5, 1.5)))
    return values


def _term(random: Random, number: int) -> Term:
    """Return a term of 1 to 5 points; some share an abscissa (a vertical edge)."""
    count = random.randint(1, 5)
    grid = random.choice((1.0, 0.25, 0.1, 1e-3))
    xs = sorted(round(random.uniform(-10, 10) / grid) * grid for _ in range(count))
    if count > 1 and random.random() < 0.3:
        xs[1] = xs[0]
    degrees = [random.choice((0.0, 0.0, 1.0, 1.0, random.random())) for _ in xs]
    return Term(f"t{number}", Points(tuple(map(Point, xs, degrees))))


def _rule(
    random: Random,
    label: str,
    fuzzifications: tuple[Fuzzification, ...],
    defuzzifications: tuple[Defuzzification, ...],
    *,
    plain: bool,
) -> Rule:
    count = random.choice((1, 1, 1, 2, 3))
    conclusions = []
    for _ in range(count):
        output = random.choice(defuzzifications)
        weight = random.choice((1.0, 1.0, 1.0, random.random(), 0.0, random.choice(DEGREES)))
        conclusions.append(Conclusion(output.variable, random.choice(output.terms).name, weight))
    if plain:
        chosen = random.sample(fuzzifications, random.randint(1, 3))
        parts = tuple(Is(each.variable, random.choice(each.terms).name) for each in chosen)
        condition: Condition = And(parts) if len(parts) > 1 else parts[0]
    else:
        condition = _condition(random, fuzzifications, random.choice((0, 1, 1, 2, 3)))
    return Rule(label, condition, tuple(conclusions))


def _condition(random: Random, fuzzifications: tuple[Fuzzification, ...], depth: int) -> Condition:
    if depth == 0 or random.random() < 0.1:
        each = random.choice(fuzzifications)
        leaf: Condition = Is(each.variable, random.choice(each.terms).name)
        if random.random() < 0.15:
            leaf = Degree(random.choice(DEGREES))
        return Not(leaf) if random.random() < 0.2 else leaf
    if random.random() < 0.1:
        return Not(_condition(random, fuzzifications, depth - 1))
    joined = And if random.random() < 0.6 else Or
    count = random.randint(2, 3)
    return joined(tuple(_condition(random, fuzzifications, depth - 1) for _ in range(count)))
