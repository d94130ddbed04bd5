"""Conditions → the model (5.2.4, S27 to S29)."""

from collections.abc import Sequence

from fcl_sim.fcl import tree
from fcl_sim.fcl.findings import Spanned
from fcl_sim.fcl.scope import Declared, Role, Scope, Terms
from fcl_sim.fcl.tokens import Kind, Token
from fcl_sim.model import And, Condition, Degree, Hedge, Is, Not, Or


def resolve_condition(scope: Scope, condition: tree.Condition) -> Condition | None:
    """Return a condition, None where one of its names means nothing.

    Calls itself as deep as parentheses are nested, which the parser bounds.
    """
    match condition:
        case tree.Is():
            return _is(scope, condition)
        case Token():
            return _degree(scope, condition)
        case tree.Group() | tree.Not():
            argument = resolve_condition(scope, condition.argument)
            return argument and (Not(argument) if isinstance(condition, tree.Not) else argument)
        case tree.And() | tree.Or():
            return _joined(scope, condition)
        case tree.Member():
            return _member(scope, condition.structure, condition.member)


def nesting_depth(condition: tree.Condition) -> int:
    """Return how deep parentheses are nested in a condition; it calls itself as `resolve_condition` does."""
    match condition:
        case tree.Group():
            return 1 + nesting_depth(condition.argument)
        case tree.Not():
            return nesting_depth(condition.argument)
        case tree.And() | tree.Or():
            return max((nesting_depth(each) for each in condition.arguments), default=0)
    return 0


def _joined(scope: Scope, condition: tree.And | tree.Or) -> Condition | None:
    """Return a condition of several, None where one of them is missing; all of them are looked at."""
    resolved = [resolve_condition(scope, each) for each in condition.arguments]
    arguments = tuple(each for each in resolved if each is not None)
    if len(arguments) < len(resolved):
        return None
    return And(arguments) if isinstance(condition, tree.And) else Or(arguments)


def _is(scope: Scope, condition: tree.Is) -> Condition | None:
    if _is_swapped(scope, condition):
        return None
    if condition.variable.key in scope.instances:
        return _is_member(scope, condition)
    declared = scope.find(condition.variable)
    if declared is None:
        return None
    terms = scope.terms.get(declared.token.key)
    if terms is None:
        if not scope.headless:
            _report_without_terms(scope, declared, condition.variable)
        return None
    hedges = _hedges(condition, terms)
    term = "" if len(hedges) > len(condition.hedges) else scope.find_term(declared, terms, condition.term)
    if declared.role is Role.OUTPUT and _is_concluded(scope, declared, condition.variable):
        message = f"`{declared.name}` is an output: what the rules above have accumulated counts here"
        scope.findings.warning("FCL351", message, condition)
    if term is None:
        return None
    kinds = resolve_hedges(scope, hedges, condition)
    found = Is(declared.name, term, scope.findings.span(condition), hedges=kinds)
    return found if condition.negation is None else Not(found)


def _is_swapped(scope: Scope, condition: tree.Is) -> bool:
    """Report `term IS variable` as what it is."""
    variable = scope.variables.get(condition.term.key)
    terms = scope.terms.get(condition.term.key)
    if condition.variable.key in scope.variables or variable is None or terms is None:
        return False
    if condition.variable.key not in terms.names:
        return False
    scope.findings.error(
        "FCL353",
        f"{condition.variable.shown} is a term and `{variable.name}` its variable: they have changed places",
        condition,
        hint=f"write `{variable.name} IS {condition.variable.text}`",
    )
    return True


def _report_without_terms(scope: Scope, declared: Declared, at: Token) -> None:
    name = declared.name
    if declared.role is Role.INPUT:
        message = f"`{name}` has no FUZZIFY, so that it has no terms"
        hint = f"write FUZZIFY {name} … END_FUZZIFY; without IS, `{name}` is taken as a degree"
    elif declared.role is Role.OUTPUT:
        message, hint = f"`{name}` has no DEFUZZIFY, so that it has no terms", ""
    else:
        message = f"`{name}` is a local variable and has no terms"
        hint = f"without IS, `{name}` is the degree that the rules above have concluded"
    scope.findings.error("FCL311", message, at, hint)


def _degree(scope: Scope, token: Token) -> Condition | None:
    declared = scope.find(token)
    if declared is None:
        return None
    name = declared.name
    has_terms = token.key in scope.terms
    if declared.role is Role.INPUT:
        if has_terms:
            message = f"`{name}` has terms but stands here without IS: its value is taken as a degree"
            scope.findings.warning("FCL349", message, token)
    elif has_terms:
        message = f"`{name}` is a number and not a degree of membership"
        scope.findings.error("FCL350", message, token, hint=f"write `{name} IS …`")
        return None
    else:
        _is_concluded(scope, declared, token)
    return Degree(name, scope.findings.span(token))


def _is_concluded(scope: Scope, declared: Declared, at: Token) -> bool:
    """Return whether a rule above concludes: rules are evaluated in the order of the text (S27a, S29)."""
    if declared.token.key in scope.concluded:
        return True
    message = f"`{declared.name}` is used before a rule has concluded on it"
    scope.findings.error("FCL348", message, at, hint="rules are evaluated in the order of the text")
    return False


def _hedges(condition: tree.Is, terms: Terms) -> tuple[Token, ...]:
    """Return the hedges; ANY in the place of a term is one unless a term is called so (S1a)."""
    stands_alone = condition.term.key == "ANY" and "ANY" not in terms.names
    return (*condition.hedges, condition.term) if stands_alone else condition.hedges


def resolve_hedges(scope: Scope, hedges: Sequence[Token], part: Spanned) -> tuple[Hedge, ...]:
    """Return hedges, and note them on the subcondition or subconclusion that has them."""
    if hedges:
        words = " ".join(each.text for each in hedges)
        scope.findings.feature("hedge", f"the hedge{'' if len(hedges) == 1 else 's'} {words}", part)
    return tuple(Hedge(each.key.lower()) for each in hedges)


# -- members of structures


def _is_member(scope: Scope, condition: tree.Is) -> Condition | None:
    """Return `structure IS member` as the degree that the member holds (S7)."""
    if condition.hedges:
        message = f"{condition.variable.shown} is a structure, and its members have no hedges"
        scope.findings.error("FCL309", message, condition)
        return None
    found = _member(scope, condition.variable, condition.term)
    return Not(found) if found is not None and condition.negation is not None else found


def _member(scope: Scope, structure: Token, member: Token) -> Condition | None:
    """Return a member of a structure, which holds a degree (S7)."""
    if structure.key not in scope.instances:
        declared = scope.find(structure)
        if declared is not None:
            message = f"`{declared.name}` is not a structure"
            scope.findings.error("FCL309", message, structure, hint="compare with a term by IS")
        return None
    text = f"{structure.text}.{member.text}"
    scope.findings.feature("structure", f"`{text}`", member)
    return _degree(scope, Token(Kind.NAME, text, text.upper(), structure.start))
