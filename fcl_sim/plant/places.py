"""Where in a plant's file something stands: its declarations, their arguments, its functions."""

import ast
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from fcl_sim.diagnostics import Diagnostic, InputFault, Place, Source, Span


@dataclass(frozen=True)
class PlantFile:
    """The file of a plant, read when a place in it is asked for."""

    path: Path

    @cached_property
    def source(self) -> Source:
        """Its text."""
        return Source(str(self.path), self.path.read_text(encoding="utf-8", errors="replace"))

    @cached_property
    def _nodes(self) -> tuple[ast.expr, ...]:
        """Its expressions, in the order of the text; none where it is no Python."""
        try:
            nodes = [each for each in ast.walk(ast.parse(self.source.text)) if isinstance(each, ast.expr)]
        except (SyntaxError, ValueError):
            return ()
        return tuple(sorted(nodes, key=lambda each: (each.lineno, each.col_offset)))

    def fault(self, code: str, message: str, span: Span | None = None, hint: str = "") -> Diagnostic:
        """Return a finding about the file, at `span` or else at the whole of it."""
        place = Place(span=span, file=str(self.path))
        return Diagnostic(code=code, message=message, places=(place,), hint=hint)

    def refusal(self, code: str, message: str, span: Span | None = None, hint: str = "") -> InputFault:
        """Return the fault of one finding."""
        return InputFault([self.fault(code, message, span, hint)])

    def line(self, number: int) -> Span:
        """Return a line, from 1, without the blanks before and behind its text."""
        text = self.source.line_text(number)
        start = self.source.line_starts[number - 1] + len(text) - len(text.lstrip())
        return Span(self.source, start, start + max(1, len(text.strip())))

    def declaration(self, kind: str, name: object, which: int = 0) -> ast.Call | None:
        """Return the call `kind(name, ...)`, of several the one numbered `which`, where there is one."""
        found = [
            each
            for each in self._calls(kind)
            if isinstance(given := _given(each, 0, "name"), ast.Constant) and given.value == name
        ]
        return found[which] if which < len(found) else None

    def argument(self, call: ast.Call | None, position: int, name: str) -> Span | None:
        """Return an argument of a call, by position or name; the line of the call where it is not given."""
        if call is None:
            return self.assignment("PLANT")
        given = _given(call, position, name)
        return self.line(call.lineno) if given is None else self._span(given)

    def call(self, name: str) -> Span | None:
        """Return the first call of the function `name`."""
        return next((self._span(each) for each in self._calls(name)), None)

    def assignment(self, name: str) -> Span | None:
        """Return the first line that gives `name` a value."""
        lines = (
            each.lineno
            for each in self._nodes
            if isinstance(each, ast.Name) and each.id == name and isinstance(each.ctx, ast.Store)
        )
        line = next(lines, None)
        return None if line is None else self.line(line)

    def _calls(self, name: str) -> list[ast.Call]:
        calls = [each for each in self._nodes if isinstance(each, ast.Call)]
        return [
            each for each in calls if name in {getattr(each.func, "id", ""), getattr(each.func, "attr", "")}
        ]

    def _span(self, node: ast.expr) -> Span:
        start = self._offset(node.lineno, node.col_offset)
        end = self._offset(node.end_lineno or node.lineno, node.end_col_offset or node.col_offset)
        return Span(self.source, start, max(end, start + 1))

    def _offset(self, line: int, octets: int) -> int:
        # ast counts columns in octets of UTF-8
        text = self.source.line_text(line).encode()
        return self.source.line_starts[line - 1] + len(text[:octets].decode(errors="ignore"))


def _given(call: ast.Call, position: int, name: str) -> ast.expr | None:
    named = {each.arg: each.value for each in call.keywords}
    return call.args[position] if position < len(call.args) else named.get(name)
