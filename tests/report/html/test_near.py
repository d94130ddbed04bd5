"""Where samples are left out, what is told at the cursor lies between others, and says so by its sign."""

import pytest

from tests.report.html.scripts import Script

SCRIPT = Script("data.js", "numbers.js", "elements.js", "lanes.js", "maps.js", "rules.js", "sketch.js")

NEAR, EXACT, BEYOND = 2.0, 4.0, 9.0

LINE = """
const line = new Line(clockOf({ begin: 0, step: 1e9, count: 9 }, null), {
  kept: [0, 4, 8], values: Float64Array.from([0, 1, 0]), grain: 0,
});
const bare = () => ({ style: {}, classList: { toggle() {} }, getAttribute() {}, setAttribute() {} });
const made = { scan: 1, name: "base" };
const run = { told: made, name: "base", line: () => line, lineOf: () => line, unit: () => "m" };
"""

RULES = f"""(at) => {{ {LINE}
  const row = {{ line, element: bare(), value: bare(), mark: bare(), bar: bare(), cursor: bare() }};
  const rules = Object.create(Rules.prototype);
  Object.assign(rules, {{ rows: [row], caption: bare(), name: "r", run }});
  rules.point({{ window: [0, 8], at }});
  return [row.value.textContent, row.mark.textContent, rules.caption.textContent];
}}"""

MAP = f"""(at) => {{ {LINE}
  const axis = {{ input: "x", unit: "m" }};
  const told = {{ output: "u", unit: "kW", across: axis, up: axis }};
  const block = {{ inputs: {{ x: 0 }}, outputs: {{ u: 0 }}, idle: {{}} }};
  const map = Object.assign(Object.create(Characteristic.prototype), {{
    told, isMap: true, limits: [0, 1, 0, 1], spot: bare(), reading: bare(), picture: bare(),
    drawWay() {{}}, drawExits() {{}},
  }});
  map.follow(block, run, at);
  return map.reading.textContent;
}}"""

SKETCH = f"""(at) => {{ {LINE}
  const sketch = Object.assign(Object.create(Sketch.prototype), {{ run }});
  return sketch.reading("level", at);
}}"""


def plain(text):
    return text.replace("\N{NO-BREAK SPACE}", " ")


def test_a_degree_between_samples_is_told_as_near_and_so_is_how_many_rules_fire():
    value, mark, caption = SCRIPT.call(RULES, NEAR)
    assert (value, mark) == ("≈0.500", "maybe")
    assert plain(caption) == "r, run base: ≈1 of 1 rules fire at 2 s"


def test_a_degree_at_a_sample_is_told_as_it_is():
    value, mark, caption = SCRIPT.call(RULES, EXACT)
    assert (value, mark) == ("1.000", "fires")
    assert plain(caption) == "r, run base: 1 of 1 rules fire at 4 s"


@pytest.mark.parametrize(
    ("at", "text"),
    [
        (NEAR, "≈0.5 m, ≈0.5 m → ≈0.5 kW"),
        (EXACT, "1 m, 1 m → 1 kW"),
        (BEYOND, "\N{EN DASH}, \N{EN DASH} → \N{EN DASH}"),
    ],
)
def test_the_characteristic_tells_inputs_and_output_by_the_same_sign(at, text):
    assert plain(SCRIPT.call(MAP, at)) == text


@pytest.mark.parametrize(("at", "text"), [(NEAR, "≈0.5 m"), (EXACT, "1 m")])
def test_the_plant_is_read_by_the_same_sign(at, text):
    assert plain(SCRIPT.call(SKETCH, at)) == text
