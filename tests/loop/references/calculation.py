"""Calculations once more, in plain Python."""

from tests.loop.block_bench import Case


def product(samples, times, cycle):
    return [a * b * c for a, b, c in zip(samples["1"], samples["2"], samples["3"], strict=True)]


def quotient(least, otherwise):
    def law(samples, times, cycle):
        pairs = zip(samples["input"], samples["by"], strict=True)
        return [above / below if abs(below) > least else otherwise for above, below in pairs]

    return law


CASES = [
    Case(block="product", inputs={"1": "wave", "2": "-ratio", "3": "wave"}, law=product),
    Case(block="division", inputs={"input": "wave", "by": "ratio"}, law=quotient(0.0, 0.0)),
    Case(block="division", inputs={"input": "wave", "by": "stairs"}, law=quotient(0.0, 0.0)),
    Case(
        block="division",
        inputs={"input": "wave", "by": "-stairs"},
        parameters={"least": "100 cm", "otherwise": "50 %"},
        law=quotient(1.0, 0.5),
    ),
]
