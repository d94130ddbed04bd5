"""Build hook: the wheel carries the shipped bench as data.

`plants/` and `scenarios/` stand beside the package in the repository, which is
its own first user. In a wheel they lie under `fcl_sim/bench/`, so nothing named
`plants` or `scenarios` lands in site-packages. An editable install finds them
where they are.
"""

from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

BENCH = ("plants", "scenarios")


class BenchHook(BuildHookInterface[Any]):
    """Adds the folders of the bench to a wheel that is not editable."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Name the folders that the wheel takes in, and where they go."""
        if version != "editable":
            build_data["force_include"] |= {folder: f"fcl_sim/bench/{folder}" for folder in BENCH}
