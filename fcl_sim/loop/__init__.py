"""The closed loop: diagram → wiring → tape → trace.

In: a Diagram of a plant, blocks and wires by name. Out: a Trace with every
signal at every scan. May import block, concept, engine, plant, units, jit, diagnostics;
never control, fcl or judge. `run.run` is the whole way; `wiring.wire` refuses
what does not fit, `tape.lower` makes buffers of it, `simulate` runs them.
Tests: tests/loop, tests/laws.
"""
