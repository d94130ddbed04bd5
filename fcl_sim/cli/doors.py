"""How every command ends: the one place where an exception becomes an exit code."""

import os
import platform
import sys
import traceback
from collections.abc import Iterator
from contextlib import contextmanager
from enum import IntEnum
from typing import Any

import click

from fcl_sim import __version__
from fcl_sim.diagnostics import InputFault


class Exit(IntEnum):
    """What a process says of itself as it leaves."""

    GREEN = 0
    VERDICT = 1
    USAGE = 2
    INPUT = 3
    BASELINE = 4
    BUG = 70
    INTERRUPTED = 130
    BROKEN_PIPE = 141


class Doors(click.Group):
    """A group whose commands may raise anything and return an exit code or None."""

    def invoke(self, ctx: click.Context) -> Any:
        """Run the command; leave with its exit code, or with that of what it raised."""
        with leaving(ctx):
            code = super().invoke(ctx)
            sys.stdout.flush()
            ctx.exit(Exit.GREEN if code is None else code)


@contextmanager
def leaving(ctx: click.Context) -> Iterator[None]:
    """Turn what is raised inside into a message on stderr and an exit code."""
    try:
        yield
    except (click.ClickException, click.exceptions.Exit):
        raise
    except InputFault as fault:
        say(str(fault))
        ctx.exit(Exit.INPUT)
    except BrokenPipeError:
        # Who read our output left; what is still buffered has nowhere to go.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        ctx.exit(Exit.BROKEN_PIPE)
    except OSError as error:
        say(str(of_environment(error)))
        ctx.exit(Exit.INPUT)
    except (KeyboardInterrupt, click.Abort):
        say("interrupted")
        ctx.exit(Exit.INTERRUPTED)
    except Exception:  # noqa: BLE001  the last door: whatever is left is our mistake
        say(traceback.format_exc() + bug_report())
        ctx.exit(Exit.BUG)


def of_environment(error: OSError) -> InputFault:
    """Return the fault of a failed system call, with the file where it is known."""
    reason = error.strerror or str(error)
    file = error.filename2 or error.filename or ""
    return InputFault.at_file("RUN101", str(file), f"the system refused: {reason}")


def bug_report() -> str:
    """Return the sentence that asks for a report, with what the reader of one needs to know."""
    versions = f"fcl_sim {__version__}, Python {platform.python_version()}, {platform.platform()}"
    return (
        "This is a mistake in fcl_sim, not in your files. Please report it with the lines above\n"
        f"and the files that led to it. {versions}"
    )


def say(message: str) -> None:
    """Write a line for people to stderr."""
    click.echo(message, err=True)
