"""Findings named in the comments of a text, on the guilty lines."""

import re
from collections import Counter

CODE = re.compile(r"FCL\d{3}")


def expected(text):
    lines = enumerate(text.split("\n"), start=1)
    return Counter((number, code) for number, line in lines for code in CODE.findall(line))


def found(reading):
    return Counter(
        (place.span.line, diagnostic.code)
        for diagnostic in getattr(reading, "diagnostics", reading)
        for place in diagnostic.places
        if not place.label  # a place with a label is what the guilty one clashes with
    )
