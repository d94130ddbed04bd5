"""FCL in: text → tokens → syntax tree → model (IEC 61131-7, clause 5).

In: texts and files. Out: `Reading`, the model's FunctionBlocks and every finding with its place.
Each stage is a function (`scan`, `parse`, `resolve`) and its product can be shown (`show`).
Imports model and diagnostics only; never the engine. The grammar stands in the parse functions.
Tests: tests/fcl.
"""

from fcl_sim.fcl.files import open_source, read_file
from fcl_sim.fcl.parser import Parsing, parse
from fcl_sim.fcl.reading import Reading, read
from fcl_sim.fcl.resolver import Resolution, resolve
from fcl_sim.fcl.scanner import scan
from fcl_sim.fcl.show import show_model, show_tokens, show_tree
from fcl_sim.fcl.tokens import Scan
from fcl_sim.fcl.tree import Tree

__all__ = [
    "Parsing",
    "Reading",
    "Resolution",
    "Scan",
    "Tree",
    "open_source",
    "parse",
    "read",
    "read_file",
    "resolve",
    "scan",
    "show_model",
    "show_tokens",
    "show_tree",
]
