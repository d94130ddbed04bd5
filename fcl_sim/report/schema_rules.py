"""The JSON Schema of what is printed of a rule base that was tried: replays and mutants."""

from fcl_sim.mutation import Group
from fcl_sim.report.schema_parts import (
    Schema,
    by_name,
    figure,
    list_of,
    number,
    or_null,
    referring,
    table,
    text,
    whole,
)

TOOL: Schema = {"const": "fcl_sim", "description": "what wrote it"}


def documents(made_by: Schema) -> Schema:
    """Return the whole documents by name; `made_by` are the keys that tell what wrote one."""
    return {"replay": _replay(made_by["schema"]), "mutants": _mutants(made_by)}


def definitions() -> Schema:
    """Return what the documents consist of, by name."""
    return {
        "compared_output": _output(),
        "deviation": _deviation(),
        "fired_rule": _rule(),
        "survey": _survey(),
        "mutant": table("A change of a rule base that was refused", **_mutant()),
        "fate": _fate(),
    }


def _replay(version: Schema) -> Schema:
    return table(
        "Recorded inputs, put through a rule base: `fcl-sim replay --json`",
        schema=version,
        tool=TOOL,
        file=text("file of the rule base"),
        log=text("file of the recording"),
        function_block=text("name of the FUNCTION_BLOCK"),
        arithmetic={"enum": ["LREAL", "REAL", "INT"], "description": "what it computed in"},
        samples=whole("samples of the recording"),
        inputs=by_name("the column of each input", {"type": "string"}),
        outputs=list_of("the outputs that were compared", "compared_output"),
        rules=list_of("the rules that fire where an output first deviates", "fired_rule"),
        terms=by_name("degree of each term there, by input", by_name("", number(""))),
    )


def _output() -> Schema:
    return table(
        "An output beside its recording",
        variable=text("its name"),
        column=text("column of the recording"),
        tolerance=number("by how much it may differ"),
        compared=whole("samples that were compared"),
        deviating=whole("samples that deviate"),
        first=or_null(referring("deviation", "the first that deviates")),
        largest=or_null(referring("deviation", "the largest difference")),
    )


def _deviation() -> Schema:
    return table(
        "A sample beside its recording",
        sample=whole("its number, from 1"),
        time_ns=whole("when, in nanoseconds"),
        recorded=number("what was recorded"),
        replayed=figure("what came out"),
        difference=figure("the second less the first"),
    )


def _rule() -> Schema:
    return table(
        "A rule that fires",
        label=text("its label"),
        text=text("the rule"),
        degree=number("its degree of firing"),
    )


def _mutants(made_by: Schema) -> Schema:
    return table(
        "Benches against changed rule bases: `fcl-sim mutate --json`",
        **made_by,
        rule_bases=list_of("the rule bases", "survey"),
    )


def _survey() -> Schema:
    run = table("a run", scenario=text("the scenario"), variant=text("its variant"))
    groups = {each.name.lower(): whole(f"how many are {each}") for each in Group}
    kind = table("a kind of mutant", kind=text("the kind"), mutants=whole("how many"), **groups)
    return table(
        "A rule base and its mutants",
        file=text("its file"),
        function_block=text("name of the FUNCTION_BLOCK"),
        runs={"type": "array", "items": run, "description": "the runs that have it"},
        verdicts_not_pass=whole("verdicts that are not PASS without a mutation"),
        runs_without_baseline=whole("runs that have no baseline"),
        kinds={"type": "array", "items": kind, "description": "how many of each kind, by what came of them"},
        mutants=list_of("every mutant", "fate"),
        refused=list_of("changes that make no rule base", "mutant"),
    )


def _mutant() -> Schema:
    return {
        "kind": text("the kind of change"),
        "rule": or_null(text("label of the rule, where it is one")),
        "where": text("where it was changed"),
        "what": text("what was changed"),
        "line": or_null(whole("line in the file")),
        "column": or_null(whole("column in the file")),
    }


def _fate() -> Schema:
    killed = table(
        "what killed it",
        scenario=text("the scenario"),
        variant=text("its variant"),
        by=text("the requirement, or the baseline"),
        verdict=text("its verdict"),
    )
    found = table(
        "where its law differs most, among where the runs go",
        inputs=by_name("the inputs", number("")),
        output=text("the output"),
        before=figure("the output before"),
        after=figure("the output after"),
        share_of_range=figure("the difference as a part of the range"),
    )
    return table(
        "A mutant and what came of it",
        **_mutant(),
        group={"enum": [each.name.lower() for each in Group], "description": "what came of it"},
        killed_by=or_null(killed),
        largest_difference=or_null(found),
    )
