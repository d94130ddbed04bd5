"""Aggregation and activation: a row for each rule that fired."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

from fcl_sim.engine.explain import Activated
from fcl_sim.engine.explain_text import activation_formula
from fcl_sim.report import lettering, style
from fcl_sim.report.canvas import Axes, Figure, Line, Shape
from fcl_sim.report.inference_shapes import TOP, draw_activated, draw_taken, sketch
from fcl_sim.report.inference_view import Fired, Leaf, View
from fcl_sim.report.strips import COLUMN, EDGE, LINE, Strip, draw_bar, headline, text_height, write
from fcl_sim.report.words import counted, joined, number, one_line, printed

FULL = 8
"""So many rules are drawn with their terms; of more, each takes a line or two of text and a bar."""
LINES = 100
"""So many rules have lines; of more, those of the largest degrees."""

CONDITIONS = 103.0
"""Width of the subconditions in mm; behind them the bar of the rule's degree, then the conclusions."""
MOST_COLUMNS = 4
BESIDE = 4.0
BAR = 3.2
BAR_AT = CONDITIONS + EDGE + 6.2
THEN_AT = 119.0
THEN = style.WIDTH - THEN_AT - EDGE
HIGH = 10.5
"""Height of a sketch in mm."""
GAUGE = 2.4
"""Height of the bar of a degree that has no sketch, in mm."""
GAP = 1.6
APART = 2.0
"""What lies at least between a label and what stands to the right of it, in mm."""
LABELS = 26.0
"""The label of a rule takes at most so much, in mm."""


@dataclass(frozen=True, slots=True)
class Columns:
    """How the sketches of all rows stand: their width in mm, lines of their labels, the column of a variable.

    `column_of` is empty where a rule takes a variable twice, or there are too
    many of them: the sketches then follow one another.
    """

    count: int
    lines: int
    column_of: dict[str, int]

    @property
    def width(self) -> float:
        """Width of a sketch in mm."""
        return (CONDITIONS - BESIDE * (self.count - 1)) / self.count

    def place(self, leaf: Leaf, index: int) -> tuple[int, int]:
        """Return row and column of a rule's subcondition number `index`."""
        if self.column_of:
            return 0, self.column_of[leaf.variable.casefold()]
        return divmod(index, self.count)


def rule_strips(view: View) -> list[Strip]:
    """Return the heading of the rules, and a strip for each that fired."""
    total = len(view.rules) + len(view.quiet)
    title = f"Aggregation and activation: {len(view.rules)} of {counted(total, 'rule')} fired"
    if len(view.rules) <= FULL:
        columns = _columns(view.rules)
        rows = [_full(view, rule, columns) for rule in view.rules]
        return [headline(title, _quiet(view.quiet)), *rows]
    weakest = sorted((rule.degree for rule in view.rules), reverse=True)[: LINES + 1]
    shown = list(view.rules)
    more = _quiet(view.quiet)
    if len(weakest) > LINES:
        order = sorted(range(len(shown)), key=lambda index: (-shown[index].degree, index))[:LINES]
        shown = [shown[index] for index in sorted(order)]
        left, most = counted(len(view.rules) - LINES, "rule"), number(weakest[-1])
        more = f"Shown are the {LINES} of the largest degrees; {left} more fired, by at most {most}."
    labels = min(max(lettering.text_width(one_line(rule.label), style.SMALL) for rule in shown) + 1.0, LABELS)
    return [headline(title, more), *(_brief(rule, labels) for rule in shown)]


def _quiet(labels: Sequence[str]) -> str:
    """Return which rules did not fire, where that is said in a line or two."""
    text = f"Did not fire: {joined([one_line(each) for each in labels])}."
    return text if labels and lettering.text_width(text, style.SMALL) < 1.9 * COLUMN else ""


