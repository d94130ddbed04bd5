"""Waivers: what may stay as it is, with the reason and the date; files in TOML → waivers.

They stand beside a rule base, `crane.waivers.toml` beside `crane.fcl`, or for
several in `waivers.toml` of the bench, where each names its rule base:

    [[waive]]
    what   = "fired"
    rule   = "23"
    reason = "reached only by pushing the load by hand"
    date   = 2026-03-01
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from datetime import date, datetime
from pathlib import Path

from fcl_sim.diagnostics import Diagnostic, InputFault, Severity, Source, Span, nearest
from fcl_sim.diagnostics.codes import CODES
from fcl_sim.diagnostics.spelling import listed
from fcl_sim.toml import Entry, finding, parse

ENDING = ".waivers.toml"
OF_BENCH = "waivers.toml"
TABLE = "waive"
NEEDED = ("what", "rule", "reason", "date")
KEYS = ("rule_base", *NEEDED)


@dataclass(frozen=True, slots=True, kw_only=True)
class Waiver:
    """What is waived: an item of coverage or the code of a finding, of a rule of a rule base.

    `rule` is empty for a code that is about no rule; `span` is where it is named.
    """

    rule_base: Path
    what: str
    rule: str
    reason: str
    date: date
    span: Span = field(compare=False, repr=False)


def waivers_of(rule_base: Path, bench: Path, items: Sequence[str]) -> tuple[Waiver, ...]:
    """Return the waivers of a rule base, those beside it before those of the bench.

    `items` is what can be waived besides the codes of findings. InputFault with
    every fault of both files.
    """
    own = rule_base.with_suffix(ENDING)
    found: list[Waiver] = []
    faults: list[Diagnostic] = []
    for file, beside in ((own, rule_base), (bench / OF_BENCH, None)):
        if file.is_file():
            waivers, mistakes = _read(file, beside, items)
            found += waivers
            faults += mistakes
    if faults:
        raise InputFault(faults)
    return tuple(each for each in found if _same(each.rule_base, rule_base))


def unknown_rules(waivers: Iterable[Waiver], labels: Sequence[str]) -> Iterator[Diagnostic]:
    """Yield a finding for each waiver of a rule that is not among the labels of its rule base."""
    known = {each.casefold() for each in labels}
    for each in waivers:
        if each.rule and each.rule.casefold() not in known:
            near = nearest(each.rule, labels)
            hint = f"did you mean `{near}`?" if near else f"there is {listed(labels)}"
            yield finding("VER105", f"{each.rule_base.name} has no rule `{each.rule}`", each.span, hint)


def unused(waiver: Waiver, because: str) -> Diagnostic:
    """Return the finding that a waiver waives nothing."""
    from_here = finding("VER107", f"the waiver is not used: {because}", waiver.span, "remove it")
    return Diagnostic(
        code=from_here.code,
        message=from_here.message,
        severity=Severity.WARNING,
        places=from_here.places,
        hint=from_here.hint,
    )


def _same(one: Path, other: Path) -> bool:
    return one.absolute().resolve() == other.absolute().resolve()


def _read(file: Path, rule_base: Path | None, items: Sequence[str]) -> tuple[list[Waiver], list[Diagnostic]]:
    try:
        source = Source(file.as_posix(), file.read_text("utf-8-sig"))
        tree = parse(source, not_toml="VER102", twice="VER102")
    except UnicodeDecodeError:
        return [], list(
            InputFault.at_file("VER101", file.as_posix(), "the file is not UTF-8 text").diagnostics
        )
    except InputFault as fault:
        return [], list(fault.diagnostics)
    faults = [
        finding("VER103", f"`{key}` is no key of a file of waivers", each.key, "write [[waive]] for each")
        for key, each in tree.table.items()
        if key != TABLE or not each.items
    ]
    waivers = []
    entry = tree.get(TABLE)
    for each in entry.items if entry else ():
        mistakes = list(_mistakes(each, file, rule_base, items))
        faults += mistakes
        if not mistakes:
            waivers.append(_waiver(each, file, rule_base))
    return waivers, faults


def _waiver(entry: Entry, file: Path, rule_base: Path | None) -> Waiver:
    given = entry.plain()
    named = entry.table["rule"] if "rule" in entry.table else entry.table["what"]
    return Waiver(
        rule_base=rule_base or file.parent / given["rule_base"],
        what=given["what"],
        rule=given.get("rule", ""),
        reason=" ".join(given["reason"].split()),
        date=given["date"],
        span=named.span,
    )


def _mistakes(entry: Entry, file: Path, rule_base: Path | None, items: Sequence[str]) -> Iterator[Diagnostic]:
    """Yield what is wrong with a waiver, each fault once."""
    what = entry.get("what")
    of_code = what is not None and what.value in CODES
    needed = [each for each in NEEDED if not (each == "rule" and of_code)]
    if rule_base is None:
        needed.append("rule_base")
    for key in needed:
        if key not in entry.table:
            yield finding("VER103", f"the waiver has no `{key}`", entry.key, MENDS[key])
    for key, each in entry.table.items():
        if key not in KEYS or (key == "rule_base" and rule_base is not None):
            yield finding(
                "VER103", f"`{key}` is no key of this waiver", each.key, f"there is {listed(needed)}"
            )
        elif key == "date":
            if not isinstance(each.value, date) or isinstance(each.value, datetime):
                yield finding("VER104", "this is no date", each, MENDS[key])
        elif not isinstance(each.value, str):
            yield finding("VER104", f"`{key}` is a text", each, MENDS[key])
        elif not each.value.strip():
            yield finding("VER103", f"the waiver has no `{key}`: the text is empty", each, MENDS[key])
    if what is not None and isinstance(what.value, str) and what.value.strip() and not of_code:
        yield from _known(what, items)
    named = entry.get("rule_base")
    if (
        rule_base is None
        and named
        and isinstance(named.value, str)
        and not (file.parent / named.value).is_file()
    ):
        hint = "the path begins at the folder of this file"
        yield finding("VER106", f"there is no rule base `{named.value}`", named, hint)


def _there(named: Entry, folder: Path) -> Iterator[Diagnostic]:
    if not (folder / named.value).is_file():
        hint = "the path begins at the folder of this file"
        yield finding("VER106", f"there is no rule base `{named.value}`", named, hint)


def _known(what: Entry, items: Sequence[str]) -> Iterator[Diagnostic]:
    if what.value not in items:
        near = nearest(what.value, [*items, *CODES])
        hint = f"did you mean `{near}`?" if near else f"there is {listed(items)}, and the code of a finding"
        yield finding("VER104", f"`{what.value}` is nothing that can be waived", what, hint)


MENDS = {
    "what": 'name an item of coverage or the code of a finding, as in what = "fired"',
    "rule": 'name the rule by its label, as in rule = "23"',
    "reason": "say why it may stay as it is: a reviewer reads it",
    "date": "write the day without quotes, as in date = 2026-03-01",
    "rule_base": 'name the rule base, as in rule_base = "scenarios/crane/crane.fcl"',
}
"""What is to be written under each key."""
