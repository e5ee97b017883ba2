"""Specs crossed with each other: whatever `framegen check` accepts is read alike by all.

Each seed is a spec that has parts, kinds of frames, fields, messages and names of others. It is
generated and imported, and reference, library, JavaScript and tables are asked the same questions;
each message must read as itself, also among others on a line. A failure shows the seed, the splices
and the command that repeats it alone.

`CROSSED=2000` takes as many specs instead, and CROSSED_SEED says with which they begin, as `make
fuzz` does.
"""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

import pytest

from tests.contract.crossed.held import faults
from tests.contract.crossed.scripts import Scripts
from tests.mutations.crossed import crossed
from tests.unit.site.reference import NODE

if TYPE_CHECKING:
    from collections.abc import Iterator

# So many are in every run, and so many more are slow tests.
EVERY, SLOW = 6, 9
FIRST = int(os.environ.get("CROSSED_SEED", "1"))
NUMBER = int(os.environ.get("CROSSED", str(EVERY + SLOW)))
SEEDS = [
    pytest.param(
        seed, marks=[] if seed < FIRST + EVERY or "CROSSED" in os.environ else pytest.mark.slow
    )
    for seed in range(FIRST, FIRST + NUMBER)
]

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
    spec = crossed(seed)
    found = faults(spec, scripts)
    if found:
        again = (
            f"CROSSED=1 CROSSED_SEED={seed} python -m pytest tests/contract/crossed/test_crossed.py"
        )
        pytest.fail("\n\n".join([f"seed {seed}: {spec.words}", *found, again]))


def test_a_good_part_of_them_is_accepted() -> None:
    made = [crossed(seed) for seed in range(FIRST, FIRST + min(EVERY, NUMBER))]
    assert sum(spec.tries for spec in made) < 10 * len(made)
