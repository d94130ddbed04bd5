"""A run as one page for a browser: nothing is fetched, so it works from a file.

In: Outcomes of testbench and how far they exercised the rule bases. Out: the
text of an HTML document. What is told stands in it as markup, and can be read
and printed without a script; the signals of all runs stand in it packed, and
`script/` draws them, moves a plant by a slider, shows the rules that fire.
May import what `report` may. Tests: tests/report/html.
"""

from fcl_sim.report.html.page import page

__all__ = ["page"]
