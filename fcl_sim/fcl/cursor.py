"""The parser's place in the text: what it takes, what it misses, and where it goes on after a fault."""

from itertools import pairwise

from fcl_sim.fcl.findings import Findings, Hint, Spanned, Stretch
from fcl_sim.fcl.keywords import ENDS, SECTIONS, SETTINGS, STRUCTURAL
from fcl_sim.fcl.tokens import Kind, Scan, Token


class Astray(Exception):
    """The statement cannot be read any further; what is wrong has been said."""


class Cursor:
    """A place among the tokens of a scan, and the findings so far."""

    def __init__(self, scan: Scan) -> None:
        self.source = scan.source
        self.findings = Findings(scan.source)
        self._tokens = scan.tokens
        self._index = 0
        self.token = scan.tokens[0]
        """The token that comes next."""
        self.last = Token(Kind.SYMBOL, "", "", 0)
        """The token taken last."""
        self.ended = False
        """Whether somebody has said that the text ends too early."""

    def advance(self) -> Token:
        """Take the next token; the end is never passed."""
        taken = self.token
        if taken.kind is not Kind.END:
            self.last = taken
            self._index += 1
            self.token = self._tokens[self._index]
        return taken

    def ahead(self, steps: int = 1) -> Token:
        """Return the token that comes `steps` after the next."""
        return self._tokens[min(self._index + steps, len(self._tokens) - 1)]

    def take(self, key: str) -> Token | None:
        """Take the next token if it is `key`."""
        return self.advance() if self.token.key == key else None

    # -- what must come

    def expect(self, key: str, after: str, instead: tuple[str, ...] = ()) -> None:
        """Take `key`; one of `instead` is reported and taken for it."""
        if self.token.key == key:
            self.advance()
        elif self.token.key in instead:
            self.report(f"`{key}` is expected after {after}")
            self.advance()
        else:
            raise self.stray(f"`{key}` is expected after {after}")

    def name(self, what: str, follow: frozenset[str] = frozenset(), *, begins: bool = False) -> Token:
        """Take a name; a keyword counts as one where `follow` shows that no keyword can stand here.

        `begins` says that a statement begins with it.
        """
        token = self.token
        if token.kind is Kind.NAME and (token.key not in STRUCTURAL or self.ahead().key in follow):
            return self.advance()
        message = f"{what} is expected"
        if token.kind is Kind.MIXED:
            hint = "a name begins with a letter or an underscore"
            raise self.refuse("FCL209", f"{message}, not {token.shown}", token, hint)
        if begins and token.kind not in {Kind.STRAY, Kind.END}:
            raise self.refuse("FCL209", f"{message}, not {token.shown}", token, self._decimal_point())
        raise self.stray(message, code="FCL209")

    # -- what is wrong

    def report(self, message: str, hint: Hint = "", code: str = "FCL201") -> None:
        """Say that something else is expected than what comes next, unless that has been reported already."""
        token = self.token
        if token.kind is Kind.STRAY:
            return
        hint = hint or self._decimal_point()
        if token.kind is Kind.END:
            self.findings.error(code, f"{message}, but the text ends", self._gap(), hint)
        elif self.starts_line():
            self.findings.error(code, f"{message}, but the line ends", self._gap(), hint)
        else:
            self.findings.error(code, f"{message}, not {token.shown}", token, hint)

    def stray(self, message: str, hint: Hint = "", code: str = "FCL201") -> Astray:
        """Report as above; return what to raise to give the statement up."""
        self.report(message, hint, code)
        return Astray()

    def refuse(self, code: str, message: str, at: Spanned, hint: str = "") -> Astray:
        """Report something at a place of its own; return what to raise to give the statement up."""
        self.findings.error(code, message, at, hint)
        return Astray()

    def starts_line(self) -> bool:
        """Return whether the next token stands on another line than the one before."""
        return "\n" in self.source.text[self.last.end : self.token.start]

    def _decimal_point(self) -> str:
        """Return a hint about a number whose decimal comma comes next or came last."""
        for first in (self._index - 1, self._index - 2):
            found = self._tokens[max(first, 0) : first + 3]
            if [each.key.isdigit() or each.key for each in found] != [True, ",", True]:
                continue
            if all(before.end == after.start for before, after in pairwise(found)):
                return f"a decimal fraction is written with a point: {found[0].key}.{found[2].key}"
        return ""

    def _gap(self) -> Stretch:
        """Return the place right behind the token taken last."""
        return Stretch(self.last.end, self.last.end)

    def words(self, start: int) -> str:
        """Return what was taken from offset `start` on, one blank where words do not touch."""
        first = self._index
        while first > 0 and self._tokens[first - 1].start >= start:
            first -= 1
        taken = self._tokens[first : self._index]
        gaps = ["" if each.start == before.end else " " for before, each in pairwise(taken)]
        return "".join(gap + each.text for gap, each in zip(["", *gaps], taken, strict=True))

    def since(self, start: int) -> Stretch:
        """Return what was taken from offset `start` on."""
        return Stretch(start, self.last.end)

    # -- where to go on

    def in_open_comment(self) -> bool:
        """Return whether the rest of the text has become a comment, as the scanner has said."""
        return self.last.kind is Kind.STRAY and self.last.key in {"(*", "/*"}

    def at_early_end(self) -> bool:
        """Return whether the text ends here, and not with an END."""
        return self.token.kind is Kind.END and not self.last.key.startswith("END")

    def at_statement(self, steps: int = 0) -> bool:
        """Return whether a new statement or section begins `steps` after the next token."""
        token = self.ahead(steps)
        if token.kind is not Kind.NAME:
            return token.kind is Kind.END
        key = token.key
        if key in ENDS:
            return True
        following = self.ahead(steps + 1)
        if key in SECTIONS or key in {"FUNCTION_BLOCK", "TERM", "RULE"}:
            return following.key not in {"IS", ")", "AND", "OR", "THEN", ",", ";"}
        if key in SETTINGS:
            return following.key in SETTINGS[key]
        return is_joined_rule(token, following)

    def skip_statement(self) -> None:
        """Go on behind the next `;`, or before the next statement."""
        while self.token.kind is not Kind.END:
            if self.take(";") or self.at_statement():
                return
            self.advance()

    def skip_line(self) -> None:
        """Go on in the next line, or before the next statement."""
        while not (self.at_statement() or self.starts_line()):
            self.advance()

    def leave(self, token: Token) -> None:
        """Go past `token` if it still comes next: whatever happens, reading goes on."""
        if self.token is token:
            self.advance()

    def end_statement(self, *, begins: bool = False) -> None:
        """Take the `;` of a statement; a missing one is tolerated where nothing else can come (S9).

        `begins` says that the next token begins a statement of a kind that
        `at_statement` does not know.
        """
        if self.take(";"):
            return
        if not (begins or self.at_statement()):
            raise self.stray("`;` is expected at the end of the statement")
        if self.token.kind is not Kind.END:
            self.findings.warning("FCL206", "`;` is missing at the end of the statement", self._gap())


def is_joined_rule(token: Token, following: Token) -> bool:
    """Return whether a rule begins whose label is joined to its keyword: `RULE1:` (S5)."""
    return following.key == ":" and token.key.startswith("RULE") and token.key not in STRUCTURAL
