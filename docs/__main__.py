"""`python -m docs`: write the pages that are generated. A test compares them with what stands here."""

from pathlib import Path

from docs.blocks import page as blocks
from docs.conformance import page as conformance
from docs.figures import images as figures
from docs.gallery import images
from docs.gallery import page as gallery
from docs.metrics import page as metrics
from docs.results import page as results
from docs.units import page as units
from fcl_sim.diagnostics.page import FAMILIES, frame, page
from fcl_sim.diagnostics.page_text import families, page_markdown

FOLDER = Path(__file__).parent

BATH = """\
The FCL examples are lines of this rule base. Where one says "in" a section, it takes the place of what stands
there; "among the rules", that of the rules. Those with a FUNCTION_BLOCK of their own are whole."""


def pages() -> dict[str, str]:
    """Return every generated page and picture but those of runs, by its path below this folder."""
    written = {f"diagnostics/{_file(codes)}": _family(title, codes) for title, codes in families()}
    return (
        {
            "blocks.md": blocks(),
            "characteristics.md": gallery(),
            "conformance.md": conformance(),
            "metrics.md": metrics(),
            "results.md": results(),
            "units.md": units(),
            "diagnostics/README.md": _index(),
        }
        | written
        | images()
    )


def _file(codes: tuple[str, ...]) -> str:
    key = next(each for each in FAMILIES if codes[0].startswith(each))
    return f"{key.lower()}.md"


def _index() -> str:
    lines = [
        "# Findings, by their codes",
        "",
        "Every finding of fcl-sim has a code, and `fcl-sim explain CODE` prints its page. Errors stop a",
        "command, warnings and notes do not. A page names the clause of the standard that asks for it; where",
        "the standard leaves something open, it gives the number of our reading, S1 to S37.",
        "",
        "The pages are generated: [how to write one](../developing.md#diagnostics).",
    ]
    for title, codes in families():
        lines += ["", f"## [{title}]({_file(codes)})", "", "| code | | |", "|---|---|---|"]
        for code in codes:
            told = page(code)
            lines.append(f"| [{code}]({_file(codes)}#{code.lower()}) | {told.severity} | {told.title} |")
    return "\n".join(lines) + "\n"


def _family(title: str, codes: tuple[str, ...]) -> str:
    parts = [f"# {title}", "[All codes](README.md)"]
    if any(page(code).within and page(code).language == "fcl" for code in codes):
        parts += [BATH, f"```fcl\n{frame(complete=title == FAMILIES['FCL6']).rstrip()}\n```"]
    for code in codes:
        told = page(code)
        parts += [f"## {code}", f"**{told.title[0].upper()}{told.title[1:]}.**", page_markdown(told)]
    return "\n\n".join(parts) + "\n"


def main() -> None:
    """Write every generated page and the figures of runs; a family that is gone loses its page."""
    wanted = {FOLDER / name: text for name, text in (pages() | figures()).items()}
    for stale in set((FOLDER / "diagnostics").glob("*.md")) - set(wanted):
        stale.unlink()
    for file, text in wanted.items():
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, "utf-8")


if __name__ == "__main__":
    main()
