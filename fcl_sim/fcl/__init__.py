"""FCL in and out: text → tokens → syntax tree → model → text (IEC 61131-7, clause 5).

In: texts and files. Out: `Reading`, the model's FunctionBlocks and every finding with its place; texts again.
Each stage is a function (`scan`, `parse`, `resolve`) and its product can be shown (`show`).
Imports model and diagnostics only; never the engine. The grammar stands in the parse functions.
Tests: tests/fcl.
"""

from fcl_sim.fcl.comments import Comments, gather_comments
from fcl_sim.fcl.files import open_source, read_file
from fcl_sim.fcl.parser import Parsing, parse
from fcl_sim.fcl.reading import Reading, read
from fcl_sim.fcl.replace_rules import replace_rules
from fcl_sim.fcl.resolver import Resolution, resolve
from fcl_sim.fcl.rewrite import rewrite
from fcl_sim.fcl.scanner import scan
from fcl_sim.fcl.show import show_model, show_tokens, show_tree
from fcl_sim.fcl.tokens import Scan
from fcl_sim.fcl.tree import Tree
from fcl_sim.fcl.writer import write

__all__ = [
    "Comments",
    "Parsing",
    "Reading",
    "Resolution",
    "Scan",
    "Tree",
    "gather_comments",
    "open_source",
    "parse",
    "read",
    "read_file",
    "replace_rules",
    "resolve",
    "rewrite",
    "scan",
    "show_model",
    "show_tokens",
    "show_tree",
    "write",
]
