"""Every metric is told by an example that is run."""

import doctest

import pytest

from fcl_sim.judge import effort, extent, integral, oscillation, response
from fcl_sim.judge.metrics import METRICS

MODULES = [effort, extent, integral, oscillation, response]


@pytest.mark.parametrize("module", MODULES, ids=lambda module: module.__name__.rpartition(".")[2])
def test_the_examples_hold(module):
    assert doctest.testmod(module).failed == 0


@pytest.mark.parametrize("metric", METRICS.values(), ids=lambda metric: metric.name)
def test_every_metric_has_an_example(metric):
    assert doctest.DocTestParser().get_examples(metric.take.__doc__)
