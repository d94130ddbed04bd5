"""One evaluation, step by step, as a figure in the manner of figures C.6 to C.15 of Annex C."""

from dataclasses import replace
from functools import partial

from fcl_sim.engine.explain import Explanation
from fcl_sim.model import FunctionBlock
from fcl_sim.report.alt_inference import of_inference
from fcl_sim.report.canvas import Figure
from fcl_sim.report.inference_rules import rule_strips
from fcl_sim.report.inference_variables import input_strips, output_strips
from fcl_sim.report.inference_view import Units, View, view
from fcl_sim.report.pictures import Picture, numbered
from fcl_sim.report.strips import Strip, parted, stacked
from fcl_sim.report.words import joined, one_line, with_unit

PAGE = 228.0
"""Height of what fits on a page of the report together with a caption, in mm."""


def draw(block: FunctionBlock, explanation: Explanation, units: Units | None = None) -> Figure:
    """Return an explanation of `block` as one figure, as high as it takes.

    Fuzzification of each input with its value as a line; for each rule that
    fired its subconditions, its degree and its activated conclusions;
    accumulation and defuzzification of each output with the result as a line.
    `units` are those of variables by name, letter case ignored.
    """
    return stacked(_strips(view(block, explanation, units)))


def picture(
    block: FunctionBlock, explanation: Explanation, units: Units | None = None, *, stem: str = "inference"
) -> Picture:
    """Return the figure of `draw` with its caption and its alternative text; `stem` is that of its file."""
    shown = view(block, explanation, units)
    return Picture(
        name=stem,
        caption=_caption(shown),
        alt=of_inference(shown),
        draw=partial(draw, block, explanation, units),
    )


def pictures(
    block: FunctionBlock, explanation: Explanation, units: Units | None = None, *, stem: str = "inference"
) -> list[Picture]:
    """Return what `picture` does in as many pictures as pages are needed."""
    whole = picture(block, explanation, units, stem=stem)
    pages = parted(_strips(view(block, explanation, units)), PAGE)
    if len(pages) == 1:
        return [whole]
    return [
        replace(
            whole,
            name=numbered(stem, index, len(pages)),
            caption=f"{whole.caption} Part {index + 1} of {len(pages)}.",
            draw=partial(stacked, page),
        )
        for index, page in enumerate(pages)
    ]


def _strips(shown: View) -> list[Strip]:
    return [*input_strips(shown), *rule_strips(shown), *output_strips(shown)]


def _caption(shown: View) -> str:
    values = [f"{one_line(each.name)} = {with_unit(each.value, each.unit)}" for each in shown.inputs]
    values += [f"{one_line(each.variable)} = {with_unit(each.value, '')}" for each in shown.brought]
    at = f" at {joined(values)}" if values else ""
    return (
        f"Inference of {one_line(shown.name)}{at}, step by step. Lines stand at the values, "
        "dots at degrees; what activation and accumulation leave is filled, or a stem."
    )
