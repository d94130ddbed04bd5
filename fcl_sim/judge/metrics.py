"""The table of metrics: every figure that a requirement can bound, by name."""

from collections.abc import Mapping
from types import MappingProxyType

from fcl_sim.judge.effort import EFFORT
from fcl_sim.judge.extent import EXTENT
from fcl_sim.judge.integral import INTEGRAL
from fcl_sim.judge.metric import Metric
from fcl_sim.judge.oscillation import OSCILLATION
from fcl_sim.judge.response import RESPONSE

METRICS: Mapping[str, Metric] = MappingProxyType(
    {each.name: each for each in (*RESPONSE, *EXTENT, *INTEGRAL, *OSCILLATION, *EFFORT)}
)
