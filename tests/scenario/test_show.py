"""A scenario shown: the base spelled out, variants by what differs."""

from fcl_sim.scenario.show import show_scenario


def test_a_scenario_is_shown_from_files_to_requirements(bench):
    text = show_scenario(bench.read(duration="30 s"))
    head, *_ = text.splitlines()
    assert head == "crane/transfer: Container crane, completed rule base: 25 m transfer"
    assert "  override: duration = 30 s\n" in text
    assert (
        "run base: Container crane, completed rule base: 25 m transfer\n"
        "  duration = 30 s\n"
        "  scan = 0.05 s\n"
        "  integration by dormand_prince, rtol 1e-08\n"
        "  plant crane = plants/crane\n"
        "  crane parameter load_mass = 20 t\n"
        "  crane parameter cable_length = 10 m\n"
        "  crane starts at position = -25 m\n"
        "  crane.power <- controller.power\n"
        "  controller.distance [m] <- crane.distance\n"
        "  controller.angle [deg] <- crane.angle\n"
        "  controller.power <- rules.power\n"
        "  controller.speed = differentiator(input = -distance, filter = 0.05 s)\n"
    ) in text
    assert "run double_scan: A scan of 100 ms instead of 50 ms\n  scan = 0.1 s\n\n" in text
    assert (
        "  CR-3: overshoot(crane.distance, final = 0 m) at most 0.1 m\n    expected to fail: raw_distance\n"
    ) in text


def test_everything_that_was_set_is_shown(bench):
    timing = {"latency": "10 ms", "jitter": "5 ms", "seed": 4, "cycle_time": "measured"}
    text = show_scenario(bench.read(timing=timing, integration={"scheme": "rk4", "step": "2 ms"}))
    for line in (
        "latency = 0.01 s",
        "jitter = 0.005 s",
        "seed = 4",
        "blocks take the measured cycle time",
        "integration by rk4, step 0.002 s",
    ):
        assert f"\n  {line}\n" in text
