"""fcl_sim: a test bench on which a fuzzy rule base in FCL (IEC 61131-7) is proved in closed loop.

Nothing heavy is imported until a name is used (PEP 562).
"""

__version__ = "0.1.0"
