"""`framegen guess`: right or undecided, and always a spec to go on with."""

import io
import sys
from functools import cache
from pathlib import Path
from random import Random

import pytest
from framegen.cli import main
from framegen.compile import Compiled, compile_spec
from framegen.guess.capture import MOST, Capture, read_capture
from framegen.guess.explained import explained
from framegen.guess.guess import Guess, guess
from framegen.guess.running import METHODS, checksum, running
from framegen.guess.spec_text import spec_text
from framegen.model.checksums import CHECKSUMS
from framegen.model.model import Model
from framegen.reading.source import Source
from hypothesis import given
from hypothesis import strategies as st

from tests.factories import BUSSERVO, compiled_file
from tests.few_each import few_each
from tests.in_turn import in_turn
from tests.protocols.specs import FILES
from tests.rows import ALIKE, Rows, some
from tests.unit.guess.traffic import traffic
from tests.unit.guess.truth import wrong

SPECS = {**FILES, "busservo": BUSSERVO}
# Its two ends speak in frames that have nothing in common.
MIXED = "everything"
# Where a single byte is a frame, too, many readings are tried.
TAKES_LONG = {"roboclaw"}
# Nor have those of one end, or what is in common is in no frame: no one kind explains them all.
IN_PART = {MIXED, "gauges", "roboclaw", "visca"}
# Nothing is found that says how long a frame is, and with a zero behind it its CRC is right again:
# where that is as long as another frame, it is taken for that.
LENGTHENED = {"modbus": "It explains 95.6 % of its 1901 bytes, as 190 frames."}
Capsys = pytest.CaptureFixture[str]


def model_of(protocol: str) -> Model:
    return compiled_file(SPECS[protocol]).model


def capture_of(*pieces: bytes) -> Capture:
    return Capture(b"".join(pieces), pieces)


@cache
def guessed(protocol: str) -> tuple[Guess, Capture]:
    """Guess by 200 frames of a protocol, as a raw recording has them."""
    data = b"".join(traffic(model_of(protocol), Random(7)))  # noqa: S311 - the same each time
    capture = capture_of(data)
    found = guess(capture)
    assert found is not None
    return found, capture


def compiled(found: Guess) -> Compiled:
    return compile_spec(Source("guess.yaml", spec_text(found, "line.bin")))


@pytest.mark.parametrize("protocol", some(SPECS, lambda name: name not in ALIKE | TAKES_LONG))
def test_what_200_frames_decide_is_right_and_makes_a_spec_that_explains_them(protocol: str) -> None:
    found, capture = guessed(protocol)
    assert wrong(found, model_of(protocol)) == []
    made = compiled(found)
    assert [finding.render(made.source) for finding in made.findings] == []
    if protocol not in IN_PART:
        all_of_it = f"It explains all of its {len(capture.data)} bytes, as 200 frames."
        share = explained(spec_text(found, "line.bin"), capture)
        assert share == LENGTHENED.get(protocol, all_of_it)
    if protocol in DECIDED:
        decided = {each.about: each.says for each in found.conclusions if each.is_decided}
        del decided["frames"]
        assert decided == DECIDED[protocol]


def test_frames_of_two_kinds_on_one_line_are_undecided() -> None:
    assert not any(each.is_decided for each in guessed(MIXED)[0].conclusions)
    assert compiled(guessed(MIXED)[0]).findings == []


# What 200 frames show of each: all of it would be no surprise, and none of it no help.
DECIDED = {
    "busservo": {
        "constants": "each begins 55 55",
        "length": "byte 2 is the size of the frame, less 2",
        "ids": "byte 3 says what a frame is",
    },
    "lxservo": {
        "constants": "each begins 55 55",
        "length": "byte 3 is the size of the frame, less 3",
        "checksum": "the last byte: `inverted sum`, of all from byte 2 on",
        "ids": "byte 4 says what a frame is",
    },
    "ubx": {
        "constants": "each begins B5 62",
        "length": "bytes 4 and 5, little-endian, are the size of the frame, less 8",
        "checksum": "the last 2 bytes: `fletcher-8`, little-endian, of all from byte 2 on",
    },
    # Nothing but its checksum shows where its frames begin.
    "modbus": {
        "constants": "nothing is the same in each",
        "checksum": "the last 2 bytes: `crc-16/modbus`, little-endian, of all from byte 0 on",
    },
    "crsf": {
        "constants": "each begins C8",
        "length": "byte 1 is the size of the frame, less 2",
        "checksum": "the last byte: `crc-8/dvb-s2`, of all from byte 2 on",
        "ids": "byte 2 says what a frame is",
    },
    # A byte that is covered is not sent.
    "mavlink1": {
        "constants": "each begins FE",
        "length": "byte 1 is the size of the frame, less 8",
        "checksum": "the last 2 bytes: `crc-16/mcrf4xx`, little-endian, of all from byte 1 on, and "
        "a byte that is not sent and follows from byte 5",
        "ids": "byte 5 says what a frame is",
    },
    "sbus": {"constants": "each begins 0F and each ends 00"},
}


def test_what_fits_equally_is_said() -> None:
    # With FF in front of each frame, the one over all of it is the other over the rest.
    checksum = guessed("mhz19")[0].conclusion("checksum")
    assert not checksum.is_decided
    assert [checksum.says, *checksum.others] == [
        "the last byte: `inverted sum`, of all from byte 0 on",
        "the last byte: `negated sum`, of all from byte 1 on",
    ]
    for says in (checksum.says, checksum.others[0]):
        assert f" {says}\n" in spec_text(guessed("mhz19")[0], "line.bin")