def _columns(rules: Sequence[Fired]) -> Columns:
    """Return the columns: one for each variable where that is enough."""
    leaves = [leaf for rule in rules for leaf in rule.leaves]
    names = list(dict.fromkeys(leaf.variable.casefold() for leaf in leaves))
    once = all(len({leaf.variable.casefold() for leaf in rule.leaves}) == len(rule.leaves) for rule in rules)
    most = max((len(rule.leaves) for rule in rules), default=1)
    aligned = once and len(names) <= MOST_COLUMNS
    count = max(2, len(names) if aligned else min(most, MOST_COLUMNS))
    width = Columns(count, 1, {}).width
    texts = [(leaf.variable, leaf.predicate, number(leaf.degree), width) for leaf in leaves]
    texts += [
        (each.variable, f"IS {each.term}" if each.term else "", printed(activation_formula(each)), THEN)
        for rule in rules
        for each in rule.activated
    ]
    lines = max((_lines(*each) for each in texts), default=1)
    return Columns(count, lines, {name: at for at, name in enumerate(names)} if aligned else {})


def _lines(first: str, second: str, right: str, width: float) -> int:
    """Return the lines that a label and what stands to the right of it take: the latter has the last."""
    room = width / style.HINTED - lettering.text_width(right, style.SMALL)
    for count, last in ((1, f"{first} {second}"), (2, second)):
        own = lettering.text_width(one_line(last), style.SMALL)
        if (own + APART if own else 0.0) <= room:
            return count
    return 3


def _label(
    page: Axes, at: tuple[float, float], width: float, texts: tuple[str, str, str], lines: int
) -> None:
    """Write what a sketch shows, and to the right of it a degree or formula; on one line, two or three."""
    x, y = at
    first, second, right = texts
    whole = width / style.HINTED
    room = max(whole - lettering.text_width(right, style.SMALL) - APART, 4.0)
    below = y + LINE[style.SMALL] * (lines - 1)
    above = {1: [], 2: [first], 3: [first, second]}[lines]
    last = {1: f"{first} {second}".strip(), 2: second, 3: ""}[lines]
    for row, each in enumerate(above):
        write(
            page, (x, y + LINE[style.SMALL] * row), lettering.cut(each, whole, style.SMALL), size=style.SMALL
        )
    write(page, (x, below), lettering.cut(last, room, style.SMALL), size=style.SMALL)
    write(page, (x + width, below), right, size=style.SMALL, align="right")


def _full(view: View, rule: Fired, columns: Columns) -> Strip:
    label = lettering.cut(f"RULE {one_line(rule.label)}", LABELS)
    indent = lettering.text_width(label) + 3.0
    sentence = lettering.wrapped(rule.sentence, COLUMN - indent)
    rows = 1 + max((columns.place(leaf, index)[0] for index, leaf in enumerate(rule.leaves)), default=0)
    head = LINE[style.SMALL] * columns.lines + 0.6
    cell = head + HIGH
    drawn = [head + (GAUGE + 1.0 if view.output(each.variable) is None else HIGH) for each in rule.activated]
    starts = [sum(drawn[:index]) + index * GAP for index in range(len(drawn) + 1)]
    same = printed(rule.formula) == number(rule.degree)
    formula = "" if same else f"{printed(rule.formula)} = {number(rule.degree)}"
    formula = lettering.wrapped(formula, CONDITIONS) if formula else ""
    left = rows * (cell + GAP) + text_height(formula)
    height = text_height(sentence) + GAP + max(left, cell, starts[-1]) + 2.2

    def paint(figure: Figure, page: Axes, top: float) -> None:
        write(page, (0.0, top), label)
        write(page, (indent, top), sentence)
        y = top + text_height(sentence) + GAP
        for index, leaf in enumerate(rule.leaves):
            row, column = columns.place(leaf, index)
            corner = (EDGE + column * (columns.width + BESIDE), y + row * (cell + GAP))
            _condition(figure, page, corner, leaf, columns)
        write(page, (0.0, y + rows * (cell + GAP) - 0.6), formula)
        _degree(page, y + cell, rule.degree)
        for index, each in enumerate(rule.activated):
            _conclusion(figure, page, y + starts[index], (view, each), columns.lines)

    return Strip(height, paint)


