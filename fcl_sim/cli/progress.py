"""How far a command is: on a terminal only, on stderr, gone when it is done."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Protocol

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn


class Advance(Protocol):
    """Moves a bar: so many are `done` of `total`, and `what` is at work."""

    def __call__(self, done: int, total: int, what: str = "") -> None:
        """Move the bar."""


@contextmanager
def progress(title: str) -> Iterator[Advance]:
    """Show a bar with a title while the block runs; hand out the function that moves it."""
    console = Console(stderr=True)
    columns = (TextColumn(title), BarColumn(), MofNCompleteColumn(), TextColumn("{task.description}"))
    with Progress(*columns, console=console, transient=True, disable=not console.is_terminal) as bar:
        task = bar.add_task("", total=None)

        def advance(done: int, total: int, what: str = "") -> None:
            bar.update(task, completed=done, total=total, description=what)

        yield advance
