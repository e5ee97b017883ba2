"""The library names the protocols that are easily taken for it: by their frames, in any company."""

from collections.abc import Iterator
from typing import Any

import pytest
from busservo._library import CODEC
from framegen.model.checksums import CHECKSUMS
from framegen.model.model import Model
from framegen.targets.python.library_view import LibraryView
from framewire.explain.lookalikes import recognise
from hypothesis import given
from hypothesis import strategies as st

from tests.factories import BUSSERVO, data_of, files_of, layout_of, library
from tests.handed import handed_by
from tests.in_turn import in_turn
from tests.lines.servo_bus import frame
from tests.protocols.specs import FILES

SERVO_BUS = "LX-16A bus servo protocol"
DIALECT = "The dialect of LeArm and uHand boards"
MOVE = frame(1, 1, 0x20, 0x03, 0xE8, 0x03)
ASK = frame(7, 28)


@in_turn(
    "data, title",
    lambda: [
        (MOVE, SERVO_BUS),
        (ASK + MOVE + ASK, SERVO_BUS),
        # Cut at both ends, as whatever is listened to in the middle is.
        (MOVE[4:] + 2 * MOVE + MOVE[:5], SERVO_BUS),
        (MOVE[:-1] + bytes([MOVE[-1] ^ 1]), None),
        # Half of what came are its frames, just so, and a byte less than half.
        (b"\x00" * 10 + MOVE, SERVO_BUS),
        (b"\x00" * 11 + MOVE, None),
        (bytes.fromhex("55 55 02 01"), DIALECT),
        (bytes.fromhex("55 55 05 0A 01 02 03"), DIALECT),
        # A message of ours has command 8, too, and this is one.
        (bytes.fromhex("55 55 05 08 01 02 00"), None),
        (bytes.fromhex("55 55 02 63"), None),
        # A false header in front of frames of ours says that 85 bytes follow, and a command.
        (b"\x55" + 30 * bytes.fromhex("55 55 02 0F"), None),
        (bytes.fromhex("55 55 02 07"), None),
        (b"", None),
        (b"\x55", None),
        (2000 * b"\x55", None),
        (20 * bytes(range(256)), None),
    ],
)
def test_the_frames_of_a_look_alike_are_recognised(data: bytes, title: str | None) -> None:
    assert CODEC.recognise(data) == title


def test_a_spec_without_look_alikes_has_none() -> None:
    data = {key: value for key, value in data_of(BUSSERVO).items() if key != "lookalikes"}
    assert LibraryView(layout_of(data)).lookalikes.endswith(" = ()")


# Look-alikes by their checksums, each with a header of its own: the method, the type, what it
# covers, and the byte order of the numbers; that of the protocol is little.
PROVEN: dict[str, tuple[str, str, list[str], Any]] = {
    "C1": ("crc-16/modbus", "u16", ["length", "command", "parameters"], "little"),
    "C2": ("crc-16/xmodem", "u16", ["header", "length", "command", "parameters"], "big"),
    "C3": ("fletcher-8", "u16", ["command", "parameters"], "little"),
    "C4": ("crc-8/trinamic", "u8", ["parameters", "command"], "big"),
    "C5": ("word xor", "u16", ["length", "command", "parameters"], "little"),
    "C6": ("inverted sum", "u16", ["length", "command", "parameters"], "big"),
}


def proven_frame(header: str, parameters: bytes, spare: int = 0) -> bytes:
    method, type_, covers, order = PROVEN[header]
    parts = {
        "header": bytes.fromhex(header),
        "length": len(parameters).to_bytes(2, order),
        "command": bytes([9]),
        "spare": bytes([spare]),
        "parameters": parameters,
    }
    width = int(type_[1:])
    check = CHECKSUMS[method].of(b"".join(parts[name] for name in covers), width)
    return b"".join(parts.values()) + check.to_bytes(width // 8, order)


def proven_look_alike(header: str) -> dict[str, Any]:
    method, type_, covers, order = PROVEN[header]
    in_order = {"byte_order": order}
    frame = {
        "header": {"is": "constant", "bytes": header},
        "length": {"is": "length", "type": "u16", "counts": ["parameters"], **in_order},
        "command": {"is": "id", "type": "u8"},
        "spare": {"is": "reserved", "bytes": "00"},
        "parameters": {"is": "body"},
        "check": {"is": "checksum", "type": type_, "method": method, "covers": covers, **in_order},
    }
    example = {"title": "One", "hex": proven_frame(header, b"abc").hex(" ").upper()}
    said = {"title": f"By {header}", "about": "Its checksum.", "cite": "vendor"}
    return {**said, "frame": frame, "examples": [example]}


def with_proven_look_alikes() -> dict[str, Any]:
    data = data_of(BUSSERVO)
    data["lookalikes"] |= {f"proven_{each.lower()}": proven_look_alike(each) for each in PROVEN}
    return data


@pytest.fixture(scope="module")
def proven() -> Iterator[Any]:
    """Return what recognises them, of a library of its own."""
    with library(files_of(with_proven_look_alikes())) as made:
        yield handed_by(made.__name__).codec


@pytest.fixture(scope="module")
def proven_model() -> Model:
    return layout_of(with_proven_look_alikes())


@pytest.mark.parametrize("header", PROVEN)
@given(
    parameters=st.binary(max_size=20),
    times=st.integers(1, 4),
    at=st.integers(0),
    spare=st.integers(0, 255),
)
def test_a_look_alike_is_recognised_by_any_checksum(
    proven: Any,
    proven_model: Model,
    header: str,
    parameters: bytes,
    times: int,
    at: int,
    spare: int,
) -> None:
    frame = proven_frame(header, parameters, spare=spare)
    assert proven.recognise(times * frame) == f"By {header}"
    found = recognise(proven_model.protocol, frame)
    assert found is not None
    assert found.lookalike.title == f"By {header}"
    # Any bit of what it covers, or of the checksum itself.
    covered = [*range(1, 4), *range(5, len(frame))] if header != "C3" else range(5, len(frame))
    covered = range(5, len(frame)) if header == "C4" else covered
    place = [*covered][at % len(covered)]
    wrong = frame[:place] + bytes([frame[place] ^ 0x10]) + frame[place + 1 :]
    assert proven.recognise(wrong) is None
    assert recognise(proven_model.protocol, wrong) is None


def test_headers_of_a_look_alike_that_claim_much_are_not_summed_again_and_again(
    proven: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    summed = 0
    [found] = [each for each in proven.lookalikes if each.title == "By C2"]
    kind = type(found.methods[0].running())
    go_on = kind._go_on

    def counting(self: Any, data: bytes) -> None:
        nonlocal summed
        summed += len(data)
        go_on(self, data)

    monkeypatch.setattr(kind, "_go_on", counting)
    # Each of them says that some thousand bytes follow.
    data = bytes.fromhex("C2 10 00 09") * 3000
    assert proven.recognise(data) is None
    assert summed <= 2 * len(data)


@pytest.mark.parametrize("name", ["modbus", "ubx"])
def test_a_look_alike_in_frames_that_cannot_be_searched_for_is_left_out(name: str) -> None:
    data = data_of(FILES[name])
    said = {"title": "Another", "about": "Other ids.", "cite": next(iter(data["sources"]))}
    data["lookalikes"] = {"other": {**said, "commands": {200: "does something"}}}
    code = LibraryView(layout_of(data)).lookalikes
    assert ("methods=(Fletcher(16, 256),)" in code) == (name == "ubx")
    assert code.endswith(" = ()") == (name == "modbus")
