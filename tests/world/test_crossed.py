"""More specs crossed with each other than those of tests/contract/crossed/test_crossed.py.

`--sample 2000 --seed 5` takes the specs of so many seeds, the first of which is 5.
"""

import pytest

from tests.contract.crossed.scripts import Scripts
from tests.contract.crossed.test_crossed import SEEDS, read_alike, scripts
from tests.unit.site.reference import NODE

__all__ = ["scripts"]

# As many as there are without a sample: those behind the ones of every run.
OTHERS = range(SEEDS.stop, 16)

pytestmark = pytest.mark.skipif(NODE is None, reason="node is not installed")


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    """Have a test of each spec."""
    many, first = metafunc.config.option.sample, metafunc.config.option.seed
    metafunc.parametrize("seed", range(first, first + many) if isinstance(many, int) else OTHERS)


# Whatever the author of a spec deprecates is sent and answered all the same.
@pytest.mark.filterwarnings("ignore:.* is deprecated:DeprecationWarning")
def test_a_crossed_spec_is_read_alike_by_all(scripts: Scripts, seed: int) -> None:
    read_alike(scripts, seed)
