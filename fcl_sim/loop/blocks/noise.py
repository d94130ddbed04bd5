"""`noise`: white, or with a correlation time; drawn before the run, so that nothing else can change it."""

from math import exp, sqrt

from fcl_sim.jit import inlined
from fcl_sim.loop.blocks.declaration import BlockOutput, BlockParameter, BlockType, Like, Prepared
from fcl_sim.loop.blocks.setting import Setting
from fcl_sim.loop.row import Row, number, word, write

FIRST = 3


@inlined
def noise(row: Row) -> None:
    """Kernel of `noise`; its numbers are mean, sigma, correlation time, then a sample for each scan."""
    last = word(row, 0) - 1
    write(row, 0, number(row, FIRST + min(row.scan, last)))


def drawn(setting: Setting) -> list[float]:
    """Return a sample for each scan, the one at the end included."""
    values, random = setting.values, setting.random()
    whites = random.standard_normal(setting.scans + 1).tolist()
    mean, sigma, time = values["mean"], values["sigma"], values["correlation_time"]
    kept = exp(-setting.cycle / time) if time > 0.0 else 0.0
    fresh = sqrt(1.0 - kept * kept)
    state, samples = whites[0], []
    for i, white in enumerate(whites):
        state = kept * state + fresh * white if i else state
        samples.append(mean + sigma * state)
    return samples


def _prepare(setting: Setting) -> Prepared:
    samples = drawn(setting)
    return Prepared(numbers=samples, words=(len(samples),))


NOISE = BlockType(
    name="noise",
    summary="random numbers: white noise, or an Ornstein-Uhlenbeck process",
    equation=(
        "y_k = mean + sigma w_k; w_k = a w_{k-1} + sqrt(1 - a^2) n_k, w_0 = n_0, n_k independent and normal, "
        "a = exp(-T/tau), T nominal; tau = 0: a = 0, white. Stationary, and exact at the scans for any T. "
        "n_k are Philox's, from the seed of the scenario, the number of the run, the name of the block"
    ),
    source=(
        "Uhlenbeck, Ornstein: On the theory of the Brownian motion, 1930; "
        "Gillespie: Exact numerical simulation of the Ornstein-Uhlenbeck process, 1996"
    ),
    kernel=noise,
    parameters=(
        BlockParameter(name="mean", unit=Like("sigma"), default=0.0, meaning="mean"),
        BlockParameter(name="sigma", unit=None, minimum=0.0, meaning="standard deviation, with its unit"),
        BlockParameter(
            name="correlation_time",
            unit="s",
            default="0 s",
            minimum=0.0,
            meaning="tau, after which 37 % is left of a correlation; 0: each scan on its own",
        ),
    ),
    outputs=(BlockOutput(unit=Like("sigma")),),
    prepare=_prepare,
)
