"""The levels of a line, and devices that print at their own rate."""

from hypothesis import given
from hypothesis import strategies as st

from tests.contract.independent.levels import received
from tests.contract.independent.strangers import Print, Stranger
from tests.in_turn import in_turn


@given(data=st.binary(max_size=40), rate=st.sampled_from([9600.0, 115200.0]))
def test_a_port_of_the_same_rate_reads_what_was_sent(data: bytes, rate: float) -> None:
    assert received(data, sent_at=rate, read_at=rate) == data
    # No port is exact: by up to two per cent, all bits are read as they are.
    assert received(data, sent_at=rate, read_at=rate * 1.02) == data
    assert received(data, sent_at=rate, read_at=rate * 0.98) == data


# Worked out on paper, by the levels of start bit, data and stop bit.
LEVELS = [
    # 00 11 00 11 00 11 00 11 00 11, read a level at a time; the first stop bit is low.
    ("55", 2.0, False, "66 E6"),
    # 0000000001 1111..., of which every second level is read.
    ("00", 0.5, False, "F8"),
    # 1 01010101 0 on a line that is low: it falls behind what was the start bit.
    ("55", 1.0, True, "55"),
    ("55 55", 1.0, True, "55 55"),
    ("FF", 1.0, True, "00"),
    ("00", 1.0, True, "00"),
]


@in_turn("sent, rate, inverted, read", lambda: LEVELS)
def test_a_port_reads_the_levels_by_its_own_rate(
    sent: str, rate: float, inverted: bool, read: str
) -> None:
    data = bytes.fromhex(sent)
    found = received(data, sent_at=9600, read_at=9600 * rate, inverted=inverted)
    assert found.hex(" ").upper() == read


def test_a_stranger_prints_at_its_times_and_begins_anew_when_it_resets() -> None:
    for resets, later in ((False, b"b"), (True, b"a")):
        stranger = Stranger(Print(1.0, b"a"), Print(2.0, b"b", 3.0), resets=resets)
        assert [stranger.read(at) for at in (0.5, 1.0, 2.5, 5.5)] == [b"", b"a", b"b", b"b"]
        stranger.opened(9600, 7.0)
        assert stranger.next_event == 8.0
        assert stranger.read(8.5) == later
