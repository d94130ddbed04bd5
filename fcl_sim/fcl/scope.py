"""What the names of one function block mean."""

from dataclasses import dataclass, field
from enum import Enum

from fcl_sim.diagnostics.spelling import listed
from fcl_sim.fcl.findings import Findings
from fcl_sim.fcl.tokens import Token
from fcl_sim.model import Structure, Variable


class Role(Enum):
    """Which section declares a variable."""

    INPUT = "VAR_INPUT"
    OUTPUT = "VAR_OUTPUT"
    LOCAL = "VAR"


@dataclass(frozen=True, slots=True)
class Declared:
    """A declared variable, and the name in its declaration."""

    variable: Variable
    role: Role
    token: Token

    @property
    def name(self) -> str:
        """The spelling declared."""
        return self.variable.name


@dataclass(slots=True)
class Terms:
    """The terms of one variable: their spelling by key. Where `damaged`, there may be more.

    `owner` is the variable's name in their section.
    """

    owner: Token | None = None
    names: dict[str, Token] = field(default_factory=dict)
    damaged: bool = False


class Scope:
    """The names of one function block, filled section by section.

    `incomplete` says that a declaration could not be read, `headless` that the
    name behind a FUZZIFY or DEFUZZIFY could not: absence then proves nothing.
    `unknown` says that a name was used that nobody declares.
    """

    def __init__(self, findings: Findings) -> None:
        self.findings = findings
        self.variables: dict[str, Declared] = {}
        self.terms: dict[str, Terms] = {}
        self.concluded: set[str] = set()
        self.incomplete = False
        self.headless = False
        self.unknown = False
        self.structures: dict[str, Structure] = {}
        """Structure types by their key."""
        self.ranges: dict[str, tuple[float, float]] = {}
        """Ranges of inputs by the key of the input (S15)."""
        self.instances: dict[str, Structure] = {}
        """Variables that are structures, and their types (S7)."""
        self._spellings: dict[str, dict[str, Token]] = {}

    # -- variables

    def declare(self, declared: Declared) -> None:
        """Add a variable; a second one of the same name is reported."""
        first = self.variables.setdefault(declared.token.key, declared)
        if first is not declared:
            self.report_twice("FCL301", f"`{first.name}` is declared twice", declared.token, first.token)

    def find(self, token: Token) -> Declared | None:
        """Return the variable of a name; None, once that has been reported, where there is none."""
        declared = self.variables.get(token.key)
        if declared is not None:
            self.respell(token, declared.name)
            return declared
        self.unknown = True
        if token.key in self.instances:
            self.report_structure(token)
        elif not self.incomplete:
            self.findings.error(
                "FCL302", f"{token.shown} is not declared", token, lambda: self.variable_hint(token)
            )
        return None

    def report_structure(self, token: Token) -> None:
        """Report a structure in the place of one of its members."""
        structure = self.instances[token.key]
        members = listed(f"{token.text}.{each.name}" for each in structure.members)
        message = f"{token.shown} is a structure: one of its members is expected"
        self.findings.error("FCL309", message, token, hint=f"valid here: {members}")

    def find_input(self, token: Token, use: str) -> str | None:
        """Return the spelling of an input whose value is used as a number; anything else is reported."""
        declared = self.find(token)
        if declared is None:
            return None
        if declared.role is not Role.INPUT:
            self.findings.error(
                "FCL303",
                f"`{declared.name}` is declared in {declared.role.value}: {use} is a number or an input",
                token,
                hint=f"declare `{declared.name}` in VAR_INPUT",
            )
            return None
        return declared.name

    def variable_hint(self, token: Token) -> str:
        """Return what could have been meant by an undeclared name."""
        names = [each.name for each in self.variables.values()]
        near = self.findings.near(token.text, names)
        if near:
            return f"did you mean `{near}`?"
        return f"declared: {listed(names)}" if names else "declare it in VAR_INPUT or VAR_OUTPUT"

    # -- terms

    def find_term(self, declared: Declared, terms: Terms, token: Token) -> str | None:
        """Return the spelling of a term of a variable; None, once reported, where it has no such term."""
        found = terms.names.get(token.key)
        if found is not None:
            self.respell(token, found.text)
            return found.text
        if not terms.damaged:
            others = [
                f"`{each.name}`"
                for key, each in self.variables.items()
                if key in self.terms and each is not declared and token.key in self.terms[key].names
            ]
            message = f"{token.shown} is not a term of `{declared.name}`"
            if others:
                message += f", it is one of {listed(others)}"
            self.findings.error("FCL310", message, token, lambda: self._term_hint(terms, token))
        return None

    def _term_hint(self, terms: Terms, token: Token) -> str:
        names = [each.text for each in terms.names.values()]
        near = self.findings.near(token.text, names)
        valid = f"alid here: {listed(names)}"
        return f"did you mean `{near}`? V{valid}" if near else f"v{valid}"

    # -- names in general

    def report_twice(self, code: str, message: str, second: Token, first: Token) -> None:
        """Report a name that was given before."""
        self.findings.error(code, message, second, related=(self.findings.place(first, "first here"),))

    def respell(self, token: Token, spelling: str) -> None:
        """Remember a name that is written otherwise than where it is declared (S1)."""
        if token.text != spelling:
            self._spellings.setdefault(spelling, {}).setdefault(token.text, token)

    def note_spellings(self) -> None:
        """Say once for each name that it has several spellings (S1)."""
        for spelling, others in self._spellings.items():
            for token in others.values():
                message = f"`{spelling}` is also spelled {listed(f'`{each}`' for each in others)}"
                self.findings.note("FCL304", message, token, hint="letter case does not count")
