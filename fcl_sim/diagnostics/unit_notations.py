"""How people write units elsewhere: nothing of it is read, but hints lead from there to what is."""

from collections.abc import Mapping
from types import MappingProxyType

IN_WORDS: Mapping[str, str] = MappingProxyType(
    {
        other: own
        for own, others in {
            "s": "sek secs second seconds sekunde sekunden",
            "min": "mins minute minutes minuten",
            "h": "hrs std hour hours stunde stunden",
            "d": "day days tag tage",
            "ms": "msec msek",
            "m": "meter meters metre metres",
            "g": "gram grams gramm",
            "l": "liters litres",
            "%": "percent pct prozent",
            "deg": "degree degrees grad grd",
            "degC": "celsius",
            "K": "kelvin °k",
            "rad": "radian radians",
            "N": "newton",
            "W": "watt",
            "V": "volt",
            "A": "amp ampere",
            "Pa": "pascal",
            "Hz": "hertz",
            "rpm": "upm u/min umdr/min umdr./min r/min rev/min revs/min tr/min",
        }.items()
        for other in others.split()
    }
)
"""Words and notations of people, in lower case and without blanks: hints alone know them."""
OTHER_UNITS: Mapping[str, str] = MappingProxyType(
    {
        "kp": "9.80665 N",
        "kgf": "9.80665 N",
        "PS": "735.49875 W",
        "atm": "101325 Pa",
        "at": "98066.5 Pa",
        "psi": "6894.757 Pa",
        "inch": "25.4 mm",
        "ft": "0.3048 m",
        "lb": "0.45359237 kg",
    }
)
"""Units that are not read, and what one of them is: hints alone know them."""
