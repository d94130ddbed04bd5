"""What the user writes: TOML → Scenario → Diagram.

In: a scenario file, the controller and rule bases it names, overrides. Out: a
Scenario with every variant spelled out, its Diagrams and Requirements; or every
fault at once, each with its place. May import judge, loop, block, plant, units
and diagnostics; alone in the house it knows pydantic. Tests: tests/scenario.
"""
