"""Where things stand, for the tests of the house."""

from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parents[2]
PACKAGE = ROOT / "fcl_sim"

NOT_OURS = {".git", ".venv", "build", "dist", "__pycache__", "node_modules"}
OUTPUT = ROOT / "reports"


def own_files(pattern: str = "*") -> Iterator[Path]:
    """Yield the project's own files: no output, nothing that was installed, no caches."""
    for file in sorted(ROOT.rglob(pattern)):
        parts = file.relative_to(ROOT).parts
        hidden = any(part in NOT_OURS or (part.startswith(".") and part.endswith("cache")) for part in parts)
        if hidden or ".hypothesis" in parts or not file.is_file():
            continue
        if OUTPUT not in file.parents or file.name == "README.md":
            yield file
