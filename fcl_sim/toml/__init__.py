"""TOML with places: what tomllib reads, and where in the text it stands.

In: texts. Out: `Entry`, a tree whose every key and value knows its span, or an
`InputFault` with the mend. What the keys mean is the business of who asks.
Imports diagnostics only.
Tests: tests/toml.
"""

from fcl_sim.toml.document import parse
from fcl_sim.toml.tree import Entry, finding

__all__ = ["Entry", "finding", "parse"]
