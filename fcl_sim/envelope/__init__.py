"""The envelope of a run: the same requirements at every point of a grid.

In: a Scenario and the name of a run that has a [vary]. Out: an Envelope, each
requirement judged over its points, the worst points with their traces; the
same on any number of threads. May import scenario, judge, loop, block.
Tests: tests/envelope.
"""