def test_a_length_that_may_have_a_high_byte_is_undecided() -> None:
    frames = [bytes([0xAA, size, 0, *range(size)]) for size in (3, 5, 9, 12, 3, 7) * 4]
    found = guess(capture_of(b"".join(frames)))
    assert found is not None
    length = found.conclusion("length")
    assert not length.is_decided
    assert [length.says, *length.others] == [
        "bytes 1 and 2, little-endian, are the size of the frame, less 3",
        "byte 1 is the size of the frame, less 3",
    ]


def test_where_frames_begin_is_undecided_when_the_recording_does_not() -> None:
    data = b"".join(traffic(model_of("sbus"), Random(3)))  # noqa: S311
    found = guess(capture_of(data[7:-9]))
    assert found is not None
    assert not found.conclusion("constants").is_decided


def text_of(frames: list[bytes]) -> bytes:
    """Return a recording with a frame a line."""
    return "\n".join(frame.hex(" ") for frame in frames).encode()


def test_lines_of_text_show_frames_where_nothing_else_does() -> None:
    chance = Random(5)  # noqa: S311
    # Each ends with the same byte, which others have, too.
    ends = chance.randbytes(1)
    frames = [chance.randbytes(chance.randint(2, 8)) + ends for _ in range(40)]
    frames[1:3] = [ends * 2 + frame for frame in frames[1:3]]
    found = guess(read_capture(text_of(frames)))
    assert found is not None
    assert list(found.reading.framing.frames) == frames
    # Those that have nothing in common are none.
    chance = Random(5)  # noqa: S311
    frames = [chance.randbytes(chance.randint(3, 9)) for _ in range(40)]
    assert guess(read_capture(text_of(frames))) is None


def test_a_recording_is_read_without_its_comments() -> None:
    text = b"# recorded of 'COM5'\n55 55 02 0F  # 0.000000 s, host: battery\n# quiet\n5555040f\n"
    capture = read_capture(text)
    assert capture.pieces == (bytes.fromhex("55 55 02 0F"), bytes.fromhex("55 55 04 0F"))
    assert read_capture(b"\x55\x55\xff") == capture_of(b"\x55\x55\xff")
    assert len(read_capture(b"\xff" * 2 * MOST).data) == MOST


@given(data=st.binary(max_size=60), times=st.integers(1, 8), other=st.binary(max_size=9))
def test_no_recording_is_too_strange(data: bytes, times: int, other: bytes) -> None:
    found = guess(capture_of(*[data] * times, other))
    if found is not None:
        assert compiled(found).findings == []


@pytest.mark.parametrize("seed", Rows([0], others=[1, 2]))
def test_noise_decides_nothing(seed: int) -> None:
    found = guess(capture_of(Random(seed).randbytes(2500)))  # noqa: S311
    assert found is None or not any(each.is_decided for each in found.conclusions)


@in_turn("method, width", lambda: METHODS)
@few_each
@given(data=st.binary(min_size=1, max_size=20))
def test_checksums_of_all_beginnings_are_those_of_the_catalogue(
    method: str, width: int, data: bytes
) -> None:
    row = CHECKSUMS[method]
    expected = [row.of(data[: size + 1], width) for size in range(len(data))]
    assert list(running(method, width, data)) == expected
    assert checksum(method, width, b"") == row.of(b"", width)


def test_the_command_prints_a_spec_to_go_on_with(tmp_path: Path, capsys: Capsys) -> None:
    line = tmp_path / "line.bin"
    frames = [*traffic(model_of("lxservo"), Random(7))]  # noqa: S311
    line.write_bytes(b"".join(frames[:60]))
    assert main(["guess", str(line)]) == 0
    printed = capsys.readouterr()
    assert printed.err == ""
    spec = tmp_path / "guessed.yaml"
    spec.write_text(printed.out, encoding="utf-8")
    assert main(["check", str(spec)]) == 0
    head, _, _ = printed.out.partition("framegen: 2")
    assert "It explains all of its" in head
    assert "#   checksum: the last byte: `inverted sum`, of all from byte 2 on\n" in head


def test_the_command_reads_standard_input(capsys: Capsys, monkeypatch: pytest.MonkeyPatch) -> None:
    text = text_of(traffic(model_of("busservo"), Random(7))[:60])  # noqa: S311
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(text)))
    assert main(["guess", "-"]) == 0
    assert "guessed from standard input. It explains all of" in capsys.readouterr().out


def test_the_command_says_that_nothing_is_to_be_seen(tmp_path: Path, capsys: Capsys) -> None:
    line = tmp_path / "line.bin"
    line.write_bytes(b"\x01\x02\xff")
    assert main(["guess", str(line)]) == 1
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err.startswith("undecided: nothing in ")


@pytest.mark.parametrize(
    ("content", "message"),
    [(None, "framegen: error: cannot read"), (b"", "framegen: error: "), (b" \n", "is empty")],
)
def test_a_file_of_no_use_is_refused(
    content: bytes | None, message: str, tmp_path: Path, capsys: Capsys
) -> None:
    line = tmp_path / "line.bin"
    if content is not None:
        line.write_bytes(content)
    assert main(["guess", str(line)]) == 2
    assert message in capsys.readouterr().err


def test_the_name_of_a_file_stays_in_its_comment() -> None:
    found, _ = guessed("busservo")
    text = spec_text(found, "a\nframegen: 9\x1b[2J")
    assert [line for line in text.splitlines() if "framegen: 9" in line or "\x1b" in line] == [
        "# A spec to begin from, guessed from a?framegen: 9?[2J."
    ]
