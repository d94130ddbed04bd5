"""Membership, fuzzy operators and defuzzification as kernels, on binary64 or binary32.

In: numbers, and stretches of a buffer. Out: degrees and values.
May import model and jit. Each kernel names its clause or table; the engine
puts them together. Tests: tests/arithmetic.
"""
