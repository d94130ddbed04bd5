"""The controller at work: a FunctionBlock becomes a Program, and a kernel evaluates it.

In: model.FunctionBlock and numbers. Out: Program, the kernel `infer`, outputs,
and explanations in the standard's words. May import arithmetic, model, jit and
diagnostics; it never sees fcl. Semantics: IEC 61131-7, 5.2.2 to 5.2.4, Annex A.
Tests: tests/engine, tests/laws, with tests/oracle.py as the second opinion.
"""
