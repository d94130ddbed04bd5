"""A rule base as matrices (A.8 of IEC 61131-7): one for each output, a row and a column for each term.

In: the model's function blocks; tables in CSV or TOML. Out: matrices, as text, CSV or TOML; rules again.
What is a matrix: rules that take one term of each of two inputs, or of one. `*` stands for any term.
Imports model, toml and diagnostics only; never fcl: who wants a text of FCL writes the rules with it.
Tests: tests/matrix.
"""

from fcl_sim.matrix.matrix import ANY, Matrix
from fcl_sim.matrix.of_rules import Found, matrices
from fcl_sim.matrix.reader import read
from fcl_sim.matrix.to_rules import rules
from fcl_sim.matrix.writer import as_csv, as_text, as_toml

__all__ = ["ANY", "Found", "Matrix", "as_csv", "as_text", "as_toml", "matrices", "read", "rules"]
