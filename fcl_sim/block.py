"""Block: a function block that can be evaluated, and how one is loaded."""

import os
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Literal, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fcl_sim.concept.function_block import IntegerInstance, Scales
from fcl_sim.diagnostics import Diagnostic, InputFault, Place, nearest
from fcl_sim.diagnostics.spelling import listed
from fcl_sim.engine.assemble import assemble
from fcl_sim.engine.evaluate import Evaluation, checked_names, evaluate
from fcl_sim.engine.explain import Explanation
from fcl_sim.engine.instance import Instance
from fcl_sim.engine.narrow import narrowed
from fcl_sim.engine.precision import PRECISIONS, REAL
from fcl_sim.engine.program import Program
from fcl_sim.fcl import Reading, read, read_file
from fcl_sim.model import DataType, FunctionBlock

ARITHMETICS = (*PRECISIONS, "INT")
"""The arithmetics in which an instance can compute."""


@dataclass(frozen=True, eq=False)
class Block:
    """A function block with its program; `diagnostics` are the notes and warnings of its reading.

    `program` is that of LREAL; `program_in` gives that of another arithmetic.
    """

    function_block: FunctionBlock
    program: Program
    diagnostics: tuple[Diagnostic, ...] = ()

    @property
    def name(self) -> str:
        """Name of the function block."""
        return self.function_block.name

    @property
    def inputs(self) -> tuple[str, ...]:
        """Names of the inputs, in the order of their declaration."""
        return self.program.input_names

    @property
    def outputs(self) -> tuple[str, ...]:
        """Names of the outputs, in the order of their declaration."""
        return self.program.output_names

    @property
    def declared_arithmetic(self) -> str:
        """The arithmetic of its data types (S36): REAL where there is REAL and no LREAL, else LREAL.

        INT where all are INT, or SINT and USINT, whose numbers INT holds.
        """
        types = {each.type for each in (*self.function_block.inputs, *self.function_block.outputs)}
        if types <= {DataType.SINT, DataType.INT, DataType.USINT}:
            return "INT"
        return "REAL" if DataType.REAL in types and DataType.LREAL not in types else "LREAL"

    def __repr__(self) -> str:
        return f"<Block {self.name}: {', '.join(self.inputs)} -> {', '.join(self.outputs)}>"

    @overload
    def instance(  # type: ignore[overload-overlap]  # any other text makes the other
        self, arithmetic: Literal["INT"], *, scale: Scales | None = None, rounding: str = "truncate"
    ) -> IntegerInstance: ...

    @overload
    def instance(self, arithmetic: str = "LREAL") -> Instance: ...

    def instance(
        self, arithmetic: str = "LREAL", *, scale: Scales | None = None, rounding: str = "truncate"
    ) -> Instance | IntegerInstance:
        """Return a new instance with its own memory, in LREAL (binary64), REAL (binary32) or INT (S36).

        In REAL, the numbers of the rule base are rounded to binary32 as they
        are assembled, those of a call at the call. INT is that of the Concept
        FUZZY library: `scale` says by variable what a count is, its factor, or
        factor and offset; `rounding`, `truncate` or `round`, is of quotients.
        Raises InputFault for what an arithmetic cannot do.
        """
        if arithmetic == "INT":
            return IntegerInstance(self.function_block, scale, rounding)
        program = self.program_in(arithmetic)
        if scale is not None or rounding != "truncate":
            raise ValueError(f"scale and rounding are of INT, not of {arithmetic}")
        return Instance(narrowed(self.function_block, PRECISIONS[arithmetic]), program)

    def program_in(self, arithmetic: str) -> Program:
        """Return the program in LREAL or REAL; errors as in `instance`."""
        if arithmetic not in PRECISIONS:
            raise ValueError(f"no arithmetic {arithmetic}; there is {listed(ARITHMETICS)}")
        return self.program if arithmetic == "LREAL" else self._real

    @cached_property
    def _real(self) -> Program:
        return assemble(self.function_block, REAL)

    def evaluate(
        self,
        values: Mapping[str, ArrayLike],
        previous: Mapping[str, ArrayLike] | None = None,
        arithmetic: str = "LREAL",
    ) -> dict[str, NDArray[np.float64]]:
        """Return the outputs at every point of `values`, arrays that are broadcast; there is no state.

        NC gives `previous`, else the initial value. An input may be missing
        where an initial value is declared for it. In REAL inputs are rounded to
        binary32, and outputs are numbers of binary32. In INT they are counts,
        and `previous` is not taken. Raises TypeError for an
        unknown or missing variable, ValueError for a value that is not finite,
        with the variable and the first index (S37).
        """
        if arithmetic == "INT":
            checked_names(self.program, values, self._declared())
            return IntegerInstance(self.function_block).evaluate(values)
        return dict(self.evaluation(values, previous, arithmetic).outputs)

    def evaluation(
        self,
        values: Mapping[str, ArrayLike],
        previous: Mapping[str, ArrayLike] | None = None,
        arithmetic: str = "LREAL",
    ) -> Evaluation:
        """Return what `evaluate` does, and where any rule was active."""
        return evaluate(self.program_in(arithmetic), values, previous, self._declared())

    def explain(self, /, **values: float) -> Explanation:
        """Return one evaluation from the initial state, step by step; inputs and errors as in `evaluate`."""
        evaluate(self.program, values, None, self._declared())
        return self.instance().explain(**values)

    def _declared(self) -> frozenset[str]:
        return frozenset(each.name for each in self.function_block.inputs if each.initial is not None)


def load(path: str | os.PathLike[str], block: str | None = None) -> Block:
    """Return the function block in an FCL file; `block` names it where there are several (S16).

    Raises InputFault with every error of the file.
    """
    return _chosen(read_file(path), block, os.fspath(path))


def loads(text: str, name: str = "<text>", block: str | None = None) -> Block:
    """Return the function block in an FCL text that is called `name`; else as `load`."""
    return _chosen(read(text, name), block, name)


def load_all(path: str | os.PathLike[str]) -> dict[str, Block]:
    """Return all function blocks in an FCL file by name, in the order of the text.

    Raises InputFault with every error of the file.
    """
    reading = read_file(path)
    faults: list[Diagnostic] = []
    blocks = {}
    for each in _readable(reading):
        try:
            blocks[each.name] = Block(each, assemble(each), reading.diagnostics)
        except InputFault as fault:
            faults += fault.diagnostics
    if faults:
        raise InputFault(faults)
    return blocks


def _readable(reading: Reading) -> tuple[FunctionBlock, ...]:
    if any(each.is_error for each in reading.diagnostics):
        raise InputFault(reading.diagnostics)
    return reading.blocks


def _chosen(reading: Reading, wanted: str | None, file: str) -> Block:
    """Return the one block, or the one that is called `wanted`, as a Block."""
    blocks = _readable(reading)
    called = [each for each in blocks if wanted is None or each.name.casefold() == wanted.casefold()]
    if len(called) == 1:
        return Block(called[0], assemble(called[0]), reading.diagnostics)
    names = [each.name for each in blocks]
    places = tuple(Place(each.span) for each in blocks if each.span is not None) or (Place(file=file),)
    hint = f"there is {listed(names)}"
    if called:
        message = f"there are {len(called)} function blocks; say which one is meant"
        raise InputFault([Diagnostic(code="FCL422", message=message, places=places, hint=hint)])
    near = nearest(wanted or "", names)
    hint = f"did you mean `{near}`?" if near else hint
    message = f"there is no function block `{wanted}`"
    raise InputFault([Diagnostic(code="FCL423", message=message, places=places[:1], hint=hint)])
