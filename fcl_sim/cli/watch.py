"""`fcl-sim run --watch`: what was saved is run at once, and its curves are drawn over those before."""

import time
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import count
from pathlib import Path
from typing import NoReturn

import click

from fcl_sim import testbench
from fcl_sim.cli.against import print_changes
from fcl_sim.cli.doors import say
from fcl_sim.cli.progress import Advance, progress
from fcl_sim.cli.table import console, print_runs
from fcl_sim.diagnostics import Diagnostic, InputFault
from fcl_sim.report import summary
from fcl_sim.report.html import page
from fcl_sim.report.html.live import Live, served
from fcl_sim.report.html.markup import Markup
from fcl_sim.report.html.page import scenario_section, stretches_for
from fcl_sim.report.provenance import inputs_of
from fcl_sim.scenario.bench import scenarios_below
from fcl_sim.scenario.document import shown
from fcl_sim.scenario.reader import read
from fcl_sim.testbench import Against, Outcome
from fcl_sim.testbench.running import outcome_of

GLANCE = 0.05
"""Seconds between two looks at the files."""

ROUND = 20
"""After so many looks at the files it is looked for new ones."""

MOST_GLANCES = 40
"""After so many looks a file that is gone, or is written all the time, is taken as it is."""

Stamp = tuple[int, int]
"""When a file was written, and how long it is."""
Stamps = dict[Path, Stamp | None]


def watch(files: Sequence[Path], overrides: Mapping[str, object], folders: Sequence[Path] = ()) -> NoReturn:
    """Run scenarios, show them on a page, and again whenever a file that they depend on is saved.

    Scenarios that come into one of the `folders` are followed, too. Nothing is
    written. Ctrl-C ends it.
    """
    bench, live, versions = Bench(list(files), overrides, folders), Live(), count(1)
    with progress("simulating") as advance:
        broken = [fault for _, faults in bench.run(files, advance=advance) for fault in faults]
    print_runs(list(summary.run_rows(bench.known)), console())
    _show(bench, live, next(versions))
    _warn(bench, live, broken)
    with served(live) as address:
        click.echo(f"\nopen {address} ({len(bench.inputs)} files are watched; Ctrl-C ends it)")
        for changed in saved(bench):
            begun, new, broken = time.perf_counter(), [], []
            label = ", ".join(sorted(each.name for each in changed))
            told = told_of(changed)
            if bench.forget(changed):
                _show(bench, live, next(versions))
            for outcome, faults in bench.run(bench.affected(changed), label):
                broken += faults
                if outcome is not None:
                    new.append(outcome)
                    _show(bench, live, next(versions))
            took = time.perf_counter() - begun
            click.echo(f"\n{time.strftime('%H:%M:%S')} {told}: {took:.2f} s")
            _warn(bench, live, broken)
            for outcome in new:
                _print(outcome)
    raise AssertionError  # the files are watched until somebody interrupts


def told_of(changed: Iterable[Path]) -> str:
    """Return which files were saved and which were deleted."""
    gone: dict[bool, list[str]] = {False: [], True: []}
    for file in changed:
        gone[not file.exists()].append(shown(file))
    words = {False: "saved", True: "deleted"}
    told = [f"{', '.join(sorted(each))} was {words[is_gone]}" for is_gone, each in gone.items() if each]
    return " and ".join(told)


def _show(bench: "Bench", live: Live, version: int) -> None:
    live.show(version, bench.page(version))


def _print(outcome: Outcome) -> None:
    """Print what changed in a scenario; how it did, where it was not run before."""
    if outcome.against is None:
        print_runs(list(summary.run_rows([outcome])), console())
    else:
        print_changes(outcome, console())


def _warn(bench: "Bench", live: Live, broken: Sequence[Diagnostic]) -> None:
    """Tell here what cannot be run now, and above the page what still cannot; it stays as it was."""
    if broken:
        say(str(InputFault(dict.fromkeys(broken))))
    standing = [each for faults in bench.broken.values() for each in faults]
    if standing:
        live.warn(str(InputFault(dict.fromkeys(standing))))


