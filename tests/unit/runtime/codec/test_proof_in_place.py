"""Decoders test a checksum in place where the same test does for all frames; and do so rightly."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest
from framegen.model.codec import NotAFrame, decode, encode
from framegen.render import render_target
from framegen.targets import python
from framegen.targets.python.proof_view import proof_in_place

from tests.factories import compiled_values, data_in, library
from tests.in_turn import in_turn

if TYPE_CHECKING:
    from collections.abc import Callable

    from framegen.compile import Compiled

HEADER = {"is": "constant", "bytes": "AA 55", "about": "The start."}
LENGTH = {"is": "length", "type": "u8", "counts": ["length", "id", "body"], "about": "Bytes."}
ID = {"is": "id", "type": "u8", "about": "The message."}
HIDDEN = {"is": "id", "type": "u8", "sent": False, "about": "Known to both ends."}
BODY = {"is": "body", "about": "The fields."}
GAP = {"is": "reserved", "bytes": "00", "about": "Nothing."}
END = {"is": "constant", "bytes": "7E", "about": "The end."}
ALL = ["length", "id", "body"]


def checksum(method: str, covers: list[str], type_: str = "u8", order: str = "little") -> Any:
    """Return a part that is a checksum."""
    said = {"is": "checksum", "type": type_, "method": method, "covers": covers, "about": "A sum."}
    return said if type_ == "u8" else {**said, "byte_order": order}


def sealed(*tail: Any) -> Any:
    """Return an envelope with these parts behind its fields, named one after the other."""
    return {
        "header": HEADER,
        "length": LENGTH,
        "id": ID,
        "body": BODY,
        **{f"end{number}": part for number, part in enumerate(tail)},
    }


def one(
    method: str, type_: str = "u8", order: str = "little", *behind: Any, covers: list[str] = ALL
) -> Any:
    """Return an envelope with one checksum behind its fields, and these parts behind that."""
    return sealed(checksum(method, covers, type_, order), *behind)


INVERTED = checksum("inverted sum", ALL)
BEGUN = {"header": HEADER, "length": LENGTH, "id": ID, "body": BODY}
WITH_HIDDEN = {**one("inverted sum", covers=[*ALL, "extra"]), "extra": HIDDEN}
BEHIND_A_LENGTH = {
    "length": LENGTH,
    "header": HEADER,
    "id": ID,
    "body": BODY,
    "end": checksum("inverted sum", ["id", "body"]),
}

# The frames of a protocol, and the test that its decoders make; none where frames differ.
_U16 = "frame[-2] | frame[-1] << 8"
CASES = {
    "inverted": (one("inverted sum"), "total=0xFE"),
    "negated": (one("negated sum"), "total=0xFF"),
    "behind a gap": (
        {"header": HEADER, "gap": GAP, **one("inverted sum")},
        "sum(frame[3:]) & 0xFF == 0xFF",
    ),
    "behind a length and a constant": (BEHIND_A_LENGTH, "sum(frame[3:]) & 0xFF == 0xFF"),
    "in front": (
        {"header": HEADER, "sum": INVERTED, **BEGUN},
        "~sum(frame[3:]) & 0xFF == frame[2]",
    ),
    "in front of an end": (
        one("inverted sum", "u8", "little", END),
        "~sum(frame[2:-2]) & 0xFF == frame[-2]",
    ),
    "plain": (one("sum"), "sum(frame[2:-1]) & 0xFF == frame[-1]"),
    "of all": (one("sum", covers=["header", *ALL]), "sum(frame[:-1]) & 0xFF == frame[-1]"),
    "two bytes": (one("negated sum", "u16"), f"-sum(frame[2:-2]) & 0xFFFF == {_U16}"),
    "two bytes, big": (
        one("crc-16/modbus", "u16", "big"),
        "_checksum_of(frame[2:-2]) == frame[-1] | frame[-2] << 8",
    ),
    "four bytes": (
        one("crc-32/iso-hdlc", "u32", "big"),
        '_checksum_of(frame[2:-4]) == int.from_bytes(frame[-4:], "big")',
    ),
    "divided on": (
        one("crc-16/modbus", "u16", covers=["header", *ALL]),
        "_checksum_of(frame) == 0x0",
    ),
    "divided on, inverted": (one("crc-16/ibm-sdlc", "u16"), "_checksum_of(frame[2:]) == 0xF47"),
    "divided on, big": (one("crc-16/genibus", "u16", "big"), "_checksum_of(frame[2:]) == 0xE2F0"),
    "divided on, four bytes": (
        one("crc-32/iso-hdlc", "u32"),
        "_checksum_of(frame[2:]) == 0x2144DF1C",
    ),
    "one byte": (one("crc-8/maxim-dow"), "_checksum_of(frame[2:-1]) == frame[-1]"),
    "seven bits": (one("negated sum-7"), "_checksum_of(frame[2:-1]) == frame[-1]"),
    "of words": (one("word sum", "u16"), f"_checksum_of(frame[2:-2]) == {_U16}"),
    "two checksums": (sealed(checksum("sum", ALL), checksum("xor", ALL)), None),
    "two stretches": (one("inverted sum", covers=["length", "body"]), None),
    "what is not sent": (WITH_HIDDEN, None),
    "no checksum": (sealed(), None),
}


MADE_UP = """
framegen: 2
protocol: {name: made_up, title: Made up, version: 1.0.0, authority: paper, summary: For the tests.}
sources: {paper: {title: A paper, kind: document}}
endpoints: {sensor: Reports., host: Listens.}
link: {baud: 9600, cite: "paper, 2"}
byte_order: little
"""


def spec_of(**frames: Any) -> Any:
    """Return a spec with a message for each kind of frame."""
    messages = {}
    for number, (name, parts) in enumerate(frames.items(), 1):
        ids = {part: number for part, said in parts.items() if said["is"] == "id"}
        messages[f"Level{number}"] = {
            "id": ids if len(ids) > 1 else number,
            "frame": name,
            "length": 5,
            "direction": "sensor -> host",
            "summary": "A level.",
            "cite": "paper, 1",
            "fields": {
                "level": {"type": "u16", "range": "0..1000", "about": "The level."},
                "state": {"type": "u8", "about": "The state."},
            },
        }
    return {**data_in(MADE_UP), "frames": frames, "messages": messages}


VALUES = {"level": 500, "state": 7}


def compiled_frames(**frames: Any) -> Compiled:
    """Compile a spec with these kinds of frames; each message has an example."""
    return exampled(spec_of(**frames))


def exampled(data: Any) -> Compiled:
    draft = compiled_values(data).derived
    assert draft is not None
    for name, layout in draft.messages.items():
        shown = encode(layout, VALUES).hex(" ")
        example = {"title": "A level", "hex": shown, "values": VALUES, "constructed": "Made up."}
        data["messages"][name]["examples"] = [example]
    return compiled_values(data)


def test_a_test_in_place_is_one_expression() -> None:
    models = {name: compiled_frames(one=parts).model for name, (parts, _) in CASES.items()}
    proofs = {name: proof_in_place(model) for name, model in models.items()}
    expected = {name: expression for name, (_, expression) in CASES.items()}
    made = {
        name: proof and (proof.holds if proof.total is None else proof.given)
        for name, proof in proofs.items()
    }
    assert made == expected


@pytest.mark.parametrize(
    ("method", "in_place"), [("inverted sum", True), ("sum", False)], ids=["alike", "others"]
)
def test_frames_of_several_kinds_are_tested_in_place_if_all_are_alike(
    method: str, in_place: bool
) -> None:
    one, two = sealed(checksum("inverted sum", ALL)), sealed(checksum(method, ALL))
    model = compiled_frames(one=one, two=two).model
    assert (proof_in_place(model) is not None) == in_place


@in_turn("name", lambda: CASES)
def test_a_frame_with_any_byte_changed_is_judged_as_the_reference_judges_it(name: str) -> None:
    compiled = compiled_frames(one=CASES[name][0])
    (message,) = compiled.model.messages.values()
    frame = encode(message, VALUES)
    with library(render_target(python.TARGET, compiled)) as made:
        direction = made.Direction.SENSOR_TO_HOST
        # So that the decoders know the head: what they have not seen is judged elsewhere.
        assert made.decode(frame, direction) == made.Level1.decode(frame)
        for at in range(len(frame)):
            for change in (1, 0x80, 0xFF):
                bad = bytearray(frame)
                bad[at] ^= change
                legal = is_legal(compiled, bytes(bad))
                assert is_read(made, made.decode, bytes(bad), direction) == legal
                assert is_read(made, made.Level1.decode, bytes(bad)) == legal
                events = made.StreamDecoder(direction).feed(frame + bytes(bad))
                found = [event.encode() for event in events if isinstance(event, made.Message)]
                assert (bytes(bad) in found) == legal


def test_numbers_of_any_value_are_not_packed_without_the_checksum_in_front_of_them() -> None:
    data = spec_of(one=CASES["in front"][0])
    del data["messages"]["Level1"]["fields"]["level"]["range"]
    compiled = exampled(data)
    with library(render_target(python.TARGET, compiled)) as made:
        (message,) = compiled.model.messages.values()
        assert made.Level1(**VALUES).encode() == encode(message, VALUES)


def is_legal(compiled: Any, frame: bytes) -> bool:
    """Return whether the reference reads a frame."""
    try:
        decode(compiled.model, None, frame)
    except NotAFrame:
        return False
    return True


def is_read(made: Any, read: Callable[..., Any], frame: bytes, *further: Any) -> bool:
    """Return whether a library reads a frame in this way."""
    try:
        return bool(read(frame, *further).encode() == frame)
    except made.DecodeError:
        return False
