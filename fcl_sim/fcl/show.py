"""The product of each stage as plain text: what the reader took a text for."""

from collections.abc import Iterator

from fcl_sim.diagnostics import Source
from fcl_sim.fcl import tree
from fcl_sim.fcl.findings import Spanned
from fcl_sim.fcl.tokens import Comment, Scan, Token
from fcl_sim.model import (
    And,
    Call,
    Condition,
    Curve,
    Degree,
    Expression,
    Formula,
    FunctionBlock,
    Is,
    Not,
    Number,
    Operation,
    Or,
    Points,
    Reference,
    Rule,
    RuleBlock,
    Shape,
    Singleton,
    Singletons,
    Term,
)

STEP = "  "


# -- tokens


def show_tokens(scan: Scan) -> str:
    """Return one line for each token and comment: line, column, kind, text."""
    words: list[Token | Comment] = [*scan.tokens, *scan.comments]
    lines = []
    for word in sorted(words, key=lambda each: each.start):
        kind = "comment" if isinstance(word, Comment) else word.kind.value
        line = scan.source.line_of(word.start)
        column = word.start - scan.source.line_starts[line - 1] + 1
        text = word.text if word.text.isprintable() else repr(word.text)
        lines.append(f"{f'{line}:{column}':<8} {kind:<8} {text}".rstrip())
    return "\n".join(lines)


# -- tree


def show_tree(syntax: tree.Tree) -> str:
    """Return the syntax tree, one part a line, each below what holds it."""
    lines = []
    for block in syntax.blocks:
        lines.append(f"FUNCTION_BLOCK {block.heading.text if block.heading else '(no name)'}")
        for section in block.sections:
            lines += [STEP + line for line in _section(syntax.source, section)]
    return "\n".join(lines)


def _section(source: Source, section: tree.Section) -> Iterator[str]:
    match section:
        case tree.Declarations():
            yield section.opening.key
            for each in section.variables:
                initial = f" := {_words(source, each.initial)}" if each.initial else ""
                limits = f" RANGE {_words(source, each.range)}" if each.range else ""
                yield f"{STEP}{each.name.text}: {_type(each)}{initial}{limits}"
        case tree.Structures():
            for structure in section.structures:
                yield from _structure(structure)
        case tree.Fuzzify() | tree.Defuzzify():
            yield f"{section.opening.key} {section.variable.text if section.variable else '?'}"
            for term in section.terms:
                yield f"{STEP}TERM {term.name.text} := {_shape(source, term.shape)}"
            yield from _settings(source, section.settings)
        case tree.RuleBlock():
            yield f"RULEBLOCK {section.name.text if section.name else '(no name)'}"
            yield from _settings(source, section.settings)
            for rule in section.rules:
                yield f"{STEP}RULE {rule.label}"
                yield from (STEP * 2 + line for line in _rule(source, rule))
        case tree.Options():
            yield f"OPTIONS, {len(section.text)} characters"


def _type(declaration: tree.Declaration) -> str:
    if isinstance(declaration.type, tree.Structure):
        return "STRUCT"
    return declaration.type.text if declaration.type else "?"


def _structure(structure: tree.Structure) -> Iterator[str]:
    yield f"STRUCT {structure.name.text if structure.name else '(no name)'}"
    for each in structure.members:
        yield f"{STEP}{each.name.text}: {_type(each)}"


def _words(source: Source, part: Spanned) -> str:
    """Return a part of the text as it is written, on one line."""
    return " ".join(source.text[part.start : part.end].split())


def _shape(source: Source, shape: tree.Shape | None) -> str:
    if shape is None:
        return "?"
    parts = shape if isinstance(shape, tuple) else (shape,)
    return " ".join(_words(source, each) for each in parts)


def _settings(source: Source, settings: tuple[tree.Setting, ...]) -> Iterator[str]:
    for each in settings:
        yield f"{STEP}{each.key}: {_words(source, each.value) if each.value else '?'}"


def _rule(source: Source, rule: tree.Rule) -> Iterator[str]:
    yield "IF"
    yield from (STEP + line for line in _condition(rule.condition))
    yield "THEN"
    for each in rule.conclusions:
        words = ["IS", *(word.text for word in each.hedges), each.term.text] if each.term else []
        term = "".join(f" {word}" for word in words)
        weight = f" WITH {_words(source, each.weight)}" if each.weight else ""
        yield f"{STEP}{each.variable.text}{term}{weight}"


