"""Comments stay with what they describe."""

from fcl_sim import fcl
from fcl_sim.diagnostics import Source
from tests.fcl.texts import BATH, changed

UGLY = """\
// Copyright somebody

(* header *)

function_block Ugly(*after name*)
(* io *)
VAR_INPUT (* process *)
  temp, (* first *) press : real; // both
\tbp1 : REAL := 1.50;   // one
\t                      // goes on
\tb : BOOL := 1;

\t// tuning
\tw: REAL := 1e-7; (* multi
\t                    line *)
END_VAR // end of in
VAR_OUTPUT valve : REAL; END_VAR VAR x : REAL; END_VAR
OPTIONS (* keep *) foo
   bar END_OPTIONS // of options
RULEBLOCK first (* rules *)
ACCU:MAX;
% accumulated
AND:MIN; OR : MAX;
 (* rule one *)
 RULE 1: IF temp IS cold (* a *)
      AND press IS NOT hi # b
      THEN valve IS open; (* c *) /* d */
/* 2 */ RULE 2 : IF b then x with 0.5;



 RULE 3: IF temp IS hot THEN valve IS shut; // long
 (* last in rules *)
END_RULEBLOCK (* /rules *)

(* fuzz *)
FUZZIFY temp
 TERM cold := (1,1),(bp1,0); // c
 TERM hot := (1,0)(bp1,1);   // much hotter
END_FUZZIFY
FUZZIFY press TERM hi := (0,0) (1,1); (* hi *) TERM lo := (0,1) (1,0); END_FUZZIFY
DEFUZZIFY valve
 DEFAULT := NC; (* why *)
 METHOD : LM; RANGE(0..1);
 TERM open := (0,0) (1,1); TERM shut := (0, 1) (1,0);

 (* end of valve *)
END_DEFUZZIFY
 (* nearly *)
END_FUNCTION_BLOCK (* bye *)
(* really *)
"""

TIDY = """\
// Copyright somebody

(* header *)

FUNCTION_BLOCK Ugly (*after name*)

(* io *)
VAR_INPUT (* process *)
    (* first *)
    temp, press: REAL; // both
    bp1: REAL := 1.5;  // one
                       // goes on
    b: BOOL := TRUE;

    // tuning
    w: REAL := 1.0E-7; (* multi
                          line *)
END_VAR // end of in

VAR_OUTPUT
    valve: REAL;
END_VAR

VAR
    x: REAL;
END_VAR

(* fuzz *)
FUZZIFY temp
    TERM cold := (1, 1) (bp1, 0); // c
    TERM hot  := (1, 0) (bp1, 1); // much hotter
END_FUZZIFY

FUZZIFY press
    TERM hi := (0, 0) (1, 1); (* hi *)
    TERM lo := (0, 1) (1, 0);
END_FUZZIFY

DEFUZZIFY valve
    RANGE := (0 .. 1);
    TERM open := (0, 0) (1, 1);
    TERM shut := (0, 1) (1, 0);
    METHOD: LM;
    DEFAULT := NC; (* why *)

    (* end of valve *)
END_DEFUZZIFY

RULEBLOCK first (* rules *)
    // accumulated
    AND: MIN;
    OR: MAX;
    ACCU: MAX;
    (* rule one *)
    (* a *)
    // b
    RULE 1: IF temp IS cold AND press IS NOT hi THEN valve IS open; (* c *) /* d */
    /* 2 */
    RULE 2: IF b THEN x WITH 0.5;

    RULE 3: IF temp IS hot THEN valve IS shut; // long
    (* last in rules *)
END_RULEBLOCK (* /rules *)

OPTIONS (* keep *) foo
   bar END_OPTIONS // of options

(* nearly *)
END_FUNCTION_BLOCK (* bye *)

(* really *)
"""


def rewritten(text, **options):
    return fcl.rewrite(Source("t", text), **options)


def test_every_comment_has_its_place():
    assert rewritten(UGLY) == TIDY
    assert rewritten(TIDY) == TIDY


def test_the_comments_of_a_structure_type_stay_inside():
    text = """\
(* types *) TYPE // all
lamp: (* inside *) STRUCT // of a lamp
  red: REAL; // stop
  (* go *)
  green: REAL;
  (* no more *)
END_STRUCT; // lamp
(* none *)
END_TYPE // end
"""
    written = rewritten(text + changed(("level: REAL;", "level: REAL; l: lamp;")))
    assert written.startswith("""\
(* types *)
TYPE // all
    (* inside *)
    STRUCT lamp // of a lamp
        red: REAL; // stop
        (* go *)
        green: REAL;
        (* no more *)
    END_STRUCT // lamp
    (* none *)
END_TYPE // end

FUNCTION_BLOCK bath
""")


def test_a_comment_of_what_is_not_written_goes_to_what_follows():
    text = changed(("VAR_OUTPUT", "VAR (* none *)\nEND_VAR // at all\n(* out *) VAR_OUTPUT"))
    assert "END_VAR\n\n(* none *)\n// at all\n(* out *)\nVAR_OUTPUT\n" in rewritten(text)


def test_the_last_comment_may_have_no_line_end():
    assert rewritten(f"{BATH.rstrip()} // end").endswith("END_FUNCTION_BLOCK // end\n")
    assert rewritten(f"{BATH}// end").endswith("END_FUNCTION_BLOCK\n\n// end\n")


def test_columns_of_comments_part_where_a_line_would_be_too_long():
    remark = f"(* {'long ' * 15}*)"
    text = changed(
        ("temp: REAL;", f"temp: REAL; {remark}"), ("level: REAL;", f"{'l' * 40}, level: REAL; (* x *)")
    )
    assert f"    temp: REAL; {remark}\n    {'l' * 40}, level: REAL; (* x *)\n" in rewritten(text)


def test_a_comment_in_a_name_of_several_words_goes_above():
    text = changed(("BLOCK bath", "BLOCK my (* odd *) bath-tub"), ("RULEBLOCK No1", "RULEBLOCK No/* one */1"))
    written = rewritten(text)
    assert written.startswith("(* odd *)\nFUNCTION_BLOCK my bath-tub\n")
    assert "/* one */\nRULEBLOCK No 1\n" in written


def test_a_block_from_elsewhere_gets_no_comments_and_loses_none():
    source = Source("t", UGLY)
    scanned = fcl.scan(source)
    comments = fcl.gather_comments(scanned, fcl.parse(scanned).tree)
    text = fcl.write(fcl.read(BATH).blocks, comments)
    assert text.startswith(fcl.write(fcl.read(BATH).blocks) + "\n// Copyright somebody\n")
    assert len(fcl.scan(Source("t", text)).comments) == len(scanned.comments) - 1  # of options
