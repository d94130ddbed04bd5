"""The JSON Schema of what the other commands print: findings, codes, evaluations, conformance."""

from fcl_sim.diagnostics import Severity
from fcl_sim.report.schema_parts import (
    Schema,
    by_name,
    figure,
    list_of,
    number,
    referring,
    table,
    text,
    texts,
    whole,
)

VERSION: Schema = {"const": 1, "description": "version of this form"}


def documents() -> Schema:
    """Return the whole documents by name."""
    return {
        "findings": _findings(),
        "codes": _codes(),
        "evaluation": _evaluation(),
        "conformance_tables": _tables(),
        "conformance": _conformance(),
    }


def definitions() -> Schema:
    """Return what the documents consist of, by name."""
    return {
        "finding": _finding(),
        "place": _place(),
        "code": _code(),
        "function_block": _function_block(),
        "feature": _feature(),
    }


def _findings() -> Schema:
    counts = {f"{each}s": whole(f"how many {each}s there are") for each in Severity}
    made = table(
        "What is wrong with rule bases: `fcl-sim check --json`",
        schema=VERSION,
        files={**texts(), "description": "the files that were looked at"},
        counts=table("the findings, counted", **counts),
        findings=list_of("the findings, in the order of the files", "finding"),
    )
    made["properties"] |= {"laws": list_of("with `--law`, those of each function block", "law")}
    return made


def _finding() -> Schema:
    made = table(
        "A finding",
        code=text("its code"),
        title=text("what the code means, in a line"),
        severity=_severity(),
        message=text("what is wrong"),
        hint=text("what would be right; may be empty"),
        places=list_of("where: the guilty place first", "place"),
    )
    made["properties"] |= {"proof": referring("proof", "what proves it, if it was proved")}
    return made


def _place() -> Schema:
    optional = {
        "line": whole("line of the first character, from 1"),
        "column": whole("its column, from 1, counted in characters"),
        "end_line": whole("line behind the last character"),
        "end_column": whole("column behind the last character"),
        "label": text("a remark on this place"),
    }
    made = table("A place; one in a file that was not read has its file alone", file=text("the file"))
    made["properties"] |= optional
    return made


def _codes() -> Schema:
    return table(
        "What codes mean: `fcl-sim explain --json`",
        schema=VERSION,
        codes=list_of("the codes that were asked for, or all", "code"),
    )


def _code() -> Schema:
    return table(
        "What a code means",
        code=text("the code"),
        title=text("in a line"),
        severity=_severity(),
        rule=text("clause of the standard, or our reading of it; may be empty"),
        means=text("what was found"),
        why=text("why it is a fault"),
        within=text("where the examples stand; empty where they are whole"),
        language=text("what the examples are written in"),
        bad=text("an example that has it"),
        mended=text("the same without it"),
    )


def _severity() -> Schema:
    return {"enum": [str(each) for each in Severity], "description": "how grave it is"}


def _evaluation() -> Schema:
    made = table(
        "One evaluation of a rule base: `fcl-sim eval --json`",
        schema=VERSION,
        block=text("name of the FUNCTION_BLOCK"),
        arithmetic={
            "enum": ["LREAL", "REAL", "INT", "fractions"],
            "description": "what it computed in; `fractions` with --exact",
        },
        inputs=by_name("the inputs that were given", number("")),
        outputs=by_name("the outputs", figure("")),
    )
    made["properties"] |= {
        "active": by_name("whether a rule was active, by output; not in INT", {"type": "boolean"}),
        "degrees": by_name("degree of each rule, by label; not in INT", number("")),
        "exact": {
            "type": "object",
            "description": "with --exact: inputs, outputs and degrees as texts such as 36/5, "
            "and what had to be `rounded`",
        },
        "explanation": {
            "type": "object",
            "description": "every step of the inference, with --explain: fuzzified, aggregated, ...",
        },
    }
    return made


def _tables() -> Schema:
    row = table(
        "a row; those of Table 11 have `data` in place of the first three",
        statement=text("what fcl_sim has"),
    )
    row["properties"] |= {
        "element": text("language element"),
        "keyword": text("its keyword"),
        "details": text("what the standard says of it"),
        "data": text("what the figure is of"),
    }
    rows = {"type": "array", "items": row}
    return table(
        "Tables 8 to 11 of IEC 61131-7 for fcl_sim: `fcl-sim conformance --json`",
        schema=VERSION,
        tables=by_name("their rows, by the number of the table", rows),
    )


def _conformance() -> Schema:
    return table(
        "What rule bases need of a PLC: `fcl-sim conformance FILE.fcl --json`",
        schema=VERSION,
        file=text("the file"),
        blocks=list_of("its function blocks", "function_block"),
    )


def _function_block() -> Schema:
    kinds: Schema = {"type": ["integer", "array"], "items": {"type": "string"}}
    return table(
        "What a function block needs",
        name=text("its name"),
        level=text("the level of conformance"),
        features=list_of("the language elements that it uses", "feature"),
        data=by_name("its figures, as Table 11 has them; `data_types` is a list", kinds),
    )


def _feature() -> Schema:
    return table(
        "A language element that is used",
        level=text("the level that it belongs to"),
        table=whole("the table that it stands in"),
        element=text("the element"),
        keyword=text("its keyword"),
        feature=text("what is used of it"),
        lines={"type": "array", "items": whole("line"), "description": "where"},
    )
