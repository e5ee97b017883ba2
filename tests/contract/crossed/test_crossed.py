"""Specs crossed with each other: whatever `framegen check` accepts is read alike by all.

Each seed is a spec that has parts, kinds of frames, fields, messages and names of others. It is
generated and imported, and reference, library, JavaScript and tables are asked the same questions;
each message must read as itself, also among others on a line. A failure shows the seed, the splices
and the command that repeats it alone.

These are the first few; tests/world/test_crossed.py has others.
"""

from collections.abc import Iterator

import pytest

from tests.contract.crossed.held import faults
from tests.contract.crossed.scripts import Scripts
from tests.mutations.crossed import crossed
from tests.unit.site.reference import NODE

SEEDS = range(1, 7)

pytestmark = pytest.mark.skipif(NODE is None, reason="node is not installed")


@pytest.fixture(scope="module")
def scripts(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Scripts]:
    running = Scripts(tmp_path_factory.mktemp("scripts"))
    yield running
    running.close()


# Whatever the author of a spec deprecates is sent and answered all the same.
@pytest.mark.filterwarnings("ignore:.* is deprecated:DeprecationWarning")
@pytest.mark.parametrize("seed", SEEDS)
def test_a_crossed_spec_is_read_alike_by_all(scripts: Scripts, seed: int) -> None:
    read_alike(scripts, seed)


def read_alike(scripts: Scripts, seed: int) -> None:
    spec = crossed(seed)
    found = faults(spec, scripts)
    if found:
        again = f"python -m pytest tests/world/test_crossed.py --sample 1 --seed {seed}"
        pytest.fail("\n\n".join([f"seed {seed}: {spec.words}", *found, again]))


def test_a_good_part_of_them_is_accepted() -> None:
    made = [crossed(seed) for seed in SEEDS]
    assert sum(spec.tries for spec in made) < 10 * len(made)
