"""The page's script in a JavaScript engine that has no page: what it computes, without what it draws."""

import json
from importlib.resources import files

import quickjs

FOLDER = files("fcl_sim.report.html").joinpath("script")


class Script:
    """Files of the script, loaded; `call` a function of theirs with values, and get what it returns."""

    def __init__(self, *names: str) -> None:
        self._context = quickjs.Context()
        self._context.set_time_limit(20)  # an endless loop fails its test, and takes no more than this
        self._context.set_memory_limit(1 << 28)
        for name in names:
            self._context.eval(FOLDER.joinpath(name).read_text(encoding="utf-8"))

    def call(self, function: str, *values):
        """Return what comes of a function, or of an expression that is one; NaN and infinity are None."""
        arguments = ", ".join(json.dumps(each) for each in values)
        return json.loads(self._context.eval(f"JSON.stringify(({function})({arguments}) ?? null)"))
