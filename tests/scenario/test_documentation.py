"""The page on scenarios names every key and every metric, and its example runs."""

import re
from textwrap import dedent

from fcl_sim.judge.metrics import METRICS
from fcl_sim.loop.blocks import BLOCKS
from fcl_sim.scenario.reader import read
from fcl_sim.scenario.schema import json_schema
from fcl_sim.testbench import prepare
from tests.house.places import ROOT

PAGE = (ROOT / "docs" / "scenarios.md").read_text("utf-8")


def test_the_page_names_every_key_and_metric():
    words = set(re.findall(r"\w+", " ".join(re.findall(r"`[^`]*`", PAGE))))
    tables = [json_schema(), json_schema("controller"), *json_schema()["$defs"].values()]
    blocks = {
        f"{name.capitalize()}Table" for name in BLOCKS if name != "fuzzy"
    }  # they have a page of their own
    keys = {key for table in tables if table["title"] not in blocks for key in table.get("properties", {})}
    arguments = {each.name for metric in METRICS.values() for each in metric.arguments}
    assert (keys | set(METRICS) | arguments) - words == set()


def test_the_example_of_the_page_is_a_scenario(bench):
    example = dedent(re.search(r"(?:^    .*\n|^\n)+", PAGE[PAGE.index("    # scen") :], re.MULTILINE)[0])
    files = re.split(r"^# (scenarios/\S+)\n", example, flags=re.MULTILINE)[1:]
    for name, text in zip(files[::2], files[1::2], strict=True):
        (bench.folder / name).write_text(text, "utf-8")
    scenario = read(bench.folder / files[2])
    assert [each.variant for each in prepare(scenario)] == ["base", "light"]
