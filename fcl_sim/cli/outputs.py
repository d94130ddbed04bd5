"""What a run leaves for a build server: JUnit XML, SARIF, a job summary, annotations."""

import json
import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from fcl_sim import __version__
from fcl_sim.cli.doors import say
from fcl_sim.diagnostics import Diagnostic
from fcl_sim.diagnostics.as_github import as_github
from fcl_sim.diagnostics.as_sarif import as_sarif
from fcl_sim.report import job_summary, junit
from fcl_sim.report.findings import findings
from fcl_sim.testbench import Outcome


@dataclass(frozen=True, slots=True, kw_only=True)
class Outputs:
    """Files for a build server, and whether what is not green is annotated.

    `appended` is the summary of the job that this process is a step of.
    """

    junit: Path | None = None
    sarif: Path | None = None
    summary: Path | None = None
    appended: Path | None = None
    annotates: bool = False

    @classmethod
    def of(
        cls, files: Mapping[str, Path | None], form: str | None, environment: Mapping[str, str] = os.environ
    ) -> "Outputs":
        """Return what the options name, and what GitHub's environment asks for where they say nothing."""
        own_page = environment.get("GITHUB_STEP_SUMMARY")
        on_github = environment.get("GITHUB_ACTIONS") == "true"
        return cls(
            **files,
            appended=Path(own_page) if own_page and not files.get("summary") else None,
            annotates=form == "github" or (form is None and on_github),
        )

    def write(self, outcomes: Sequence[Outcome], faults: Iterable[Diagnostic]) -> list[Path]:
        """Write and print everything that was asked for; return the files that were named.

        `faults` are what kept scenarios from being run: a build server is told of
        them as well.
        """
        listed = list(faults)
        if self.annotates:
            for each in (*listed, *findings(outcomes)):
                say(as_github(each, root()))
        written = []
        if self.junit:
            written.append(_write(self.junit, junit.text(outcomes, listed)))
        if self.sarif:
            log = as_sarif([*listed, *findings(outcomes)], __version__, root())
            written.append(_write(self.sarif, json.dumps(log, indent=2, ensure_ascii=False) + "\n"))
        if self.summary:
            written.append(_write(self.summary, job_summary.text(outcomes, listed)))
        if self.appended:
            with self.appended.open("a", encoding="utf-8") as file:
                file.write(job_summary.text(outcomes, listed))
        return written


def root(environment: Mapping[str, str] = os.environ) -> Path:
    """Return what files are named relative to: GitHub's checkout around the current folder, else that."""
    here = Path.cwd()
    checkout = environment.get("GITHUB_WORKSPACE")
    return Path(checkout) if checkout and here.is_relative_to(checkout) else here


def _write(file: Path, text: str) -> Path:
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(text, encoding="utf-8")
    return file
