"""The command line: thin doors to the rooms, one file per command.

In: arguments. Out: results to stdout, progress and diagnostics to stderr, an
exit code. May import every room; nothing imports it. A command's file is
imported when it is called, so that help loads nothing heavy.
Tests: tests/cli.
"""

from fcl_sim.cli.program import main

__all__ = ["main"]
