"""FUZZIFY and DEFUZZIFY → the model (5.2.2, 5.2.3)."""

from collections.abc import Mapping

from fcl_sim.fcl.resolve_settings import (
    ACCUMULATIONS,
    METHODS,
    algorithm,
    default_of,
    enabled,
    locks,
    range_of,
    settings_by_key,
)
from fcl_sim.fcl.resolve_terms import resolve_terms
from fcl_sim.fcl.scope import Declared, Role, Scope, Terms
from fcl_sim.fcl.tokens import Token
from fcl_sim.fcl.tree import Defuzzify, Fuzzify, Range, Setting
from fcl_sim.model import (
    Curve,
    Defuzzification,
    Formula,
    Fuzzification,
    Method,
    Points,
    Singleton,
    Singletons,
)
from fcl_sim.model import Term as ModelTerm


def resolve_fuzzify(scope: Scope, section: Fuzzify) -> Fuzzification | None:
    """Return the terms of an input, None where it is not clear of which."""
    declared = _owner(scope, section, Role.INPUT)
    terms = Terms(owner=section.variable, damaged=section.damaged)
    resolved = resolve_terms(scope, terms, section.terms, output=False)
    _enter(scope, section, declared, terms)
    settings = settings_by_key(scope, section.settings)
    limits = _range(scope, settings)
    locked = locks(scope, settings.get("LOCK"))
    counts = enabled(scope, settings.get("ENABLED"))
    if declared is None or section.variable is None:
        return None
    if limits is not None:
        scope.findings.feature("range", f"a range for `{declared.name}`", section.variable)
        scope.ranges[declared.token.key] = limits
    _require_terms(scope, section)
    span = scope.findings.span(section.variable)
    clamped = "RANGE" in locked
    return Fuzzification(declared.name, resolved, span, enabled=counts, clamped=clamped)


def resolve_defuzzify(scope: Scope, section: Defuzzify) -> Defuzzification | None:
    """Return the terms of an output and how it becomes a number, None where it is not clear of which."""
    declared = _owner(scope, section, Role.OUTPUT)
    terms = Terms(owner=section.variable, damaged=section.damaged)
    resolved = resolve_terms(scope, terms, section.terms, output=True)
    _enter(scope, section, declared, terms)
    settings = settings_by_key(scope, section.settings)
    limits = _range(scope, settings, bounds=_areas(resolved))
    method = _method(scope, section, settings.get("METHOD"), resolved)
    default, held = _default(scope, section, settings)
    locked = locks(scope, settings.get("LOCK"))
    counts = enabled(scope, settings.get("ENABLED"))
    accumulation = algorithm(scope, settings.get("ACCU"), ACCUMULATIONS)
    has_range = "RANGE" in settings or (declared is not None and declared.variable.range is not None)
    if not (has_range or section.damaged) and _areas(resolved):
        message = (
            f"{_title(section)} has terms with an area but no RANGE: "
            "the stretch from their first to their last point is taken"
        )
        hint = "write `RANGE := (minimum .. maximum);`"
        scope.findings.warning("FCL336", message, section.variable or section.opening, hint)
    if declared is None or section.variable is None:
        return None
    _require_terms(scope, section)
    if accumulation is not None:
        scope.findings.feature("accumulation", f"ACCU of `{declared.name}`", settings["ACCU"].keyword)
    return Defuzzification(
        variable=declared.name,
        terms=resolved,
        method=method,
        default=default,
        range=limits if limits is not None else declared.variable.range,
        accumulation=accumulation,
        held=held or "PREVIOUS" in locked,
        clamped="RANGE" in locked,
        enabled=counts,
        span=scope.findings.span(section.variable),
    )


# -- whose terms


def _owner(scope: Scope, section: Fuzzify | Defuzzify, role: Role) -> Declared | None:
    """Return the variable whose terms a section gives."""
    if section.variable is None:
        scope.headless = True
        return None
    declared = scope.find(section.variable)
    if declared is None or declared.role is not role:
        scope.headless = True
    if declared is not None and declared.role is not role:
        what = "an input" if role is Role.INPUT else "an output"
        section_name = declared.role.value
        scope.findings.error(
            "FCL312" if role is Role.INPUT else "FCL313",
            f"{section.opening.key} is for {what}, and `{declared.name}` is declared in {section_name}",
            section.variable,
            hint="the terms of an output stand in its DEFUZZIFY" if declared.role is Role.OUTPUT else "",
            related=(scope.findings.place(declared.token, "declared here"),),
        )
        return None
    return declared