def _condition(figure: Figure, page: Axes, corner: tuple[float, float], leaf: Leaf, columns: Columns) -> None:
    x, y = corner
    texts = (one_line(leaf.variable), one_line(leaf.predicate), number(leaf.degree))
    _label(page, corner, columns.width, texts, columns.lines)
    below = y + LINE[style.SMALL] * columns.lines + 0.6
    if leaf.input is None:
        draw_bar(page, (x, below + 1.0), (columns.width, GAUGE), leaf.degree)
        return
    axes = sketch(figure, (x, below), (columns.width, HIGH), leaf.input, f"condition {leaf.variable}")
    draw_taken(axes, leaf.input, leaf.term, leaf.degree, negated=leaf.negated)


def _degree(page: Axes, foot: float, degree: float) -> None:
    """Draw the bar of a rule's degree with a line from its level to the conclusions."""
    high = HIGH / TOP
    level = foot - high * degree
    write(
        page,
        (BAR_AT + BAR / 2.0, foot - HIGH - 0.6 - LINE[style.SMALL]),
        number(degree),
        size=style.SMALL,
        align="center",
    )
    draw_bar(page, (BAR_AT, foot - high), (BAR, high), degree)
    tip = THEN_AT - 0.8
    page.add(Line([BAR_AT + BAR + 0.6, tip - 1.0], [level, level], style.INK, 0.6, flat=True))
    page.add(Shape([tip, tip - 1.4, tip - 1.4], [level, level - 0.5, level + 0.5], style.INK))


def _conclusion(figure: Figure, page: Axes, y: float, what: tuple[View, Activated], lines: int) -> None:
    view, each = what
    predicate = f"IS {one_line(each.term)}" if each.term else ""
    texts = (one_line(each.variable), predicate, printed(activation_formula(each)))
    _label(page, (THEN_AT, y), THEN, texts, lines)
    below = y + LINE[style.SMALL] * lines + 0.6
    shown = view.output(each.variable)
    if shown is None:
        draw_bar(page, (THEN_AT, below + 1.0), (THEN, GAUGE), each.degree)
    else:
        axes = sketch(
            figure, (THEN_AT, below), (THEN, HIGH), shown, f"conclusion {each.rule} {each.variable}"
        )
        draw_activated(axes, shown, each)


FORMULA_AT, FORMULA = 92.0, 41.0
BRIEF_BAR = 16.0


def _brief(rule: Fired, labels: float) -> Strip:
    """Return a rule in text: its sentence, its formula and weights, a bar of its degree.

    `labels` is the width of the column of the labels in mm.
    """
    weighted = [
        f"{one_line(each.variable)}: {printed(activation_formula(each))}"
        for each in rule.activated
        if each.weight != 1.0
    ]
    formula = "" if printed(rule.formula) == number(rule.degree) else printed(rule.formula)
    parts = [lettering.wrapped(each, FORMULA, style.SMALL) for each in [formula, *weighted] if each]
    formulas = "\n".join(parts)
    sentence = lettering.wrapped(rule.sentence, FORMULA_AT - labels - 5.0, style.SMALL)
    label = lettering.cut(one_line(rule.label), labels, style.SMALL)
    height = max(text_height(each, style.SMALL) for each in (sentence, formulas, " ")) + 1.2
    return Strip(height, partial(_paint_brief, rule=rule, texts=(label, sentence, formulas), labels=labels))


def _paint_brief(
    _: Figure, page: Axes, top: float, *, rule: Fired, texts: tuple[str, str, str], labels: float
) -> None:
    for x, text in zip((0.0, labels + 3.0, FORMULA_AT), texts, strict=True):
        write(page, (x, top), text, size=style.SMALL)
    bar = style.WIDTH - BRIEF_BAR - EDGE
    write(page, (bar - 1.5, top), number(rule.degree), size=style.SMALL, align="right")
    draw_bar(page, (bar, top + 0.4), (BRIEF_BAR, LINE[style.SMALL] - 0.8), rule.degree)
