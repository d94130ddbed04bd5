"""The controller as the standard describes it: frozen dataclasses, no behaviour; and the labels of rules.

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
    Member,
    Structure,
    Variable,
)
from fcl_sim.model.curves import Curve, CurveKind
from fcl_sim.model.expressions import Call, Expression, Function, Number, Operation, Operator, Reference
from fcl_sim.model.notes import Level, Note
from fcl_sim.model.operators import Accumulation, Activation, AndOperator, Hedge, Method, OrOperator
from fcl_sim.model.rules import And, Conclusion, Condition, Degree, Is, Not, Or, Rule, RuleBlock
from fcl_sim.model.terms import Formula, Point, Points, Shape, Singleton, Singletons, Term

__all__ = [
    "Accumulation",
    "Activation",
    "And",
    "AndOperator",
    "Call",
    "Conclusion",
    "Condition",
    "Curve",
    "CurveKind",
    "DataType",
    "Defuzzification",
    "Degree",
    "Expression",
    "Formula",
    "Function",
    "FunctionBlock",
    "Fuzzification",
    "Hedge",
    "Is",
    "Level",
    "Member",
    "Method",
    "Not",
    "Note",
    "Number",
    "Operation",
    "Operator",
    "Or",
    "OrOperator",
    "Point",
    "Points",
    "Reference",
    "Rule",
    "RuleBlock",
    "Shape",
    "Singleton",
    "Singletons",
    "Structure",
    "Term",
    "Variable",
]
