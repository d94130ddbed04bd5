"""The controller as the standard describes it: frozen dataclasses, no behaviour.

In: nothing. Out: FunctionBlock and what it is made of, the one meeting point
of the FCL reader, the engine and design verification. Imports diagnostics only,
for places in the text. Nouns and their clauses: IEC 61131-7, 5.2.
Tests: the rooms that fill and use it.
"""

from fcl_sim.model.block import (
    DataType,
    Defuzzification,
    FunctionBlock,
    Fuzzification,
    Variable,
)
from fcl_sim.model.operators import (
    Accumulation,
    Activation,
    AndOperator,
    Method,
    OrOperator,
)
from fcl_sim.model.rules import (
    And,
    Conclusion,
    Condition,
    Degree,
    Is,
    Not,
    Or,
    Rule,
    RuleBlock,
)
from fcl_sim.model.terms import Point, Points, Shape, Singleton, Term

__all__ = [
    "Accumulation",
    "Activation",
    "And",
    "AndOperator",
    "Conclusion",
    "Condition",
    "DataType",
    "Defuzzification",
    "Degree",
    "FunctionBlock",
    "Fuzzification",
    "Is",
    "Method",
    "Not",
    "Or",
    "OrOperator",
    "Point",
    "Points",
    "Rule",
    "RuleBlock",
    "Shape",
    "Singleton",
    "Term",
    "Variable",
]
