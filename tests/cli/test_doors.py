import errno
import re

import click
import pytest
from click.testing import CliRunner

from fcl_sim.cli.doors import Doors
from fcl_sim.diagnostics import InputFault


def leave(what):
    """Return how a process ends whose command returns `what`, or raises it."""

    @click.group(cls=Doors)
    def group():
        pass

    @group.command()
    def go():
        click.echo("a result")
        if isinstance(what, BaseException):
            raise what
        return what

    return CliRunner().invoke(group, ["go"])


@pytest.mark.parametrize(("returned", "code"), [(None, 0), (0, 0), (1, 1)])
def test_a_command_returns_its_exit_code(returned, code):
    result = leave(returned)
    assert (result.exit_code, result.stdout, result.stderr) == (code, "a result\n", "")


@pytest.mark.parametrize(
    ("raised", "code", "message"),
    [
        (
            InputFault.at_file("RUN999", "a.fcl", "it is green", "paint it"),
            3,
            "a.fcl: error[RUN999]: it is green\n  hint: paint it\n",
        ),
        (
            OSError(errno.ENOSPC, "No space left on device", "reports/a.pdf"),
            3,
            "reports/a.pdf: error[RUN101]: the system refused: No space left on device\n",
        ),
        (OSError("only words"), 3, "error[RUN101]: the system refused: only words\n"),
        (KeyboardInterrupt(), 130, "interrupted\n"),
        (click.Abort(), 130, "interrupted\n"),
    ],
    ids=["fault", "full disk", "a system error without a number", "ctrl-c", "a prompt left"],
)
def test_what_is_no_mistake_of_ours_is_said_in_a_line_without_a_traceback(raised, code, message):
    result = leave(raised)
    assert (result.exit_code, result.stderr) == (code, message)


def test_wrong_usage_is_refused_with_the_usage():
    result = leave(click.UsageError("no such thing"))
    assert result.exit_code == 2
    assert result.stderr.endswith("Error: no such thing\n")


def test_our_own_mistake_shows_its_traceback_and_asks_for_a_report():
    result = leave(ZeroDivisionError("float division by zero"))
    assert result.exit_code == 70
    assert result.stderr.startswith("Traceback (most recent call last):\n")
    assert "\nZeroDivisionError: float division by zero\n" in result.stderr
    assert "\nThis is a mistake in fcl_sim, not in your files. Please report it " in result.stderr
    assert re.search(r" fcl_sim \d+\.\d+\.\d+, Python 3\.\d+", result.stderr)
