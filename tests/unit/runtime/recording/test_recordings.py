"""Recordings are read back as they were made: who, when, what; wherever the file is cut."""

import io
from collections.abc import Iterable, Iterator
from itertools import pairwise

import busservo
import pytest
from busservo import ActionGroupCompleted, ActionGroupRun, Direction, Message, Noise, Reason
from busservo.recordings import Entry, RecordingError, read
from framewire.recording.form import LONGEST_LINE
from hypothesis import example, given
from hypothesis import strategies as st

from tests.hex_cases import HEX, NO_HEX
from tests.in_turn import in_turn
from tests.strategies import joined, lines

ASK, VOLTAGE = busservo.BatteryVoltageRead(), busservo.BatteryVoltage(7500)
HOST, BOARD = Direction.HOST_TO_CONTROLLER, Direction.CONTROLLER_TO_HOST


class Pieces:
    """A stream that brings bytes in these pieces, as a pipe does."""

    def __init__(self, pieces: Iterable[bytes]) -> None:
        self.pieces = iter(pieces)

    def read(self, size: int) -> bytes:
        piece = next((piece for piece in self.pieces if piece), b"")
        assert len(piece) <= size
        return piece


def entries(content: bytes | str, **how: object) -> list[Entry]:
    data = content.encode() if isinstance(content, str) else content
    return list(read(io.BytesIO(data), **how))  # type: ignore[arg-type]


def said(found: Iterable[Entry]) -> list[tuple[float | None, str | None, Message | Noise]]:
    return [(entry.time, entry.sender, entry.event) for entry in found]


def noise(data: bytes | str, reason: Reason) -> Noise:
    return Noise(bytes.fromhex(data) if isinstance(data, str) else data, reason)


# ---------------------------------------------------------------------------- recordings
STRANGE, SHORT = Reason.UNKNOWN_COMMAND, Reason.TOO_SHORT
RUN, STARTED = ActionGroupRun(group=8, times=1), busservo.ActionGroupStarted(group=8, times=1)
SAME = RUN.encode().hex(" ")
UNKNOWN = bytes.fromhex("55 55 03 01 2A")
MOVE = busservo.ServoMove(time_ms=100, targets=[(1, 600)])


@in_turn(
    "line, expected",
    lambda: [
        (f"{SAME}  # 1 s, host: a", [(1.0, "host", RUN)]),
        (f"{SAME}  # 1 s, controller: a", [(1.0, "controller", STARTED)]),
        (f"{SAME}  # 1 s, either: a", [(1.0, None, RUN)]),
        (f"{SAME}### 1.25 s, host: : #", [(1.25, "host", RUN)]),
        # What is no message of who sent it is none, whatever it is of the other end.
        (
            "55 55 04 0F 4C 1D  # 1 s, host: a",
            [(1.0, "host", noise(VOLTAGE.encode(), Reason.LENGTH_MISMATCH))],
        ),
        # What was noise once is no message now.
        (
            f"{MOVE.encode().hex()}  # 1 s, host noise: too short",
            [(1.0, "host", noise(MOVE.encode(), Reason.TOO_SHORT))],
        ),
        ("13  # 1 s, noise: bad header", [(1.0, "controller", noise("13", Reason.BAD_HEADER))]),
        ("13  # 1 s, either noise: odd", [(1.0, None, noise("13", Reason.BAD_HEADER))]),
        ("55  # 1 s, noise: unknown command", [(1.0, "controller", noise("55", STRANGE))]),
        (
            "55 55 03 01 2A  # 1 s, noise: unknown command",
            [(1.0, "controller", busservo.UnknownFrame(UNKNOWN, STRANGE))],
        ),
        # Its command was not known when it was received.
        ("55 55 02 0F  # 1 s, host noise: unknown command", [(1.0, "host", ASK)]),
        # Written by hand.
        (
            "55 55 02 0F 55 55 02 0F 55  # 1 s, host: twice",
            [(1.0, "host", each) for each in (ASK, ASK, noise("55", Reason.BAD_HEADER))],
        ),
        # A host's question is not the end of what the board began.
        ("55 55 05 08  # 1 s, noise: too short", [(1.0, "controller", noise("55550508", SHORT))]),
        ("  # 1 s, host: nothing", []),
        ("# quiet", []),
        ("", []),
    ],
)
def test_a_line_is_what_its_sender_can_have_sent(line: str, expected: list[object]) -> None:
    begun = "55 55 02 0F  # 0 s, host: BatteryVoltageRead()"
    first, *found, last = said(entries(f"{begun}\n{line}\r\n{begun}"))
    assert first == last == (0.0, "host", ASK)
    assert found == expected


def test_the_place_and_the_day_are_read() -> None:
    first, second, third = entries(
        "# recorded of 'COM7' from 2026-01-02 09:08:07.250000 +0100 on\n\n"
        "55 55 02 0F  # 0.5 s, host: a\n"
        "55 55 02 0F 13  # 0.75 s, host: a\n"
    )
    assert (first.place, first.line, first.offset, first.began) == ("line 3", 3, 0, 1767341287.25)
    assert (third.place, third.offset, third.direction) == ("line 4", 8, HOST)
    assert repr(second) == "Entry(line 4, time=0.75, sender='host', BatteryVoltageRead())"


@pytest.mark.parametrize("day", ["2026-02-31 00:00:00 +0000", "yesterday"])
def test_an_invalid_day_is_ignored(day: str) -> None:
    (entry,) = entries(f"# recorded of 'COM7' from {day} on\n55 55 02 0F  # 0.5 s, host: a\n")
    assert entry.began is None


