"""A bench and git: the revision it stands at, and the bench as it was at another, in a folder of its own."""

import io
import subprocess
import tempfile
import zipfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from fcl_sim.diagnostics import InputFault


@dataclass(frozen=True, slots=True, kw_only=True)
class Revision:
    """Where a bench stands in git: the `commit` in hex, `changed` the files that are not as they are there.

    The commit is empty where the bench is in no repository, or git is not installed.
    """

    bench: str
    commit: str = ""
    changed: tuple[str, ...] = ()

    @property
    def is_clean(self) -> bool:
        """Whether the files of the repository are those of the commit."""
        return bool(self.commit) and not self.changed


def revision_of(bench: Path) -> Revision:
    """Return where a bench stands in git; files that git is told to ignore do not count."""
    name = bench.absolute().name
    try:
        commit = _git(bench, "rev-parse", "--verify", "--quiet", "HEAD", wrong="").decode().strip()
        status = _git(bench, "status", "--porcelain", "-z", "--no-renames", wrong="")
    except InputFault:
        return Revision(bench=name)
    changed = tuple(sorted(each[3:] for each in status.decode("utf-8", "replace").split("\0") if each))
    return Revision(bench=name, commit=commit, changed=changed)


@contextmanager
def checked_out(bench: Path, revision: str) -> Iterator[Path]:
    """Give the folder of a bench as it was at a revision; it is gone afterwards.

    Nothing in the repository or its working tree changes. InputFault where the
    bench is in no repository, git is not installed, or it knows no such revision.
    """
    place = str(bench)
    if revision.startswith("-"):
        raise InputFault.at_file("RUN109", place, f"`{revision}` is no revision")
    _git(bench, "rev-parse", "--is-inside-work-tree", wrong="the bench is in no git repository")
    commit = _git(
        bench,
        "rev-parse",
        "--verify",
        "--quiet",
        "--end-of-options",
        f"{revision}^{{commit}}",
        wrong=f"git knows no revision `{revision}`",
    )
    data = _git(
        bench, "archive", "--format=zip", commit.decode().strip(), wrong=f"the bench is not in `{revision}`"
    )
    with tempfile.TemporaryDirectory(prefix="fcl-sim-") as folder:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            archive.extractall(folder)
        yield Path(folder)


def _git(bench: Path, *arguments: str, wrong: str) -> bytes:
    try:
        done = subprocess.run(  # noqa: S603  no shell; the revision cannot be an option
            ["git", "-C", str(bench), *arguments],  # noqa: S607  git is where the user has it
            capture_output=True,
            check=False,
        )
    except FileNotFoundError as error:
        message, hint = "git is not installed", "name an older rule base instead: --against OLD.fcl"
        raise InputFault.at_file("RUN109", str(bench), message, hint) from error
    if done.returncode:
        said = done.stderr.decode("utf-8", "replace").strip()
        hint = "a revision is a branch, a tag or a commit, as in --against HEAD~1; a rule base ends in .fcl"
        raise InputFault.at_file("RUN109", str(bench), f"{wrong}{': ' if said else ''}{said}", hint)
    return done.stdout
