"""The one exception for a user's mistake."""

from collections.abc import Iterable

from fcl_sim.diagnostics.diagnostic import Diagnostic, Place
from fcl_sim.diagnostics.render import render


class InputFault(Exception):
    """Input that cannot be used: carries every finding, drawn by `str`."""

    def __init__(self, diagnostics: Iterable[Diagnostic]) -> None:
        self.diagnostics = tuple(diagnostics)
        super().__init__(self.diagnostics)

    def __str__(self) -> str:
        return "\n".join(render(each) for each in self.diagnostics)

    @classmethod
    def at_file(cls, code: str, file: str, message: str, hint: str = "") -> "InputFault":
        """Return the fault of a whole file, or of the environment when `file` is empty."""
        places = (Place(file=file),) if file else ()
        return cls([Diagnostic(code=code, message=message, places=places, hint=hint)])