NO_HEX_G = "no hex: 'G' in '5G' is no hex digit"
HALF = "no hex: '0' is half a byte; did you mean 00?; raw"
TOO_LONG = "it has more than 65536 characters"


@in_turn(
    "text, problem",
    lambda: [
        ("55  # 0 s, martian: a\n", "line 1: 'martian' is none of those who send: host,"),
        ("55  # 0 s, host: a\n\n55\n", "line 3: it has no time and sender, as in"),
        ("55\n55  # 0 s, host: a\n", "line 2: it has a time and a sender, and the lines before it"),
        ("55  # 0 s, host: a\n5G  # 0 s, host: a\n", f"line 2: {NO_HEX_G}"),
        ("5G  # 0 s, host: a\n", f"line 1: {NO_HEX_G}"),
        ("55 55\n02 # comment\n 0 \n", f"line 3: {HALF}"),
        (f"55  # 0 s, host: {LONGEST_LINE * 'a'}\n", f"line 1: {TOO_LONG}"),
        (f"55  # 0 s, host: a\n{LONGEST_LINE * '5'}5\n", f"line 2: {TOO_LONG}"),
    ],
)
def test_an_invalid_line_is_reported_with_its_number(text: str, problem: str) -> None:
    with pytest.raises(RecordingError) as caught:
        entries(text)
    assert str(caught.value).startswith(problem)


def test_there_is_no_other_form() -> None:
    with pytest.raises(ValueError, match="'csv' is none of the forms auto, hex, raw"):
        read("line.csv", form="csv")


# ---------------------------------------------------------------------------- streams
def test_a_stream_says_who_sent_what_only_one_end_can_have_sent() -> None:
    content = ASK.encode() + RUN.encode() + b"\x13" + VOLTAGE.encode()
    found = [(entry.sender, entry.offset, entry.place) for entry in entries(content)]
    senders = [("host", 0), (None, 4), (None, 11), ("controller", 12)]
    assert found == [(sender, offset, f"byte {offset}") for sender, offset in senders]


def test_quiet_ends_a_frame_in_plain_hex_too() -> None:
    events = [entry.event for entry in entries("55 55 05 08\n # quiet\r\n55 55 02 0F")]
    assert events == [noise("55 55 05 08", Reason.TOO_SHORT), ASK]
    (entry,) = entries("55 55 05 08\n # quieter\n08 01 00")
    assert entry.event == ActionGroupCompleted(group=8, times=1)


# ---------------------------------------------------------------------------- what it is


PARTS = [
    *(b"55 55 02 0F", b"55 55", b"05 08", b"5", b"\n", b" ", b"#", b"U", b"\x00", b"\xef\xbb\xbf"),
    *(b"  # 0.5 s, host: a", b"# 1 s, noise: too short", b"# quiet", b"\\x"),
]
contents = (
    st.sampled_from([text.encode() for text, _ in HEX] + [text.encode() for text in NO_HEX])
    | lines
    | lines.map(lambda line: line.hex(" ").encode())
    | lines.map(lambda line: line.hex().encode())
    | st.lists(st.sampled_from(PARTS)).map(b"".join)
)


def result_of(pieces: list[bytes]) -> tuple[str, list[object], list[Message | Noise]]:
    found: list[Entry] = []
    problem = ""
    try:
        found.extend(read(Pieces(pieces)))
    except RecordingError as error:
        problem = str(error).partition(":")[0]
    times = [(entry.time, entry.sender, entry.line) for entry in found]
    return problem, [*dict.fromkeys(times)], joined(entry.event for entry in found)


@given(contents, st.data())
@example(b"5555020F" * 3, None)
def test_chunking_does_not_change_what_it_holds(content: bytes, data: st.DataObject | None) -> None:
    cuts = [*range(1, len(content))]
    if data is not None:
        cuts = sorted(data.draw(st.lists(st.integers(0, len(content)), max_size=len(content))))
    pieces = [content[start:end] for start, end in pairwise([0, *cuts, len(content)])]
    (problem, *found), (problem_of_pieces, *found_in_pieces) = map(result_of, ([content], pieces))
    assert problem_of_pieces == problem
    assert problem or found_in_pieces == found


@in_turn("blank", lambda: ["", " "])
def test_a_line_of_hex_may_be_longer_than_any_buffer(blank: str) -> None:
    """5462 messages, of which the 64 KiB that are read first end within a byte."""
    content = blank.join(f"{each:02x}" for each in 5462 * VOLTAGE.encode()).encode()
    for first in (65535, 1):
        starts = [0, *range(first, len(content), 65536), len(content)]
        pieces = [content[start:end] for start, end in pairwise(starts)]
        assert [entry.event for entry in read(Pieces(pieces))] == 5462 * [VOLTAGE]


@pytest.mark.parametrize("form", ["timed", "hex", "one line", "raw"])
def test_no_file_is_held_as_a_whole(form: str) -> None:
    one = {
        "timed": b"55 55 04 0F 4C 1D  # 0.5 s, controller: BatteryVoltage(voltage_mv=7500)\n",
        "hex": b"55 55 04 0F 4C 1D\n",
        "one line": b"5555040F4C1D",
        "raw": VOLTAGE.encode(),
    }[form]
    taken = 0

    def pieces() -> Iterator[bytes]:
        nonlocal taken
        for _ in range(40):
            taken += 1
            yield one * (5000 // len(one))

    ahead = [taken * (5000 // len(one)) - number for number, _ in enumerate(read(Pieces(pieces())))]
    assert taken == 40
    assert max(ahead) * len(one) <= LONGEST_LINE + 5000
