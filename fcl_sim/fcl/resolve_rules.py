"""Rule blocks → the model (5.2.4)."""

from collections.abc import Mapping, Sequence

from fcl_sim.fcl.findings import Stretch
from fcl_sim.fcl.resolve_conditions import nesting_depth, resolve_condition, resolve_hedges
from fcl_sim.fcl.resolve_settings import (
    ACCUMULATIONS,
    ACTIVATIONS,
    AND_OPERATORS,
    OR_OPERATORS,
    PAIRS,
    algorithm,
    enabled,
    settings_by_key,
)
from fcl_sim.fcl.scope import Declared, Role, Scope
from fcl_sim.fcl.tokens import Token
from fcl_sim.fcl.tree import Conclusion, Rule, RuleBlock, Setting, Value
from fcl_sim.model import Accumulation, Activation, AndOperator, OrOperator
from fcl_sim.model import Conclusion as ModelConclusion
from fcl_sim.model import Rule as ModelRule
from fcl_sim.model import RuleBlock as ModelRuleBlock

_PAIRS_OF_OR = {other: one for one, other in PAIRS.items()}


def resolve_rule_block(scope: Scope, section: RuleBlock, name: str) -> ModelRuleBlock:
    """Return a rule block called `name` with the rules that can be used."""
    settings = settings_by_key(scope, section.settings)
    and_operator, or_operator = _operators(scope, settings)
    activation = algorithm(scope, settings.get("ACT"), ACTIVATIONS) or Activation.MIN
    accumulation = algorithm(scope, settings.get("ACCU"), ACCUMULATIONS) or Accumulation.MAX
    _check_labels(scope, section.rules)
    resolved = [resolve_rule(scope, each) for each in section.rules]
    return ModelRuleBlock(
        name=name,
        and_operator=and_operator,
        or_operator=or_operator,
        activation=activation,
        accumulation=accumulation,
        enabled=enabled(scope, settings.get("ENABLED")),
        rules=tuple(each for each in resolved if each is not None),
        span=scope.findings.span(section.name or section.opening),
    )


def resolve_rule(scope: Scope, rule: Rule) -> ModelRule | None:
    """Return a rule, None where one of its names means nothing."""
    condition = resolve_condition(scope, rule.condition)
    conclusions = [_conclusion(scope, each) for each in rule.conclusions]
    _note_weight(scope, rule.conclusions)
    resolved = tuple(each for each in conclusions if each is not None)
    if condition is None or len(resolved) < len(conclusions):
        return None
    nesting = nesting_depth(rule.condition)
    return ModelRule(rule.label, condition, resolved, scope.findings.span(rule), nesting=nesting)


def _operators(scope: Scope, settings: Mapping[str, Setting]) -> tuple[AndOperator, OrOperator]:
    """Return the pair; a missing one is the pair of the other (S10)."""
    and_setting, or_setting = settings.get("AND"), settings.get("OR")
    chosen_and = algorithm(scope, and_setting, AND_OPERATORS)
    chosen_or = algorithm(scope, or_setting, OR_OPERATORS)
    and_operator = chosen_and or (_PAIRS_OF_OR[chosen_or] if chosen_or else AndOperator.MIN)
    or_operator = chosen_or or PAIRS[and_operator]
    if chosen_and and chosen_or and and_setting and PAIRS[chosen_and] is not chosen_or:
        scope.findings.warning(
            "FCL342",
            f"AND by {chosen_and} and OR by {chosen_or} are no pair: de Morgan's law does not hold",
            and_setting.keyword,
            hint=f"the pair of {chosen_and} is {PAIRS[chosen_and]} (Table 3)",
        )
    return and_operator, or_operator


def _check_labels(scope: Scope, rules: Sequence[Rule]) -> None:
    seen: dict[str, Rule] = {}
    for rule in rules:
        first = seen.setdefault(rule.label.upper(), rule)
        if first is not rule:
            scope.findings.warning(
                "FCL340",
                f"another rule of this block has the label {rule.label}: both count",
                Stretch(rule.start, rule.heading_end),
                related=(scope.findings.place(Stretch(first.start, first.heading_end), "first here"),),
            )


# -- conclusions


def _conclusion(scope: Scope, conclusion: Conclusion) -> ModelConclusion | None:
    weight = _weight(scope, conclusion.weight)
    declared = scope.find(conclusion.variable)
    if declared is None:
        return None
    if declared.role is Role.INPUT:
        message = f"`{declared.name}` is an input: rules conclude on outputs and local variables"
        scope.findings.error("FCL346", message, conclusion.variable)
        return None
    scope.concluded.add(declared.token.key)
    term = None
    if conclusion.term is not None:
        term = _concluded_term(scope, declared, conclusion, conclusion.term)
        if term is None:
            return None
    elif declared.token.key in scope.terms:
        message = f"this conclusion does not say which term of `{declared.name}` follows"
        scope.findings.error("FCL347", message, conclusion, hint=f"write `{declared.name} IS …`")
        return None
    if weight is None:
        return None
    hedges = resolve_hedges(scope, conclusion.hedges, conclusion)
    return ModelConclusion(declared.name, term, weight, scope.findings.span(conclusion), hedges=hedges)


def _concluded_term(scope: Scope, declared: Declared, conclusion: Conclusion, term: Token) -> str | None:
    terms = scope.terms.get(declared.token.key)
    if terms is not None:
        return scope.find_term(declared, terms, term)
    if not scope.headless:
        if declared.role is Role.OUTPUT:
            message = f"`{declared.name}` has no DEFUZZIFY: it has no terms and cannot become a number"
            hint = f"write DEFUZZIFY {declared.name} … END_DEFUZZIFY"
        else:
            message = f"`{declared.name}` is a local variable and has no terms"
            hint = f"conclude on it without IS: `THEN {declared.name}`"
        scope.findings.error("FCL345", message, conclusion.variable, hint)
    return None


def _weight(scope: Scope, weight: Value | None) -> float | str | None:
    if weight is None:
        return 1.0
    if isinstance(weight, Token):
        return scope.find_input(weight, "a weighting factor")
    if 0.0 <= weight.value <= 1.0:
        return weight.value
    message = f"the weighting factor `{scope.findings.span(weight).text}` is not between 0 and 1"
    scope.findings.error("FCL343", message, weight)
    return None


def _note_weight(scope: Scope, conclusions: Sequence[Conclusion]) -> None:
    """Say whose weight it is where one could take it for the whole rule's (S12)."""
    *others, last = conclusions
    if others and last.weight is not None and all(each.weight is None for each in others):
        message = "this WITH weights the last conclusion alone"
        scope.findings.note(
            "FCL344", message, last, hint="repeat it behind each conclusion that it is meant for"
        )
