"""Findings for the tests of renderings."""

from fcl_sim.diagnostics import Diagnostic, Place, Severity, Source, Span

SOURCE = Source("rules/bath.fcl", "one wrong\ntwo wrong\n(* 温\U0001f6bf *) three wrong\nlast")


def span(word, nth=0, source=SOURCE):
    start = -1
    for _ in range(nth + 1):
        start = source.text.index(word, start + 1)
    return Span(source, start, start + len(word))


ONE = Diagnostic(code="FCL302", message="`wrong` is not declared", places=(Place(span("wrong")),))
TWICE = Diagnostic(
    code="FCL301",
    message="`wrong` is declared twice",
    severity=Severity.WARNING,
    places=(Place(span("wrong", 1)), Place(span("one"), "first here"), Place(span("last"))),
    hint="give it another name",
)
BEHIND_WIDE = Diagnostic(
    code="FCL115", message="a note", severity=Severity.NOTE, places=(Place(span("three")),)
)
OF_FILE = Diagnostic(code="FCL101", message="there is no such file", places=(Place(file="rules/bath 2.fcl"),))
NOWHERE = Diagnostic(code="RUN101", message="the system refused: disk full")
ALL = (ONE, TWICE, BEHIND_WIDE, OF_FILE, NOWHERE)
