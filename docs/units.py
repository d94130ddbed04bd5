"""The page on units, made from the table that reads them."""

from fcl_sim.units import (
    ACCEPTED_SPELLINGS,
    ONE,
    OTHER_SPELLINGS,
    PREFIXED,
    PREFIXES,
    SYMBOLS,
    parse_unit,
    short,
)

NAMES = {
    "%": "per cent",
    "g": "gram",
    "t": "tonne",
    "m": "metre",
    "l": "litre",
    "s": "second",
    "min": "minute",
    "h": "hour",
    "d": "day",
    "Hz": "hertz",
    "N": "newton",
    "Pa": "pascal",
    "bar": "bar",
    "J": "joule",
    "Wh": "watt hour",
    "W": "watt",
    "A": "ampere",
    "V": "volt",
    "Ohm": "ohm",
    "K": "kelvin, and a difference of temperatures on any scale",
    "degC": "degree Celsius, a temperature",
    "mol": "mole",
    "rad": "radian",
    "deg": "degree of arc",
    "rpm": "revolutions per minute",
}
"""What each symbol is called."""

BASE = ("kg", "m", "s", "A", "rad", "mol", "K", "degC")
"""The unit of each dimension, in the order of `Dimension`."""

PREFIX_NAMES = {
    "G": "giga, 10⁹",
    "M": "mega, 10⁶",
    "k": "kilo, 10³",
    "h": "hecto, 10²",
    "d": "deci, 10⁻¹",
    "c": "centi, 10⁻²",
    "m": "milli, 10⁻³",
    "u": "micro, 10⁻⁶",
    "n": "nano, 10⁻⁹",
}
"""What each prefix is called, and its factor."""

HEAD = """\
# Units

Every number with a dimension is written as a text with its unit, `"50 ms"`, in scenarios, and without one in
a plant file, where the unit is declared beside it. Between the two it is converted exactly.

- A unit is a product of powers: `m/s2`, `kJ/K`, `W/m2 K`, `l/min`, `1/s`. A blank or `*` multiplies; `/`
  divides by all that follows up to the next `/`, so that `W/m2 K` is W/(m² K). `m2`, `m^2` and `m**2` are the
  same.
- What has no dimension has the unit `1`, or none: a plain number.
- The decimal separator is a point.
- **A difference of two temperatures in degC is in K**, and so are a band and a tolerance around one. In a
  product degC is such a difference: `%/degC` is `%/K`. degC alone is a scale with a zero of its own and
  converts to no other unit, K included.
- An angle is no plain number: an angular velocity is in `rad/s`, not in `1/s`.

| symbol | | is | prefixes |
|---|---|---|---|"""


TAIL = """\
## Prefixes

They stand before the symbols that the table above marks, without a blank: `kW`, `mbar`, `um`. `µ` is read
as `u`.

| | |
|---|---|"""


def page() -> str:
    """Return the page."""
    symbols = [f"| `{each}` | {NAMES[each]} | {_in_base(each)} | {_prefixed(each)} |" for each in SYMBOLS]
    prefixes = [f"| `{each}` | {PREFIX_NAMES[each]} |" for each in PREFIXES]
    read = [f"`{other}` for `{own}`" for other, own in OTHER_SPELLINGS.items() if other in ACCEPTED_SPELLINGS]
    told = [
        f"`{other}` (`{own}`)" for other, own in OTHER_SPELLINGS.items() if other not in ACCEPTED_SPELLINGS
    ]
    lines = [HEAD, *symbols, "", TAIL, *prefixes, "", "## Other spellings", ""]
    lines += [f"Read as well: {', '.join(read)}.", ""]
    lines += [f"Not read, but met with the unit in parentheses: {', '.join(told)}."]
    return "\n".join(lines) + "\n"


def _in_base(symbol: str) -> str:
    """Return a unit in the units of its dimensions."""
    scale, pi, dimension = SYMBOLS[symbol]
    base = ONE
    for name, exponent in zip(BASE, dimension, strict=True):
        base = base * parse_unit(name) ** exponent
    factor = f"π/{1 / scale}" if pi else short(float(scale))
    return f"{factor} {base.symbol}".strip()


def _prefixed(symbol: str) -> str:
    return "yes" if symbol in PREFIXED else ""
