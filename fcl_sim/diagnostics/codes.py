"""The vocabulary of findings: every code, in one table.

FCL1xx scanning, FCL2xx parsing, FCL3xx resolving, FCL4xx what the engine
cannot evaluate; JDG judging, SCN scenarios, PLT plants, RUN the run and its surroundings.
"""

CODES: dict[str, str] = {
    "JDG101": "a requirement names a signal that the trace does not have",
    "RUN101": "the system refused to read or write",
    "RUN102": "the shipped bench is never written to",
    "RUN103": "the folder holds something already",
    "RUN104": "a trace has no such format",
    "RUN105": "there is no scenario",
}
