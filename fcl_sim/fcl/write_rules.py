"""Rules → text: parentheses where Table 6 needs them, lines of bounded length (5.2.4)."""

from collections.abc import Iterator

from fcl_sim.fcl.write_numbers import number
from fcl_sim.model import And, Conclusion, Condition, Degree, Is, Not, Or, Rule


def rule_lines(rule: Rule, width: int) -> list[str]:
    """Return a rule on one line if that has at most `width` characters, else on several.

    IF and THEN then stand below each other, and what goes on is aligned with
    what it goes on with.
    """
    heading = f"{_heading(rule.label)}: "
    condition = list(_words(rule.condition))
    conclusions = [conclusion(each) for each in rule.conclusions]
    line = f"{heading}IF {' '.join(condition)} THEN {', '.join(conclusions)};"
    if len(line) <= width:
        return [line]
    margin = " " * len(heading)
    first, *others = _filled(_broken(rule.condition, condition), width - len(heading) - len("IF "))
    lines = [f"{heading}IF {first}", *(f"{margin}   {each}" for each in others)]
    ends = [","] * (len(conclusions) - 1) + [";"]
    starts = ["THEN "] + ["     "] * (len(conclusions) - 1)
    parts = zip(starts, conclusions, ends, strict=True)
    return lines + [f"{margin}{start}{each}{end}" for start, each, end in parts]


def _heading(label: str) -> str:
    """Return RULE and the label; joined where it would be taken for the beginning of the condition."""
    return f"RULE_{label}" if label.upper() == "IF" else f"RULE {label}"


def conclusion(part: Conclusion) -> str:
    """Return a subconclusion; a weight of 1 is not written."""
    term = "" if part.term is None else f" {' '.join(('IS', *part.hedges, part.term))}"
    weight = "" if part.weight == 1.0 else f" WITH {number(part.weight)}"
    return f"{part.variable}{term}{weight}"


def condition_text(condition: Condition) -> str:
    """Return a condition on one line."""
    return " ".join(_words(condition))


def _words(condition: Condition) -> Iterator[str]:
    """Yield what must stay on one line: subconditions with the AND, OR, NOT and parentheses before them.

    Calls itself as deep as the condition is nested, which its reader bounds.
    """
    match condition:
        case Is():
            yield _is(condition, "IS")
        case Degree():
            yield condition.variable
        case Not(argument=Is() as argument):
            yield _is(argument, "IS NOT")
        case Not():
            yield from _led("NOT ", _operand(condition.argument, (And, Or)))
        case And():
            yield from _joined(condition, "AND ", (And, Or))
        case Or():
            yield from _joined(condition, "OR ", (Or,))


def _is(condition: Is, verb: str) -> str:
    return " ".join((condition.variable, verb, *condition.hedges, condition.term)).rstrip()


def _joined(condition: And | Or, keyword: str, bound: tuple[type, ...]) -> Iterator[str]:
    """Yield conditions and the keyword between them; those of the kinds `bound` stand in parentheses."""
    first, *others = condition.arguments
    yield from _operand(first, bound)
    for each in others:
        yield from _led(keyword, _operand(each, bound))


def _operand(condition: Condition, bound: tuple[type, ...]) -> Iterator[str]:
    if not isinstance(condition, bound):
        yield from _words(condition)
        return
    *words, last = _led("(", _words(condition))
    yield from words
    yield f"{last})"


def _led(lead: str, words: Iterator[str]) -> Iterator[str]:
    yield lead + next(words)
    yield from words


def _broken(condition: Condition, words: list[str]) -> list[list[str]]:
    """Return the words by what begins a line in any case: the alternatives of a whole condition."""
    if not isinstance(condition, Or):
        return [words]
    parts: list[list[str]] = []
    for each in condition.arguments:
        part = list(_operand(each, (Or,)))
        parts.append(part if not parts else list(_led("OR ", iter(part))))
    return parts


def _filled(parts: list[list[str]], width: int) -> list[str]:
    """Return the words in lines of at most `width` characters, if no word is longer."""
    lines: list[str] = []
    for part in parts:
        line = ""
        for word in part:
            if line and len(line) + 1 + len(word) > width:
                lines.append(line)
                line = word
            else:
                line = f"{line} {word}".lstrip()
        lines.append(line)
    return lines
