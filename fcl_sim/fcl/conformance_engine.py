"""Table 11, the data check list, as we fill it in (clause 6.2)."""

from fcl_sim.fcl.conformance_figures import FIGURES
from fcl_sim.fcl.parse_conditions import DEEPEST
from fcl_sim.model import DataType

NO_LIMIT = "no limit"

TESTED = {
    "identifier_length": 1000,
    "inputs": 20,
    "terms_per_input": 100,
    "terms_of_inputs": 130,
    "points_per_input_term": 200,
    "points_of_inputs": 500,
    "outputs": 20,
    "terms_per_output": 100,
    "terms_of_outputs": 130,
    "points_per_output_term": 200,
    "points_of_outputs": 500,
    "rule_blocks": 20,
    "rules_per_block": 500,
    "subconditions": 200,
    "rules": 520,
    "subconclusions": 20,
    "nesting": DEEPEST,
}
"""The largest numbers that a test reads and evaluates, by the key of the figure."""

LIMITS = {"nesting": DEEPEST}
"""Figures that have a limit."""


def data_check_list() -> tuple[tuple[str, str], ...]:
    """Return the rows of Table 11: technical data, and our statement."""
    types = ", ".join(str(each) for each in DataType)
    return (
        ("data types of function block inputs and outputs", f"{types}; computed in LREAL, REAL or INT (S36)"),
        ("line comments in the FCL program", "YES: // to the end of the line (S13)"),
        ("execution time", "by machine and rule base: make bench measures it on yours"),
        ("memory requirements", "by rule base: fcl-sim show program prints it"),
        (
            "mapping of weighting factors and degrees onto integers",
            "none in LREAL and REAL; in INT the degree 1 is 10000",
        ),
        *((_title(key), _limit(key)) for key in FIGURES),
    )


def _title(key: str) -> str:
    title = FIGURES[key].title
    return title if key in {"identifier_length", "nesting"} else f"max. number of {title}"


def _limit(key: str) -> str:
    if key in LIMITS:
        return str(LIMITS[key])
    return f"{NO_LIMIT}; {TESTED[key]} tested"
