"""One reading of a scenario: the files that were opened, the faults that were found."""

from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path

from fcl_sim.diagnostics import Diagnostic, InputFault
from fcl_sim.scenario.document import parse, read_file
from fcl_sim.scenario.model import SourceFile
from fcl_sim.toml.tree import Entry


@dataclass(slots=True)
class Reading:
    """Files and faults so far; each fault counts once, though every variant repeats its base's."""

    path: Path
    files: dict[Path, SourceFile] = field(default_factory=dict)
    faults: dict[Diagnostic, None] = field(default_factory=dict)
    trees: dict[Path, Entry] = field(default_factory=dict)

    def open(self, path: Path, role: str, asked: Entry | None = None) -> SourceFile | None:
        """Return a file, read once; note a fault and return None where it cannot be read."""
        if path not in self.files:
            try:
                self.files[path] = read_file(path, role, asked.span if asked else None)
            except InputFault as fault:
                self.note(fault.diagnostics)
                return None
        return self.files[path]

    def parsed(self, file: SourceFile) -> Entry:
        """Return the tree of a TOML file, parsed once; InputFault where it is none."""
        if file.path not in self.trees:
            self.trees[file.path] = parse(file.source)
        return self.trees[file.path]

    def beside(self, entry: Entry) -> Path:
        """Return the path that an entry names, relative to its own file; an override's, to the scenario."""
        name = entry.span.source.name
        home = next((each.path for each in self.files.values() if each.name == name), self.path)
        return home.parent / str(entry.value)

    def note(self, faults: Iterable[Diagnostic]) -> bool:
        """Remember faults; return whether there were any."""
        found = dict.fromkeys(faults)
        self.faults.update(found)
        return bool(found)

    def faults_in_order(self) -> list[Diagnostic]:
        """Return the faults file by file, from top to bottom."""
        names = [each.name for each in self.files.values()]

        def place(fault: Diagnostic) -> tuple[int, int]:
            first = fault.places[0] if fault.places else None
            order = names.index(first.name) if first and first.name in names else len(names)
            return order, first.span.start if first and first.span else -1

        return sorted(self.faults, key=place)
