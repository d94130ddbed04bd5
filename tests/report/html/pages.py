"""Pages of runs that were never simulated, and what can be read of a page without a browser."""

from dataclasses import replace
from html.parser import HTMLParser

from fcl_sim.judge.verdict import Status
from fcl_sim.plant.declaration import Output, Parameter
from fcl_sim.report.html import page
from fcl_sim.testbench import Against, Outcome, Run
from tests.report.synthetic import CRANE, EVIL, LONG, outcome, run, trace, verdict

EMPTY = ("br", "col", "input", "link", "meta")


class Page(HTMLParser):
    """A page, read: its elements in their order, the texts of each kind; `open` must be empty at the end."""

    def __init__(self, text):
        super().__init__()
        self.text = text
        self.elements, self.open = [], []
        self.texts = {}
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attrs):
        self.elements.append((tag, dict(attrs)))
        if tag not in EMPTY:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        self.texts.setdefault(self.open[-1] if self.open else "", []).append(data)

    def attributes(self, name):
        """Return the values of an attribute, of all elements."""
        return [given[name] for _, given in self.elements if name in given]


def driven(made: Run) -> Run:
    """Return a run of a plant that is declared as the crane is, with the signals that move its sketch."""
    plant, found = made.diagram.plant, made.trace
    declared = replace(
        plant.model.declaration,
        outputs=(Output("position", "m", "of the trolley"), Output("angle", "deg", "of the load")),
        parameters=(Parameter("cable_length", "m", 10.0, "L", "[A]"),),
    )
    node = replace(plant, model=replace(plant.model, declaration=declared), parameters={"cable_length": 8.0})
    names = ("crane.position", "crane.angle", *found.names[2:])
    units = dict(zip(names, found.units.values(), strict=True))
    values = found.values.copy()
    values[:, 0] *= -1.0
    moved = replace(found, names=names, units=units, values=values)
    judged = (verdict(signal="crane.position"),)
    return replace(made, diagram=replace(made.diagram, plant=node), trace=moved, verdicts=judged)


def everything(folder) -> list[Outcome]:
    """Return outcomes with all that a page must show: long and evil names, a FAULT, nothing, an older run."""
    whole = trace()
    record = whole.fuzzy["controller.rules"]
    nothing = replace(
        whole,
        ticks=whole.ticks[:0],
        values=whole.values[:0],
        fuzzy={
            "controller.rules": replace(
                record, inputs=record.inputs[:0], outputs=record.outputs[:0], flags=record.flags[:0]
            )
        },
    )
    holes = trace()
    holes.values[40:60, 0] = float("nan")
    holes.values[70, 1] = float("inf")
    evil = outcome(
        folder,
        run(folder),
        run(folder, "ends_early", kind="fault"),
        run(folder, EVIL, kind="swings", title=EVIL),
        run(folder, LONG),
        title=EVIL,
        description=EVIL,
        fcl=CRANE.replace("figure", f"{EVIL} </script>"),
    )
    older = Against(label="an older one", runs={"base": run(folder, kind="swings")})
    return [
        replace(evil, against=older),
        outcome(folder, driven(run(folder)), title="Driven", name="driven"),
        outcome(
            folder, run(folder, trace=nothing, verdicts=[verdict(Status.INCONCLUSIVE, None)]), name="empty"
        ),
        outcome(folder, run(folder, trace=holes, verdicts=[verdict()]), name="holes"),
    ]


def page_of(folder) -> str:
    """Return the page of everything."""
    return page(everything(folder))
