"""What a capture is taken for, by whatever reads it: hex, the log of another program, raw bytes."""

import io
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

import pytest
from busservo import Direction, recordings, tables
from busservo._library import CODEC
from busservo.recordings import RecordingError
from framegen.audit.recording import read_recording
from framegen.cli import main as framegen_main
from framegen.guess.capture import read_capture
from framegen.reading.yamltree import Unusable
from framewire.codec.event_bytes import bytes_of
from framewire.codec.hextext import HexError, is_hex, read_hex
from framewire.command.recording import Recording
from framewire.command.usage_error import UsageError
from framewire.recording.form import LogError, log_lines, without_log
from framewire.tables.stats.statistics import statistics

from tests.commands import records, run
from tests.factories import BUSSERVO, compiled_file
from tests.hex_cases import HEX, LOGS, NO_HEX, NO_LOGS
from tests.in_turn import in_turn

MODEL = compiled_file(BUSSERVO).model
STOP = bytes.fromhex("55 55 02 07")
LINE = "55 55 02 07  # 0.5 s, host: ActionGroupStop()\n"

# The content of a file, and the bytes that it holds, None if it is refused.
FORMS: dict[str, tuple[bytes, bytes | None]] = {
    "hex": (b"55 55 02 07\n", STOP),
    "hex that ends in binary digits": (b"55 55 02 0b00000111", STOP),
    "a recording": (LINE.encode(), STOP),
    "hex with a mark": (b"\xef\xbb\xbf55 55 02 07", STOP),
    "hex as PowerShell writes it": ("\ufeff55 55 02 07\r\n".encode("utf-16-le"), STOP),
    "a recording in UTF-16": (f"\ufeff# \u00e9\n{LINE}".encode("utf-16-be"), STOP),
    "a comment that is no ASCII": ("# \u00e9\n55 55 02 07".encode(), STOP),
    "nothing": (b"", b""),
    "blanks": (b" \r\n", b""),
    "comments alone": (b"# nothing came\n", b""),
    "raw": (STOP, STOP),
    "the header alone": (b"U" * 1000, b"U" * 1000),
    "marks alone": (b":", b":"),
    "many marks": (b":-,;_\n" * 20, b":-,;_\n" * 20),
    "more marks than a line has": (b":" * 70_000, b":" * 70_000),
    "a mark of UTF-16 alone": (b"\xff\xfe", b"\xff\xfe"),
    "raw behind a mark of UTF-16": (b"\xff\xfeU\x00U", b"\xff\xfeU\x00U"),
    "words": (b"$GPGGA,123519,4807.038,N\r\n", b"$GPGGA,123519,4807.038,N\r\n"),
    "a comment with controls": (b"#UU\x02\x07", b"#UU\x02\x07"),
    "lines of a serial monitor": (b"TX: 55 55\nTX: 02 07\n", STOP),
    "lines of a logger": (b"2026-01-02 12:01:02,123 DEBUG x: sent b'UU\\x02\\x07'\n", STOP),
    "a table of two wires in UTF-16": ("\ufefft;tx\n0.5;55550207".encode("utf-16-le"), STOP),
    "a wire that says words": (b"TX: hello\n", b"TX: hello\n"),
    "a slip in a log": (b"RX: 55\nRX: 5G\n", None),
    "a slip": (b"55 55\n02 5G", None),
    "half a byte": (b"55 5", None),
    "a line that is cut": (f"{LINE}5".encode(), None),
}


def joined(entries: Iterable[recordings.Entry]) -> bytes:
    return b"".join(bytes_of(each.event) for each in entries)


def in_tables(batches: Iterable[dict[str, Any]]) -> int:
    """Return how many bytes the rows stand for; each begins where the one before ends."""
    rows = [row for made in batches for batch in made.values() for row in batch.to_pylist()]
    rows.sort(key=lambda row: row["offset"])
    size = 0
    for row in rows:
        assert row["offset"] == size
        size += row["size"]
    return size


def audited(content: bytes) -> bytes:
    recording = read_recording("line", content, [*MODEL.spec.endpoints], MODEL.roles)
    return b"".join(each.data for each in recording.stretches)


READERS: dict[str, Callable[[bytes], bytes]] = {
    "decode, stats and replay": lambda content: joined(
        Recording(io.BytesIO(content), "line", CODEC).entries("auto", None)
    ),
    "recordings.read": lambda content: joined(recordings.read(io.BytesIO(content))),
    "framegen audit": audited,
    "framegen guess": lambda content: b"".join(read_capture(content).pieces),
}
COUNTS: dict[str, Callable[[bytes], int]] = {
    "tables.read": lambda content: in_tables([tables.read(content).filled]),
    "tables.read_batches": lambda content: in_tables(tables.read_batches(io.BytesIO(content))),
    "stats": lambda content: statistics(CODEC, content).size,
}
REFUSALS = (RecordingError, Unusable, UsageError, ValueError)


