"""What came over a line in pieces: its events with their times, and noise apart at each silence."""

from itertools import accumulate

from busservo._library import CODEC
from framewire.codec.event_bytes import bytes_of
from framewire.command.checks.heard import PAUSE, Heard

from tests.in_turn import in_turn

REPLY = "55 55 04 0F 4C 1D"
LATER = PAUSE + 0.001
# The seconds behind the piece before, and its bytes.
Pieces = list[tuple[float, str]]
# Pieces, the bytes that are left out; the events with when each was complete, the runs of noise.
CASES: dict[str, tuple[Pieces, range, Pieces, list[str]]] = {
    "a reply": ([(1.0, REPLY)], range(0), [(1.0, REPLY)], []),
    "a reply in pieces": (
        *([(1.0, "55 55 04"), (0.01, "0F 4C 1D")], range(0)),
        *([(1.01, REPLY)], []),
    ),
    "a reply with a silence in it": (
        *([(1.0, "55 55 04"), (LATER, "0F 4C 1D")], range(0)),
        *([(1.0 + LATER, REPLY)], []),
    ),
    "noise in pieces": ([(1.0, "00 01"), (0.01, "02")], range(0), [(1.01, "00 01 02")], ["000102"]),
    "noise before and behind a silence": (
        *([(1.0, "00 01"), (LATER, "02")], range(0)),
        *([(1.0, "00 01"), (1.0 + LATER, "02")], ["0001", "02"]),
    ),
    "a cut reply, a silence, and text": (
        *([(1.0, "55 55 04"), (LATER, "0D 0A 4F 4B")], range(0)),
        *([(1.0, "55 55 04"), (1.0 + LATER, "0D 0A 4F 4B")], ["555504", "0d0a4f4b"]),
    ),
    "a cut reply and text at once": (
        *([(1.0, "55 55 04 0D 0A 4F 4B")], range(0)),
        *([(1.0, "55 55 04 0D 0A 4F"), (1.0, "4B")], ["5555040d0a4f4b"]),
    ),
    "noise around a reply": (
        *([(1.0, f"00 {REPLY} 01")], range(0)),
        *([(1.0, "00"), (1.0, REPLY), (1.0, "01")], ["00", "01"]),
    ),
    "an echo, a silence, and noise": (
        *([(1.0, "55 55 02 0F"), (LATER, "00"), (LATER, "01")], range(4)),
        *([(1.0 + LATER, "00"), (1.0 + 2 * LATER, "01")], ["00", "01"]),
    ),
    "noise, an echo, and a silence": (
        *([(1.0, "00 55 55 02 0F"), (LATER, "01")], range(1, 5)),
        *([(1.0, "00"), (1.0 + LATER, "01")], ["00", "01"]),
    ),
    "a silence within an echo": (
        *([(1.0, "00 55 55"), (LATER, "02 0F 01")], range(1, 5)),
        *([(1.0, "00"), (1.0 + LATER, "01")], ["00", "01"]),
    ),
    "nothing": ([], range(0), [], []),
}


def timed(waited: list[tuple[float, bytes]]) -> list[tuple[float, bytes]]:
    """Return pieces with the times at which they come."""
    times = accumulate(wait for wait, _ in waited)
    return [(at, data) for at, (_, data) in zip(times, waited, strict=True)]


@in_turn("name", lambda: CASES)
def test_noise_has_no_silence_in_it_and_a_message_may(name: str) -> None:
    pieces, left_out, events, runs = CASES[name]
    heard = Heard(CODEC, timed([(wait, bytes.fromhex(data)) for wait, data in pieces]), left_out)
    found = [(round(at, 6), bytes_of(event).hex(" ").upper()) for at, event in heard.events]
    assert found == [(round(at, 6), data) for at, data in events]
    assert [b"".join(each.data for each in run).hex() for run in heard.runs] == runs
