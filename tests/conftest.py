"""What every test shares: how hypothesis searches."""

from hypothesis import HealthCheck, settings

# No deadline: the first example may compile a kernel. Derandomised: a change,
# not the day, decides whether the tests pass.
settings.register_profile(
    "house", deadline=None, derandomize=True, suppress_health_check=[HealthCheck.too_slow]
)
settings.load_profile("house")
