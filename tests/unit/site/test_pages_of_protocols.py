"""The reference of protocols with frames of every kind: complete, linked, and true to the spec."""

from collections.abc import Iterable
from functools import lru_cache

import pytest
from framegen.language.load import read_source
from framegen.model.slots import Items
from framegen.targets.docs.stream_examples import stream_examples
from framegen.targets.docs.walkthrough import walkthrough

from tests.in_turn import in_turn
from tests.protocols.specs import FILES
from tests.unit.site.peers import joined, noisy_lines, reference_events
from tests.unit.site.reference import Reference, broken_links, reference_of


# A site is large, so that all tests of one follow each other, and no more than it is kept.
@lru_cache(maxsize=1)
def site_of(name: str) -> Reference:
    return reference_of(read_source(FILES[name]))


def of_each(names: Iterable[str]) -> pytest.MarkDecorator:
    return pytest.mark.parametrize("name", names, scope="module")


@pytest.mark.each_protocol
@of_each(FILES)
def test_ids_are_unique_and_every_link_leads_somewhere(name: str) -> None:
    site = site_of(name)
    for path, page in site.site.items():
        assert sorted(page.ids) == sorted(set(page.ids)), path
    assert broken_links(site.site, site.rendered) == []


@pytest.mark.each_protocol
@of_each(FILES)
def test_headings_are_in_order(name: str) -> None:
    for path, page in site_of(name).pages.items():
        assert page.headings.count(1) == 1, path
        for before, after in zip(page.headings, page.headings[1:], strict=False):
            assert after <= before + 1, path


@pytest.mark.each_protocol
@of_each(FILES)
def test_every_part_and_every_field_is_shown(name: str) -> None:
    site = site_of(name)
    parts = {part for frame in site.model.spec.envelopes.values() for part in frame}
    for part in parts:
        assert part in site.pages["index.html"].words
        assert part.replace("_", "\\_") in site.files["README.md"]
    for message in site.model.messages.values():
        words = site.pages[f"messages/{message.name}.html"].words
        for slot in message.body:
            names = [each.name for each in slot.slots] if isinstance(slot, Items) else [slot.name]
            for field in names:
                assert field in words, (message.name, field)


@pytest.mark.each_protocol
@of_each(FILES)
def test_no_page_shows_what_is_not_there(name: str) -> None:
    for path, text in site_of(name).files.items():
        assert "| None" not in text, path
        assert ": None\n" not in text, path


@pytest.mark.each_protocol
@of_each(FILES)
def test_the_stream_is_shown_as_the_reference_decodes_it(name: str) -> None:
    model = site_of(name).model
    shown = stream_examples(model)
    assert shown[0].walkthrough.events[0].message
    examples = [(each.walkthrough.direction, each.walkthrough.data) for each in shown]
    lines = [(model.directions[0], line) for line in noisy_lines(model, 4, 40)]
    for way, line in examples + lines:
        walk = walkthrough(model, way, line)
        events = [
            [
                "message" if each.message else "unknown" if each.certain else "noise",
                each.data.hex(),
                each.message or each.reason,
            ]
            for each in walk.events
        ]
        expected = [
            ["noise" if kind == "unknown" and not proves_unknown(name) else kind, data, what]
            for kind, data, what in reference_events(model, line, way)
        ]
        assert joined(events) == joined(expected), line.hex(" ")
        for step in walk.steps:
            data = bytes.fromhex(step.bytes)
            assert line[step.offset : step.offset + len(data)] == data


def proves_unknown(name: str) -> bool:
    """Tell whether a frame of unknown id proves by itself that it is one."""
    return any(frame.proves_unknown for frame in site_of(name).model.envelopes.values())


# What a reader finds, by protocol and page.
FACTS = [
    ("dynamixel1", "index.html", "Devices have 0..253."),
    (
        "dynamixel1",
        "index.html",
        "254 is all: Every actuator; none returns a status. Nobody answers.",
    ),
    ("dynamixel1", "messages/Status.html", "Failure error, where it is not 0"),
    (
        "dynamixel1",
        "messages/Status.html",
        "bit 1 angle_limit The goal is outside the angle limits.",
    ),
    ("dynamixel1", "messages/Ping.html", "Frame instruction"),
    ("dynamixel1", "messages/BulkRead.html", "Nothing. Never given."),
    ("dynamixel1", "messages/BulkRead.html", "Length 3 * items + 3: 6, 9, 12 .. 255"),
    (
        "dynamixel1",
        "sequences.html",
        "the actuator answers with Status. Nobody answers at servo_id 254. Where error in",
    ),
    (
        "lxservo",
        "stream.html",
        "16: 01 + 07 + 01 + F4 + 01 + E8 + 03 = 1E9, of which E9, inverted 16",
    ),
    ("lxservo", "stream.html", "An unknown command with a right checksum is certain."),
    (
        "lxservo",
        "stream.html",
        "A checksum of 8 bits agrees by chance with one of 256 damaged frames.",
    ),
    (
        "lxservo",
        "messages/ModeWrite.html",
        "Reserved: written as 0, read as anything, and never given.",
    ),
    ("mavlink1", "index.html", "It is not sent: both ends know it, and the checksum covers it."),
    ("mavlink1", "messages/Heartbeat.html", "Extra 0x32, 50 in decimal, not sent"),
    ("mavlink1", "messages/ParameterRead.html", "text up to 16 characters"),
    ("modbus", "index.html", "·· ·· crc checksum low byte first"),
    ("modbus", "index.html", "The crc-16/modbus of unit, function and data: CRC of 16 bits"),
    ("modbus", "stream.html", "Every byte may begin a frame that can be its unit"),
    ("modbus", "stream.html", "An unknown function costs one byte. Nothing proves where its frame"),
    ("modbus", "messages/Holding.html", "Size of the frame 2 * registers + 5: 7, 9, 11 .. 255"),
    ("modbus", "messages/Holding.html", "Never given: the library counts."),
    ("modbus", "messages/HoldingRead.html", "Refused by HoldingReadRefused"),
    ("modbus", "messages/HoldingReadRefused.html", "Refuses HoldingRead"),
    ("sbus", "index.html", "All frames by name"),
    ("sbus", "messages/Channels.html", "16 of u11, low byte and low bits first 0..2047"),
    ("sbus", "stream.html", "There is no checksum. A header is believed only while everything"),
    ("tfmini", "messages/Measurement.html", "one step is 0.125 °C, and 0 is -256 °C"),
    ("ubx", "index.html", "0x06 0x08 6, 8"),
    ("ubx", "messages/NavPvt.html", "Length 84 or 92"),
    ("ubx", "messages/NavPvt.html", "May be absent, with all that is behind it."),
    ("ubx", "messages/InfNotice.html", "characters"),
]


@of_each(dict.fromkeys(name for name, _, _ in FACTS))
@in_turn("path, fact", lambda name: [(path, fact) for of, path, fact in FACTS if of == name])
def test_a_reader_finds(name: str, path: str, fact: str) -> None:
    assert fact in " ".join(site_of(name).pages[path].words.split())
