"""Proving a rule base without running it: what holds everywhere in the space of its inputs.

In: a FunctionBlock and the universe of its inputs. Out: gaps, rules and terms without effect, the
control law's bounds, each as data with a witness, and as findings. May import block, engine, fcl and
below; it knows no runs. Numbers are fractions, so that a ridge of no width is found.
Tests: tests/proof.
"""
