"""The page on conformance: prose, and the tables that `fcl-sim conformance` prints."""

from fcl_sim.fcl.conformance_elements import ELEMENTS, Choice
from fcl_sim.fcl.conformance_figures import FIGURES
from fcl_sim.fcl.conformance_statement import TEXTS, read_statement
from fcl_sim.fcl.conformance_text import markdown_table, tables_markdown
from fcl_sim.fcl.targets import NAMES, shipped

HEAD = """\
# Conformance with IEC 61131-7

The standard (edition of 2000, clause 6) knows three levels: the Basic Level that every system has (Table
8), the Extension Level of which each has a part (Table 9), and the Open Level of everything else (Table
10). Table 11 is the list of data by which a transfer from one system to another is verified.

| command | prints |
|---|---|
| `fcl-sim conformance` | the tables below |
| `fcl-sim conformance FILE.fcl` | what level each function block needs, by which lines, and its Table 11 |
| `fcl-sim check --target plc.toml FILE.fcl` | every excess over what a PLC has, by line |
| `fcl-sim conformance --target NAME` | what a target says of itself |

This page is generated: `make docs`. S1, S2 and so on are the names of our readings of the standard where it
is open."""

STATEMENT = """\
## The statement of a PLC

`--target` takes a shipped statement by its name, or a file that an engineer fills in from a manual:

```toml
name   = "PLC 7 with the fuzzy option"
source = "programming manual, edition 4"
remarks = ["AND and OR without parentheses are taken from left to right (page 31)"]

[elements]                      # Tables 8 to 10
AND      = ["MIN", "PROD"]      # page 30
OR       = ["MAX"]
NOT      = []                   # there is none
METHOD   = ["CoGS", "CoG"]
RANGE    = true
VAR      = false

[data]                          # Table 11
data_types            = ["REAL", "INT"]
identifier_length     = 8
inputs                = 6
points_per_input_term = 4
execution_time        = "20 ms for 50 rules"

[differs]                       # there, but not as the standard says
WITH       = "before the activation"
METHOD.CoG = "from 100 samples"
```

What a manual does not say is left out: nothing is held against it, and what a rule base uses of it beyond
the Basic Level is told as a note. An element or data type that is not there and a limit that is passed are
errors, so that the exit code is 3; what the target makes something else of is a warning. The finding shows
the line of the statement with its comment: a comment is the place for the page of the manual.

### `[elements]`"""

ELEMENT_TAIL = """\
`DEFAULT = ["0"]` is a target that knows no other value than 0. `NOT` of a `subcondition` is `NOT x IS t`
and `x IS NOT t`. `output_terms` with points are areas. `conditions` with `concluded` are outputs and local
variables that stand in a condition with a term."""

DATA = """\
### `[data]`

Texts are told and held against nothing. Where there is no limit, the key is left out. Parentheses are
counted as they are written, with those that the priority of operators does not need."""

DIFFERS = """\
### `[differs]` and `remarks`

`KEY.VALUE = "…"` of an element with values, `KEY = "…"` of any. Where a rule base uses it, the text is told
as a warning. `remarks` are differences that no key can say: a check notes that there are some."""

SHIPPED = """\
## Shipped statements

Each line of a statement names its source: `fcl_sim/fcl/targets/*.toml`."""


def page() -> str:
    """Return the page in Markdown."""
    statements = [(f"`{name}`", read_statement(shipped(name))) for name in NAMES]
    parts = (
        HEAD,
        tables_markdown(),
        STATEMENT,
        markdown_table(("key", "values", "row"), _elements()),
        ELEMENT_TAIL,
        DATA,
        markdown_table(("key", "is"), _data()),
        DIFFERS,
        SHIPPED,
        markdown_table(
            ("name", "is", "source"), [(name, each.name, each.source) for name, each in statements]
        ),
    )
    return "\n\n".join(parts) + "\n"


def _elements() -> list[tuple[str, str, str]]:
    rows = []
    for key, element in ELEMENTS.items():
        values = "true, false"
        tables = {element.row("yes").table} if not isinstance(element, Choice) else set()
        if isinstance(element, Choice):
            values = ", ".join(f"`{each}`" for each in element.rows)
            tables = {element.row(each).table for each in element.rows}
        rows.append((f"`{key}`", values, "Table " + ", ".join(str(each) for each in sorted(tables))))
    return rows


def _data() -> list[tuple[str, str]]:
    told = [("`data_types`", "a list of types of inputs and outputs"), ("`line_comments`", "true, false")]
    told += [(f"`{key}`", f"a text: {words}") for key, words in TEXTS.items()]
    return told + [(f"`{key}`", f"the largest number: {each.title}") for key, each in FIGURES.items()]