def _enter(scope: Scope, section: Fuzzify | Defuzzify, declared: Declared | None, terms: Terms) -> None:
    if declared is None or section.variable is None:
        return
    first = scope.terms.setdefault(declared.token.key, terms)
    if first is not terms:
        message = f"`{declared.name}` has a second {section.opening.key}"
        scope.report_twice("FCL315", message, section.variable, first.owner or section.variable)
        first.names |= terms.names
        first.damaged = first.damaged or terms.damaged


def _require_terms(scope: Scope, section: Fuzzify | Defuzzify) -> None:
    if not section.terms and not section.damaged:
        at = section.variable or section.opening
        scope.findings.warning("FCL320", f"{_title(section)} has no TERM", at)


def _title(section: Fuzzify | Defuzzify) -> str:
    return f"{section.opening.key} {section.variable.text}" if section.variable else section.opening.key


# -- how an output becomes a number


def _method(
    scope: Scope, section: Defuzzify, setting: Setting | None, terms: tuple[ModelTerm, ...]
) -> Method:
    areas, singletons = _areas(terms), _singletons(terms)
    fitting = Method.COGS if singletons and not areas else Method.COG
    if areas and singletons:
        scope.findings.error(
            "FCL332",
            f"{_title(section)} mixes singletons with terms that have an area",
            section.variable or section.opening,
            hint="give every term points, or every term a single value",
        )
        return fitting
    if setting is None:
        if terms and not section.damaged:
            reason = "all terms are singletons" if fitting is Method.COGS else "the terms have an area"
            scope.findings.warning(
                "FCL334",
                f"{_title(section)} has no METHOD: {fitting} is taken, since {reason}",
                section.variable or section.opening,
                hint=f"write `METHOD: {fitting};`",
            )
        return fitting
    chosen = algorithm(scope, setting, METHODS)
    if chosen is None or not terms:
        return fitting
    return _suited(scope, setting, chosen, fitting)


def _suited(scope: Scope, setting: Setting, chosen: Method, fitting: Method) -> Method:
    """Refuse a method that the terms do not allow (S35)."""
    at = setting.value or setting.keyword
    if chosen is Method.COG and fitting is Method.COGS:
        scope.findings.note("FCL338", "CoG of singletons alone is CoGS: CoGS is computed", at)
        return Method.COGS
    if chosen is Method.COA and fitting is Method.COGS:
        message = "CoA is not applicable to singletons (Table 1, note 3)"
        scope.findings.error("FCL331", message, at, hint="CoGS, LM and RM are")
    elif chosen in {Method.COGS, Method.SUM} and fitting is Method.COG:
        written = at.text if isinstance(at, Token) else chosen
        message = f"{written} is a method for singletons, and these terms have an area"
        scope.findings.error("FCL331", message, at, hint="CoG, CoA, LM and RM are for areas")
    return chosen


def _areas(terms: tuple[ModelTerm, ...]) -> bool:
    return any(isinstance(each.shape, Points | Curve) for each in terms)


def _singletons(terms: tuple[ModelTerm, ...]) -> bool:
    return any(isinstance(each.shape, Singleton | Singletons | Formula) for each in terms)


def _default(scope: Scope, section: Defuzzify, settings: Mapping[str, Setting]) -> tuple[float | None, bool]:
    if "DEFAULT" not in settings and not section.damaged:
        message = f"{_title(section)} has no DEFAULT: the output keeps its value while no rule is active (NC)"
        hint = "write `DEFAULT := NC;` or a number"
        scope.findings.warning("FCL335", message, section.variable or section.opening, hint)
    return default_of(scope, settings.get("DEFAULT"))


def _range(
    scope: Scope, settings: Mapping[str, Setting], *, bounds: bool = False
) -> tuple[float, float] | None:
    value = settings["RANGE"].value if "RANGE" in settings else None
    return range_of(scope, value, bounds=bounds) if isinstance(value, Range) else None