def _condition(condition: tree.Condition) -> Iterator[str]:
    match condition:
        case tree.Is():
            words = [condition.negation, *condition.hedges, condition.term]
            yield " ".join([condition.variable.text, "IS", *(each.text for each in words if each)])
        case Token():
            yield condition.text
        case tree.Member():
            yield f"{condition.structure.text}.{condition.member.text}"
        case tree.Not() | tree.Group():
            yield "NOT" if isinstance(condition, tree.Not) else "( )"
            yield from (STEP + line for line in _condition(condition.argument))
        case tree.And() | tree.Or():
            yield "AND" if isinstance(condition, tree.And) else "OR"
            for each in condition.arguments:
                yield from (STEP + line for line in _condition(each))


# -- model


def show_model(block: FunctionBlock) -> str:
    """Return a function block with every choice made, those that the text leaves open included."""
    return "\n".join(_model(block))


def _model(block: FunctionBlock) -> Iterator[str]:
    yield f"FUNCTION_BLOCK {block.name}"
    sections = (("VAR_INPUT", block.inputs), ("VAR_OUTPUT", block.outputs), ("VAR", block.variables))
    for section, variables in sections:
        for each in variables:
            initial = "" if each.initial is None else f" := {each.initial:g}"
            yield f"{STEP}{section} {each.name}: {each.type}{initial}"
    for fuzzification in block.fuzzifications:
        yield f"{STEP}FUZZIFY {fuzzification.variable}"
        yield from _terms(fuzzification.terms)
    for output in block.defuzzifications:
        limits = "none" if output.range is None else f"{output.range[0]:g} .. {output.range[1]:g}"
        default = "NC" if output.default is None else f"{output.default:g}"
        yield f"{STEP}DEFUZZIFY {output.variable}: METHOD {output.method}, DEFAULT {default}, RANGE {limits}"
        yield from _terms(output.terms)
    for rule_block in block.rule_blocks:
        yield from (STEP + line for line in _rule_block(rule_block))


def _terms(terms: tuple[Term, ...]) -> Iterator[str]:
    for term in terms:
        yield f"{STEP * 2}TERM {term.name} := {_model_shape(term.shape)}"


def _model_shape(shape: Shape) -> str:
    match shape:
        case Points():
            return " ".join(f"({_number(each.x)}, {each.degree:g})" for each in shape.points)
        case Singletons():
            points = " ".join(f"({_number(each.x)}, {each.degree:g})" for each in shape.points)
            return f"SINGLETONS {points}"
        case Singleton():
            return _number(shape.value)
        case Curve():
            height = "" if shape.height == 1.0 else f", height {shape.height:g}"
            return f"{shape.kind} {' '.join(_number(each) for each in shape.parameters)}{height}"
        case Formula():
            return f"FUNCTION {_expression(shape.expression)}"


def _expression(expression: Expression) -> str:
    """Return an expression with every pair of parentheses that shows what belongs together."""
    match expression:
        case Number():
            return _number(expression.value)
        case Reference():
            return expression.variable
        case Call():
            return f"{expression.function}({', '.join(_expression(each) for each in expression.arguments)})"
        case Operation():
            parts = [
                f"({_expression(each)})" if isinstance(each, Operation) else _expression(each)
                for each in expression.arguments
            ]
            if len(parts) == 1:
                return f"{expression.operator}{parts[0]}"
            return f" {expression.operator} ".join(parts)


def _number(value: float | str) -> str:
    return value if isinstance(value, str) else f"{value:.12g}"


def _rule_block(block: RuleBlock) -> Iterator[str]:
    yield (
        f"RULEBLOCK {block.name}: AND {block.and_operator}, OR {block.or_operator}, "
        f"ACT {block.activation}, ACCU {block.accumulation}"
    )
    for rule in block.rules:
        yield f"{STEP}RULE {rule.label}: IF {_plain(rule.condition)} THEN {_conclusions(rule)}"


def _conclusions(rule: Rule) -> str:
    parts = []
    for each in rule.conclusions:
        term = "" if each.term is None else f" {' '.join(('IS', *each.hedges, each.term))}"
        weight = "" if each.weight == 1.0 else f" WITH {_number(each.weight)}"
        parts.append(f"{each.variable}{term}{weight}")
    return ", ".join(parts)


def _plain(condition: Condition) -> str:
    """Return a condition on one line, with every pair of parentheses that shows what belongs together."""
    match condition:
        case Is():
            return " ".join((condition.variable, "IS", *condition.hedges, condition.term)).rstrip()
        case Degree():
            return condition.variable
        case Not():
            return f"NOT {_inner(condition.argument)}"
        case And():
            return " AND ".join(_inner(each) for each in condition.arguments)
        case Or():
            return " OR ".join(_inner(each) for each in condition.arguments)


def _inner(condition: Condition) -> str:
    return f"({_plain(condition)})" if isinstance(condition, And | Or) else _plain(condition)
