"""A coverage-guided fuzzer of the FCL reader: no text raises, and none takes long.

python tests/fuzz/fuzz_fcl.py SECONDS FOLDER, or `make fuzz SECONDS=…`.
"""

import sys
import time
from pathlib import Path

import atheris

with atheris.instrument_imports(include=["fcl_sim.fcl", "fcl_sim.diagnostics"]):
    from fcl_sim import fcl
    from fcl_sim.diagnostics import Source
    from fcl_sim.diagnostics.render import render_all

TEXTS = Path(__file__).parent.parent / "fcl"
WORDS = (
    "FUNCTION_BLOCK", "END_FUNCTION_BLOCK", "VAR_INPUT", "VAR_OUTPUT", "VAR", "END_VAR", "TYPE", "END_TYPE",
    "STRUCT", "END_STRUCT", "FUZZIFY", "END_FUZZIFY", "DEFUZZIFY", "END_DEFUZZIFY", "RULEBLOCK",
    "END_RULEBLOCK", "OPTIONS", "END_OPTIONS", "TERM", "METHOD", "DEFAULT", "RANGE", "ACCU", "ACT", "AND",
    "OR", "NOT", "LOCK", "ENABLED", "RULE", "IF", "THEN", "IS", "WITH", "REAL", "NC", "nan", "inf", "very",
    "any", "FUNCTION", "Linear", "TRIAN", "GAUSS", "SINGLETONS", "Discrete", "Triangle", "CoGS", "MAX",
    ":=", "..", "(*", "*)", "/*", "*/", "//", "#", "%", "16#", "REAL#",
)  # fmt: skip
SECONDS_PER_CHARACTER = 1e-5  # a second per 100 kB
GRACE = 0.5


def read(data: bytes) -> None:
    """Read a text, render what is said of it, and show every stage."""
    text = data.decode("utf-8", errors="replace")
    begun = time.process_time()
    reading = fcl.read(text, "fuzz.fcl")
    taken = time.process_time() - begun
    if bool(reading.blocks) == bool(reading.errors):
        raise AssertionError("a text has blocks and errors, or neither")
    render_all(reading.diagnostics)
    for block in reading.blocks:
        fcl.show_model(block)
    scan = fcl.scan(Source("fuzz.fcl", text))
    fcl.show_tokens(scan)
    fcl.show_tree(fcl.parse(scan).tree)
    if taken > GRACE + SECONDS_PER_CHARACTER * len(text):
        raise AssertionError(f"{taken:.1f} s for {len(text)} characters")


def main(seconds: str, folder: str) -> None:
    """Fuzz for so many seconds; the corpus and what is found go to `folder`."""
    corpus = Path(folder) / "corpus"
    corpus.mkdir(parents=True, exist_ok=True)
    for file in TEXTS.rglob("*.fcl"):
        (corpus / f"{file.parent.name}-{file.name}").write_bytes(file.read_bytes())
    words = Path(folder) / "words.txt"
    words.write_text("".join(f'"{each}"\n' for each in WORDS))
    options = [
        f"-max_total_time={seconds}",
        f"-dict={words}",
        f"-artifact_prefix={folder}/",
        "-max_len=20000",
    ]
    atheris.Setup([sys.argv[0], str(corpus), *options, "-timeout=20", "-print_final_stats=1"], read)
    atheris.Fuzz()


if __name__ == "__main__":
    main(*sys.argv[1:])