@in_turn("name", lambda: FORMS)
def test_every_reader_takes_a_capture_for_the_same(name: str, tmp_path: Path) -> None:
    content, data = FORMS[name]
    file = tmp_path / "line"
    file.write_bytes(content)

    def scanned(_: bytes) -> int:
        return sum(in_tables(piece.read_batches()) for piece in tables.scan(file))

    readers = dict(READERS)
    readers["recordings.read of a file"] = lambda _: joined(recordings.read(file))
    counts = {**COUNTS, "tables.scan": scanned}
    if data is None:
        every: list[Callable[[bytes], object]] = [*readers.values(), *counts.values()]
        for reader in every:
            with pytest.raises(REFUSALS, match=r"line [12]\b|no hex|no time"):
                reader(content)
        return
    found = {name: read(content) for name, read in readers.items()}
    assert found == dict.fromkeys(readers, data)
    sizes = {each: count(content) for each, count in counts.items()}
    assert sizes == dict.fromkeys(counts, len(data))


# --- Hex -----------------------------------------------------------------------------------------
@in_turn("text, data", lambda: HEX)
def test_hex_of_any_usual_shape_is_read(text: str, data: str) -> None:
    assert read_hex(text) == bytes.fromhex(data)
    assert is_hex(text) == bool(data)


@in_turn("text", lambda: NO_HEX)
def test_what_is_no_hex_is_refused(text: str) -> None:
    with pytest.raises(HexError) as caught:
        read_hex(text)
    assert text[caught.value.at :].startswith(caught.value.wrong)
    assert not is_hex(text)


@in_turn(
    "text, problem",
    lambda: [
        ("5", "'5' is half a byte; did you mean 05?"),
        ("55 5G", "'G' in '5G' is no hex digit; write two digits a byte, like 0A 1B FF"),
        ("0x", "'0x' has no digits after it; write the byte whole, like 0x1B"),
        ("0x555", "'555' in '0x555' is 3 digits, which is no whole number of bytes; look for a d"),
        ("z" * 99, f"'z' in '{37 * 'z'}...' is no hex digit; write two digits a byte, "),
    ],
)
def test_malformed_hex_is_reported(text: str, problem: str) -> None:
    with pytest.raises(HexError) as caught:
        read_hex(text)
    assert str(caught.value).startswith(f"no hex: {problem}")


# --- Logs ----------------------------------------------------------------------------------------
BOTH = "12:00:59.5 TX: 55 55 02 07\n12:01:00.25 RX: 55 55 04\n12:01:00.5 RX: 0F 4C 1D\n"


def said(text: str) -> list[tuple[str, str]]:
    log = log_lines(text)
    assert log is not None, text
    lines = [log.read(line) for line in text.split("\n")]
    return [(way, read_hex(hex_).hex()) for line in lines for hex_, _, way in line]


@in_turn("text, pieces", lambda: LOGS)
def test_a_line_of_a_log_says_bytes_and_their_way(text: str, pieces: list[tuple[str, str]]) -> None:
    assert said(text) == pieces
    data = bytes.fromhex("".join(hex_ for _, hex_ in pieces))
    assert read_hex(without_log(text)) == data
    entries = list(recordings.read(io.BytesIO(text.encode())))
    size = sum(len(bytes_of(entry.event)) for entry in entries)
    assert (size, entries[-1].offset + len(bytes_of(entries[-1].event))) == (len(data),) * 2
    # Who sends is known where each line says it.
    if all(way for way, _ in pieces):
        senders = {{"tx": "host", "rx": "controller"}[way] for way, _ in pieces}
        assert {entry.sender for entry in entries} == senders


@in_turn("text, line, problem", lambda: NO_LOGS)
def test_what_is_not_clear_is_refused_in_its_line(text: str, line: int, problem: str) -> None:
    with pytest.raises(RecordingError, match=rf"^line {line}: .*{problem}"):
        list(recordings.read(io.BytesIO(text.encode()), form="hex"))
    for verb in ("decode", "explain"):
        status, _, errors = run(verb, text)
        assert (status, problem in errors) == (2, True)
    status, _, errors = run("explain", BUSSERVO, text, main=framegen_main)
    assert (status, "Traceback" in errors) == (2, False)


@in_turn("text", lambda: [text for text, _ in HEX] + NO_HEX)
def test_hex_is_no_log(text: str) -> None:
    assert log_lines(text) is None
    assert without_log(text) == text


def test_the_command_says_times_and_senders() -> None:
    found = records("decode", "--json", BOTH)
    assert [(each["time"], each["from"]) for each in found] == [(0, "host"), (1, "controller")]
    status, output, _ = run("explain", "TX:", *["55", "55", "02", "07"])
    assert (status, "ActionGroupStop" in output) == (0, True)
    line = "[12:01:02] 55 55 02 07"
    assert run("explain", BUSSERVO, line, main=framegen_main).status == 0


def test_lines_without_a_way_are_one_stream_of_the_given_end() -> None:
    text = "[23:59:59] 55 55\n[00:00:01.5] 02 07\n"
    # Either end may send such a message.
    for direction, sender in ((None, None), (Direction.HOST_TO_CONTROLLER, "host")):
        (entry,) = recordings.read(io.BytesIO(text.encode()), direction=direction)
        assert (entry.time, entry.line, entry.sender) == (2.5, 2, sender)


def test_a_clock_with_days_counts_them() -> None:
    text = "[2026-02-28 23:00:00] 55\n[2026-03-01T01:00:00.5] 02"
    log = log_lines(text)
    assert log is not None
    assert [log.read(line)[0][1] for line in text.split("\n")] == [0, 7200.5]
    with pytest.raises(LogError, match="2026-02-30 is no day"):
        log.read("[2026-02-30 23:00:00] 55")