@dataclass
class Bench:
    """Scenarios that are watched: what came of each last time, what each depends on, which cannot be run.

    Those that come into one of its folders join them, and leave when they are deleted there.
    """

    files: list[Path]
    overrides: Mapping[str, object]
    folders: Sequence[Path] = ()
    outcomes: dict[Path, Outcome] = field(default_factory=dict)
    depends: dict[Path, set[Path]] = field(default_factory=dict)
    sections: dict[Path, tuple[Outcome, int, Markup]] = field(default_factory=dict)
    broken: dict[Path, tuple[Diagnostic, ...]] = field(default_factory=dict)

    @property
    def known(self) -> list[Outcome]:
        """What is known of the scenarios, in their order; those that never could be run are left out."""
        return [self.outcomes[file] for file in self.files if file in self.outcomes]

    @property
    def inputs(self) -> set[Path]:
        """The files that any scenario depends on."""
        return set().union(*self.depends.values())

    def join(self) -> list[Path]:
        """Take scenarios that have come into its folders; return them."""
        found = [file for folder in self.folders for file in scenarios_below(folder)]
        new = [
            file for file in dict.fromkeys(found) if file not in self.files and not _is_lacking(_stamp(file))
        ]
        self.files += new
        self.depends |= {file: {file} for file in new}
        return new

    def forget(self, changed: Iterable[Path]) -> bool:
        """Leave out the scenarios that were deleted from its folders; return whether there were any."""
        gone = [file for file in self.files if file in changed and not file.exists() and self._is_below(file)]
        for file in gone:
            self.files.remove(file)
            self.outcomes.pop(file, None)
            self.depends.pop(file, None)
            self.sections.pop(file, None)
            self.broken.pop(file, None)
        return bool(gone)

    def _is_below(self, file: Path) -> bool:
        return any(file.is_relative_to(folder) for folder in self.folders)

    def affected(self, changed: Iterable[Path]) -> list[Path]:
        """Return the scenarios that depend on any of these files."""
        return [file for file in self.files if not self.depends[file].isdisjoint(changed)]

    def run(
        self, files: Sequence[Path], label: str = "", advance: Advance | None = None
    ) -> Iterator[tuple[Outcome | None, tuple[Diagnostic, ...]]]:
        """Run scenarios; yield of each what came of it, beside what it was, or what is wrong with it."""
        for done, file in enumerate(files):
            if advance is not None:
                advance(done, len(files), file.stem)
            yield self._run(file, label)

    def _run(self, file: Path, label: str) -> tuple[Outcome | None, tuple[Diagnostic, ...]]:
        self.depends.setdefault(file, set()).add(file)
        try:
            made = _nominal(file, self.overrides)
        except InputFault as fault:
            self.depends[file] |= {Path(place.name) for each in fault.diagnostics for place in each.places}
            self.broken[file] = tuple(each.within(str(file)) for each in fault.diagnostics)
            return None, self.broken[file]
        self.broken.pop(file, None)
        before = self.outcomes.get(file)
        if before is not None:
            made = replace(made, against=Against(label=f"before {label} was saved", runs=before.variants))
        self.outcomes[file] = made
        self.depends[file] = {file, *(each.path for each in inputs_of(made))}
        return made, ()

    def page(self, version: int) -> str:
        """Return the page, with the sections of what did not change as they were."""
        stretches = stretches_for(self.known)
        draw = scenario_section(stretches)
        files = [file for file in self.files if file in self.outcomes]

        def section(outcome: Outcome, number: int) -> Markup:
            file = files[number]
            kept = self.sections.get(file)
            if kept is None or kept[0] is not outcome or kept[1] != number:
                kept = self.sections[file] = (outcome, number, draw(outcome, number))
            return kept[2]

        return page(self.known, section=section, live=version)


def _nominal(file: Path, overrides: Mapping[str, object]) -> Outcome:
    """Return what comes of a scenario without envelopes and baselines: one does not want to wait for them."""
    scenario = read(file, overrides)
    alone = {variant: replace(setup, vary=()) for variant, setup in scenario.variants.items()}
    runs = testbench.run_together(testbench.prepare(replace(scenario, variants=alone), is_compared=False))
    return outcome_of(scenario, runs)


def saved(bench: Bench) -> Iterator[set[Path]]:
    """Yield the files that were saved, came or were deleted, once they are whole, for ever."""
    stamps = _stamps(bench.inputs)
    for turn in count(1):
        time.sleep(GLANCE)
        if turn % ROUND == 0:
            stamps |= dict.fromkeys(bench.join())  # as if they had not been there
        now = _stamps(bench.inputs)
        changed = _changed(stamps, now)
        if not changed:
            stamps = now
            continue
        whole = _settled(bench, stamps)
        yield changed | _changed(now, whole)
        stamps = whole


def _changed(before: Stamps, now: Stamps) -> set[Path]:
    return {file for file in now if now[file] != before.get(file, now[file])}


def _settled(bench: Bench, whole: Stamps) -> Stamps:
    """Wait until nothing is being written: an editor may empty a file first, or put another in its place."""
    now = dict(whole)
    for _ in range(MOST_GLANCES):
        time.sleep(GLANCE / 2.0)
        before, now = now, _stamps(bench.inputs)
        if now == before and not any(_is_lacking(now[file]) > _is_lacking(whole.get(file)) for file in now):
            break
    return now


def _is_lacking(stamp: Stamp | None) -> bool:
    return stamp is None or stamp[1] == 0


def _stamps(files: Iterable[Path]) -> Stamps:
    return {file: _stamp(file) for file in files}


def _stamp(file: Path) -> Stamp | None:
    try:
        told = file.stat()
    except OSError:
        return None
    return told.st_mtime_ns, told.st_size
