"""The JSON Schema of what is proved of a rule base: the evidence of a finding, control laws."""

from fcl_sim.proof.completeness import Certainty
from fcl_sim.proof.law import Course
from fcl_sim.report.schema_parts import (
    Schema,
    by_name,
    figure,
    list_of,
    number,
    or_null,
    reference,
    referring,
    table,
    text,
)
from fcl_sim.verify.edits import SETTING, TERM

SURE = ["exact", "sampled"]


def documents() -> Schema:
    """Return the whole documents by name."""
    return {"difference": _difference()}


def _difference() -> Schema:
    return table(
        "How far two rule bases are apart: `fcl-sim diff --json`",
        schema={"const": 1, "description": "version of this form"},
        old=text("the file that was there before"),
        new=text("the other"),
        threshold=figure(
            "from which difference on an output counts as different; null for a part of its range"
        ),
        outputs=list_of("their common outputs", "output_difference"),
        edits=list_of("terms and settings that are not the same", "edit_of_a_rule_base"),
    )


def _output_difference() -> Schema:
    return table(
        "How far two laws of an output are apart",
        output=text("the output"),
        unknown=text("why nothing is known; empty where it is"),
        threshold=number("from which difference on they count as different"),
        largest=or_null(referring("extreme", "the largest difference")),
        old=figure("the old value there"),
        new=figure("the new value there"),
        shown=or_null(referring("shown_difference", "where most of it shows, in few digits")),
        share_at_least=figure("the part of the universe in which they surely differ by more"),
        share_at_most=figure("the part in which they possibly do"),
        rules=list_of("the rules that fire there, and are not the same in both", "changed_rule"),
    )


def _shown_difference() -> Schema:
    return table(
        "A point at which two laws differ",
        inputs=by_name("inputs by name", {"type": "number"}),
        old=figure("the old value there"),
        new=figure("the new value there"),
    )


def _edit() -> Schema:
    return table(
        "A part of a rule base that is not the same",
        kind={"enum": [TERM, SETTING], "description": "what it is"},
        owner=text("its variable or rule block"),
        name=text("the term, or the keyword of the setting"),
        old=text("as it was; empty where it was not there"),
        new=text("as it is; empty where it is gone"),
    )


def _changed_rule() -> Schema:
    return table(
        "A rule that is not the same in both",
        side={"enum": ["old", "new"], "description": "in which it stands"},
        label=text("its label"),
        text=text("what it says"),
        degree=number("its degree of firing there"),
    )


def definitions() -> Schema:
    """Return what the documents consist of, by name."""
    return {
        "output_difference": _output_difference(),
        "changed_rule": _changed_rule(),
        "shown_difference": _shown_difference(),
        "edit_of_a_rule_base": _edit(),
        "proof": _proof(),
        "interval": _interval(),
        "law": _law(),
        "output_law": _output_law(),
        "slope": _slope(),
        "extreme": _extreme(),
        "dead_zone": _dead_zone(),
        "jump": _jump(),
        "saturation": _saturation(),
    }


def _proof() -> Schema:
    optional = {
        "variable": text("the input or output that it is about"),
        "rule": text("label of the rule that it is about"),
        "beside": text("label of the rule that it stands beside"),
        "witness": by_name("inputs at which an evaluation shows it", number("")),
        "witness_exact": by_name("the same as fractions, for `fcl-sim eval --exact`", text("")),
        "share": number("the part of the universe that it takes"),
        "share_exact": text("the same as a fraction, as in 179/288"),
        "boxes": {
            "type": "array",
            "description": "where, by input: boxes that are all of it together; one left out has any value",
            "items": by_name("a box", reference("interval")),
        },
        "more_boxes": {"type": "boolean", "description": "whether there are more boxes than are listed"},
    }
    told = "`exact`: so there and nowhere else; `bounded`: elsewhere perhaps, too"
    certainty: Schema = {"enum": [str(each) for each in Certainty], "description": told}
    made = table("What proves a finding", certainty=certainty)
    made["properties"] |= optional
    return made


def _interval() -> Schema:
    return table(
        "An interval",
        low=figure("its lower end; null without one"),
        high=figure("its upper end; null without one"),
        low_closed={"type": "boolean", "description": "whether the lower end belongs to it"},
        high_closed={"type": "boolean", "description": "whether the upper end belongs to it"},
    )


def _law() -> Schema:
    return table(
        "The control law of a function block",
        file=text("the file"),
        function_block=text("name of the FUNCTION_BLOCK"),
        outputs=list_of("its outputs", "output_law"),
    )


def _output_law() -> Schema:
    return table(
        "The control law of an output",
        output=text("the output"),
        unknown=text("why nothing is known; empty where it is"),
        least=or_null(referring("extreme", "its least value")),
        most=or_null(referring("extreme", "its largest value")),
        gains=list_of("along each input that its rules ask for", "slope"),
        at_zero=figure("what it is where all inputs are 0; null where they cannot be"),
        symmetry={"enum": ["odd", "even", ""], "description": "around there"},
        symmetry_proved={"type": "boolean", "description": "whether the rules show that; else samples do"},
        dead_zones=list_of("where it stays the same around there", "dead_zone"),
        jumps=list_of("the highest jump that was found along each input whose slope has no bound", "jump"),
        saturations=list_of("where it stays at an end of its reach", "saturation"),
    )


def _slope() -> Schema:
    points: Schema = {"type": "array", "items": by_name("inputs", number(""))}
    return table(
        "How an output goes along an input",
        variable=text("the input"),
        steepest=referring("extreme", "the steepest slope, with its sign; its bound is a magnitude"),
        course={"enum": [str(each) for each in Course], "description": "whether it rises, falls, or both"},
        witnesses={**points, "description": "where it rises, and where it falls, if it does both"},
    )


def _extreme() -> Schema:
    kinds = ["exact", "bounded"]
    told = "`exact`: the bound is reached; `bounded`: the truth is between"
    return table(
        "A largest or least value",
        reached=figure("what was reached"),
        bound=figure("beyond which it is nowhere; null without one"),
        certainty={"enum": kinds, "description": told},
        witness=by_name("inputs at which it was reached", number("")),
    )


def _dead_zone() -> Schema:
    return table(
        "Where an output stays what it is at 0",
        variable=text("the input along which"),
        low=number("from where"),
        high=number("to where"),
        certainty={"enum": SURE, "description": "`exact`, or of samples along the input"},
    )


def _jump() -> Schema:
    return table(
        "An output jumps along an input",
        variable=text("the input that rises through the jump"),
        before=figure("the output just before"),
        behind=figure("the output just behind"),
        without={"enum": ["before", "behind", ""], "description": "on which side no rule is active"},
        certainty={
            "enum": SURE,
            "description": "`exact`, or found by halving; others may be higher",
        },
        witness=by_name("inputs at the jump", number("")),
    )


def _saturation() -> Schema:
    return table(
        "Where an output stays at an end of its reach",
        value=number("what it is there"),
        share=figure("the part of the universe; null where that has no end"),
        share_exact=or_null(text("the same as a fraction")),
        boxes={
            "type": "array",
            "description": "where, by input; one left out has any value",
            "items": by_name("a box", reference("interval")),
        },
        more_boxes={"type": "boolean", "description": "whether there are more boxes than are listed"},
    )
