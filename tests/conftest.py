"""Hypothesis profiles: `ci`, the same examples in every run; `quick`, fewer of them; and `fuzz`, a
long search for others.

Chosen by HYPOTHESIS_PROFILE or --hypothesis-profile. No test sets max_examples of its own: that
would hold the search back.
"""

import os

from hypothesis import HealthCheck, settings

settings.register_profile("ci", derandomize=True, deadline=None, max_examples=100)
settings.register_profile("quick", derandomize=True, deadline=None, max_examples=20)
settings.register_profile(
    "fuzz",
    deadline=None,
    max_examples=5_000,
    print_blob=True,
    # What is rare is what is searched for here, and rare things are slow to draw.
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large],
)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "ci"))
