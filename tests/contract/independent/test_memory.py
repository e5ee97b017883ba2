"""Answers of other sizes, and answers that overtake each other: no read gets another's."""

from collections.abc import Iterator
from types import ModuleType

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.bad_specs import BASES
from tests.contract.independent.memory import BYTE, MemoryPort
from tests.factories import library, library_of
from tests.lines.timed_line import client_on

REPLY_TIMEOUT = 0.25
# A question of 7 bytes, and a reply of 4 and 64 at most: twice, since a late one is waited for;
# and each of three attempts that are in doubt.
BOUND = 5 * (REPLY_TIMEOUT + 75 * BYTE)


@pytest.fixture(scope="module")
def memory() -> Iterator[ModuleType]:
    """Return the library of a memory."""
    files = library_of(BASES / "memory.yaml")
    with library(files) as made:
        yield made


@pytest.mark.parametrize("by", [0.3, 0.5, 0.55, 0.6, 0.65, 0.7, 0.75, 0.8, 0.9])
def test_the_late_answer_of_another_size_is_dropped(memory: ModuleType, by: float) -> None:
    """Also where the right answer never comes, so that this is the only one."""
    port = MemoryPort({1: by, 2: 5.0})
    with client_on(port, memory.Controller, reply_timeout=REPLY_TIMEOUT) as host:
        with pytest.raises(memory.NoReplyError):
            host.read_bytes(16, count=2)
        with pytest.raises(memory.NoReplyError):
            host.read_bytes(16, count=1)
        assert host.read_bytes(16, count=1) == (3,)


@given(
    st.lists(st.sampled_from([1, 1, 2, 64]), min_size=4, max_size=10),
    st.dictionaries(st.integers(1, 6), st.floats(0.2, 1.0), max_size=1),
)
def test_a_read_gets_as_many_bytes_as_it_asks_for_and_never_goes_back(
    memory: ModuleType, counts: list[int], late: dict[int, float]
) -> None:
    port = MemoryPort(late)
    read = []
    with client_on(port, memory.Controller, reply_timeout=REPLY_TIMEOUT) as host:
        for count in counts:
            began = port.now
            try:
                found = host.read_bytes(16, count=count)
            except memory.NoReplyError:
                continue
            finally:
                assert port.now - began <= BOUND
            assert len(found) == count
            assert len(set(found)) == 1, "each byte is of one question"
            read.append(found[0])
    assert read == sorted(set(read)), "no number comes twice, or behind a later one"
    assert len(read) >= len(counts) - len(late)
