"""Time of a proof against numbers of inputs, terms and rules: full grids, and rules over uneven terms."""

import time
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product
from random import Random
from statistics import median

from fcl_sim.block import loads
from fcl_sim.model import FunctionBlock
from fcl_sim.proof.finding import Finding
from fcl_sim.proof.prove import prove
from fcl_sim.proof.universe import universe_of

ROUNDS = 3
HIGH = 100.0


@dataclass(frozen=True)
class Size:
    """A rule base: a full grid of rules, or so many that ask for some inputs, over terms of any shape."""

    inputs: int
    terms: int
    rules: int | None = None

    def __str__(self) -> str:
        kind = f"{self.rules} rules over uneven terms" if self.rules else "a full grid"
        return f"{self.inputs} inputs of {self.terms} terms, {kind}"


SIZES = (
    Size(2, 5),
    Size(2, 9),
    Size(3, 7),
    Size(2, 7, 500),
    Size(3, 7, 500),
    Size(4, 7, 500),
    Size(5, 7, 500),
    Size(6, 7, 500),
)


def measure_proof() -> Iterator[str]:
    """Yield a line for each size: the median of the processor times, and what the budget left."""
    for size in SIZES:
        text = _grid(size) if size.rules is None else _strewn(size, size.rules)
        block = loads(text).function_block
        times, findings = [], ()
        for _ in range(ROUNDS):
            start = time.process_time()
            findings = _proved(block)
            times.append(time.process_time() - start)
        yield f"{size}: {median(times):.2f} s{_left(findings)}"


def _proved(block: FunctionBlock) -> tuple[Finding, ...]:
    return prove(block, universe_of(block, [f"{each.name}=0..{HIGH:g}" for each in block.inputs]))


def _left(findings: tuple[Finding, ...]) -> str:
    told = [each.diagnostic.message for each in findings if each.diagnostic.code == "FCL615"]
    return f", {told[0].partition(' is ')[2]}" if told else ""


def _grid(size: Size) -> str:
    step = HIGH / (size.terms - 1)
    peaks = [number * step for number in range(size.terms)]
    terms = [f"({peak - step:g}, 0) ({peak:g}, 1) ({peak + step:g}, 0)" for peak in peaks]
    rules = [
        " AND ".join(f"x{place} IS t{term}" for place, term in enumerate(chosen))
        for chosen in product(range(size.terms), repeat=size.inputs)
    ]
    return _text([terms] * size.inputs, rules)


def _strewn(size: Size, count: int) -> str:
    random = Random(1)  # noqa: S311  nothing secret

    def term() -> str:
        foot, rise = random.uniform(0.0, 80.0), random.uniform(5.0, 30.0)
        top = random.uniform(0.0, 10.0)
        return (
            f"({foot:.2f}, 0) ({foot + rise:.2f}, 1) "
            f"({foot + rise + top:.2f}, 1) ({foot + 2.5 * rise + top:.2f}, 0)"
        )

    def rule() -> str:
        places = random.sample(range(size.inputs), random.randint(min(2, size.inputs), size.inputs))
        return " AND ".join(
            f"x{place} IS {random.choice(('', '', '', 'NOT '))}t{random.randrange(size.terms)}"
            for place in places
        )

    terms = [[term() for _ in range(size.terms)] for _ in range(size.inputs)]
    return _text(terms, [rule() for _ in range(count)])


def _text(terms: list[list[str]], conditions: list[str]) -> str:
    names = [f"x{place}" for place in range(len(terms))]
    fuzzified = "\n".join(
        f"FUZZIFY {name}\n"
        + "\n".join(f"TERM t{number} := {shape};" for number, shape in enumerate(own))
        + "\nEND_FUZZIFY"
        for name, own in zip(names, terms, strict=True)
    )
    singletons = "\n".join(f"TERM s{place} := {place};" for place in range(7))
    rules = "\n".join(
        f"RULE {number}: IF {each} THEN y IS s{number % 7};" for number, each in enumerate(conditions, 1)
    )
    return (
        f"FUNCTION_BLOCK proved\nVAR_INPUT {' '.join(f'{name}: REAL;' for name in names)} END_VAR\n"
        f"VAR_OUTPUT y: REAL; END_VAR\n{fuzzified}\n"
        f"DEFUZZIFY y\n{singletons}\nMETHOD: CoGS;\nDEFAULT := 0;\nEND_DEFUZZIFY\n"
        f"RULEBLOCK r\nAND: MIN;\nACCU: MAX;\n{rules}\nEND_RULEBLOCK\nEND_FUNCTION_BLOCK\n"
    )
