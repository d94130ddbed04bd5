"""Small rule bases from a seed, as FCL, and where a point lies in what was proved of them."""

from fractions import Fraction
from random import Random

from fcl_sim import fcl

NAMES = ("a", "b", "c")
LOW, HIGH = 0, 12
"""The universe of every input; points of terms are whole numbers within, and beside it."""

STRICT = {"AND": ("MIN", "PROD"), "OR": ("MAX", "ASUM")}
ANY = {"AND": ("MIN", "PROD", "BDIF"), "OR": ("MAX", "ASUM", "BSUM")}


def random_text(seed, operators=STRICT):
    """Return a rule base of up to three inputs with straight terms and one output y of singletons."""
    random = Random(seed)  # noqa: S311  nothing secret
    names = NAMES[: random.randint(1, 3)]
    terms = {name: [f"t{n}" for n in range(random.randint(2, 4))] for name in names}
    lines = ["FUNCTION_BLOCK small", "VAR_INPUT"]
    lines += [f"    {each}: REAL;" for each in names]
    lines += ["    d: REAL;", "END_VAR", "VAR_OUTPUT", "    y: REAL;", "END_VAR"]
    for name in names:
        lines.append(f"FUZZIFY {name}")
        lines += [f"    TERM {term} := {shape(random)};" for term in terms[name]]
        lines.append("END_FUZZIFY")
    lines += [
        "DEFUZZIFY y",
        "    TERM s0 := 0;",
        "    TERM s1 := 1;",
        "    METHOD: CoGS;",
        "    DEFAULT := 7;",
    ]
    lines += ["END_DEFUZZIFY", "RULEBLOCK No1", f"    AND: {random.choice(operators['AND'])};"]
    lines += [f"    OR: {random.choice(operators['OR'])};", "    ACCU: MAX;"]
    for label in range(1, 2 + seed % 5):
        weight = random.choice(("", "", "", " WITH 0.5", " WITH 0"))
        text = condition(random, terms, 2)
        lines.append(f"    RULE {label}: IF {text} THEN y IS s{random.randint(0, 1)}{weight};")
    return "\n".join([*lines, "END_RULEBLOCK", "END_FUNCTION_BLOCK"])


def shape(random):
    places = sorted(random.sample(range(LOW - 2, HIGH + 3), random.randint(2, 4)))
    degrees = [random.choice((0, 0, 1, 0.5)) for _ in places]
    if random.random() < 0.2:
        places[1] = places[0]
    return " ".join(f"({x}, {y})" for x, y in zip(places, degrees, strict=True))


def condition(random, terms, depth):
    if depth == 0 or random.random() < 0.3:
        if random.random() < 0.1:
            return random.choice(("d", "NOT d"))
        name = random.choice(list(terms))
        return f"{name} IS {random.choice(('', '', 'NOT '))}{random.choice(terms[name])}"
    word = random.choice((" AND ", " AND ", " AND ", " OR "))
    inner = word.join(condition(random, terms, depth - 1) for _ in range(2))
    return random.choice(("({})", "({})", "({})", "({})", "NOT ({})")).format(inner)


def block_of(text):
    (block,) = fcl.read(text).blocks
    return block


def inside(box, point):
    """Return whether a point, by name, lies in a box."""
    return all(_within(side, point[name]) for name, side in box.sides.items())


def _within(side, value):
    above = side.low is None or value > side.low or (side.low_closed and value == side.low)
    below = side.high is None or value < side.high or (side.high_closed and value == side.high)
    return above and below


def random_points(names, seed, count, low=LOW, high=HIGH):
    """Return points of few binary digits, many of them on breakpoints; `d` is within [0, 1]."""
    random = Random(seed)  # noqa: S311  nothing secret

    def value(name):
        if name == "d":
            return random.choice((Fraction(0), Fraction(1), Fraction(random.randint(0, 16), 16)))
        parts = random.choice((1, 2, 8))
        return Fraction(random.randint(parts * low, parts * high), parts)

    return [{name: value(name) for name in names} for _ in range(count)]
