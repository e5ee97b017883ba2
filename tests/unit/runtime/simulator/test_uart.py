"""What a UART reads of bytes that were sent at another rate than its own."""

from __future__ import annotations

from random import Random

from busservo import BatteryVoltageRead
from busservo._library import LINK
from framewire.line.link import Link
from framewire.simulator.uart import sampled

from tests.in_turn import in_turn

ASK = BatteryVoltageRead().encode()


def read_by(data: bytes, sent_at: float, read_at: float, seed: int = 1, link: Link = LINK) -> bytes:
    return sampled(data, sent_at, read_at, link, Random(seed))  # noqa: S311 - to be repeated


@in_turn(
    "sent_at, read_at, read",
    lambda: [
        (9600, 9600, "55 55 02 0f"),
        # 3 % off is read all the same, and so the other way round.
        (9600, 9900, "55 55 02 0f"),
        (9900, 9600, "55 55 02 0f"),
        # 55 is 0101..., so that half of its bits at twice the rate are 0011... again and again.
        (9600, 19200, "66 66 66 86 00 fe 80"),
        # To a reader that is much faster, each low stretch is a break.
        (9600, 115200, "00 " * 13 + "00"),
        (38400, 9600, "48"),
        # Too short to be a start bit.
        (921600, 9600, ""),
    ],
)
def test_a_byte_is_sampled_bit_by_bit(sent_at: int, read_at: int, read: str) -> None:
    assert read_by(ASK, sent_at, read_at).hex(" ") == read


@in_turn("parity, lows", lambda: [("none", 0), ("even", 1), ("odd", 2), ("mark", 0), ("space", 3)])
def test_parity_is_a_bit_behind_those_of_the_byte(parity: str, lows: int) -> None:
    # C5 has four ones, and 83 three. Behind the highest of them, a reader that is twice as fast
    # takes a parity of 0 for a start bit: one more byte.
    link = Link(baud=9600, parity=parity)
    more = [len(read_by(bytes([byte]), 9600, 19200, link=link)) - 1 for byte in (0xC5, 0x83)]
    assert more == [lows & 1, lows >> 1]
