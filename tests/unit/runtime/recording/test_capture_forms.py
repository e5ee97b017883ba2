"""Whatever reads a capture takes the same bytes for text, and those of the capture for raw."""

import io
from collections.abc import Callable, Iterable
from functools import partial
from pathlib import Path
from typing import Any

import pytest
from busservo import recordings, tables
from busservo._library import CODEC
from busservo.recordings import RecordingError
from framegen.audit.recording import read_recording
from framegen.guess.capture import read_capture
from framegen.reading.yamltree import Unusable
from framewire.codec.event_bytes import bytes_of
from framewire.command.recording import Recording
from framewire.command.usage_error import UsageError
from framewire.tables.stats.statistics import statistics
from hypothesis import given
from hypothesis import strategies as st

from tests.factories import BUSSERVO, compiled_file
from tests.handed import handed_by
from tests.hex_cases import HEX, NO_HEX
from tests.in_turn import in_turn

MODEL = compiled_file(BUSSERVO).model
STOP = bytes.fromhex("55 55 02 07")
LINE = "55 55 02 07  # 0.5 s, host: ActionGroupStop()\n"

# The content of a file, and the bytes that it holds, None if it is refused.
FORMS: dict[str, tuple[bytes, bytes | None]] = {
    "hex": (b"55 55 02 07\n", STOP),
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


def scanned(content: bytes, folder: Path) -> int:
    file = folder / "line"
    file.write_bytes(content)
    return sum(in_tables(piece.read_batches()) for piece in tables.scan(file))


def audited(content: bytes) -> bytes:
    recording = read_recording("line", content, [*MODEL.spec.endpoints], MODEL.roles)
    return b"".join(each.data for each in recording.stretches)


def decoded(content: bytes) -> bytes:
    return joined(
        Recording(io.BytesIO(content), "line", handed_by("busservo").codec).entries("auto", None)
    )


READERS: dict[str, Callable[[bytes], bytes]] = {
    "decode, stats and replay": decoded,
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
    counts: dict[str, Callable[[bytes], int]] = {
        **COUNTS,
        "tables.scan": partial(scanned, folder=tmp_path),
    }
    if data is None:
        readers: list[Callable[[bytes], object]] = [*READERS.values(), *counts.values()]
        for reader in readers:
            with pytest.raises(REFUSALS, match=r"line [12]\b|no hex|no time"):
                reader(content)
        return
    assert {reader: read(content) for reader, read in READERS.items()} == dict.fromkeys(
        READERS, data
    )
    assert {each: count(content) for each, count in counts.items()} == dict.fromkeys(
        counts, len(data)
    )


contents = st.one_of(
    st.binary(max_size=40),
    st.text(" \n\r,:;_-#", max_size=12).map(str.encode),
    st.sampled_from([text for text, _ in HEX] + list(NO_HEX)).map(str.encode),
    st.sampled_from([text for text, _ in HEX]).map(lambda text: f"\ufeff{text}".encode("utf-16")),
)


@given(content=contents)
def test_what_is_taken_for_raw_bytes_is_all_there(content: bytes) -> None:
    found: dict[str, bytes | int | None] = {}
    readers: dict[str, Callable[[bytes], Any]] = {**READERS, **COUNTS}
    for name, reader in readers.items():
        try:
            found[name] = reader(content)
        except REFUSALS:
            found[name] = None
    sizes = {len(each) if isinstance(each, bytes) else each for each in found.values()}
    assert len(sizes) == 1, found
    assert len({each for each in found.values() if isinstance(each, bytes)}) <= 1
