"""The vocabulary of findings: every code, in one table.

FCL1xx scanning, FCL2xx parsing, FCL3xx resolving, FCL4xx what the engine
cannot evaluate; SCN scenarios, PLT plants, RUN the run and its surroundings.
"""

CODES: dict[str, str] = {}
