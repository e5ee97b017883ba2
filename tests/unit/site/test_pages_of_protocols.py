"""The reference of protocols with frames of every kind: complete, linked, and true to the spec.

So is its search: it has all there is, and leads to it.
"""

from __future__ import annotations

import json
import re
from functools import cache, lru_cache
from itertools import pairwise
from typing import Any

import pytest
from framegen.model.slots import Items
from framegen.site.scripts.codec_scripts import codec_scripts
from framegen.targets.docs.stream_examples import stream_examples
from framegen.targets.docs.walkthrough import walkthrough

from tests.factories import compiled_file, data_of
from tests.in_turn import in_turn
from tests.protocols.specs import FILES
from tests.rows import each_protocol, some
from tests.unit.site.peers import joined, noisy_lines, reference_events
from tests.unit.site.reference import NODE, SPECS, Reference, broken_links, reference
from tests.unit.site.scripts import run_script

ALL = {**SPECS, **FILES}
# Those that have between them all kinds of parts and fields, and all that pages say of them.
QUICK = {*SPECS, "everything", "lxservo", "modbus", "roboclaw", "ubx"}

needs_node = pytest.mark.skipif(NODE is None, reason="node is not installed")
of_each = pytest.mark.parametrize("name", some(ALL, lambda name: name in QUICK), scope="module")


# A site is large, so that all tests of one follow each other, and no more than it is kept.
@lru_cache(maxsize=1)
def site_of(name: str) -> Reference:
    return reference(name) if name in SPECS else Reference(compiled_file(FILES[name]))


def index_of(site: Reference) -> dict[str, Any]:
    scripts = site.site["search.html"].scripts
    data: dict[str, Any] = json.loads(
        next(text for given, text in scripts if given.get("id") == "search-index")
    )
    return data


@of_each
def test_ids_are_unique_and_every_link_leads_somewhere(name: str) -> None:
    site = site_of(name)
    for path, page in site.site.items():
        assert sorted(page.ids) == sorted(set(page.ids)), path
    assert broken_links(site.site, site.rendered) == []


@of_each
def test_headings_are_in_order_and_landmarks_are_there(name: str) -> None:
    for path, page in site_of(name).pages.items():
        assert page.headings[0] == 1, path
        assert page.headings.count(1) == 1, path
        for before, after in pairwise(page.headings):
            assert after <= before + 1, path
        tags = [tag for tag, _ in page.tags]
        assert [tags.count(each) for each in ("header", "main", "footer")] == [1, 1, 1], path
        named = [given["aria-label"] for tag, given in page.tags if tag == "nav"]
        assert "Documentation" in named, path
        assert len(named) == len(set(named)), path


@of_each
def test_nothing_is_loaded_from_anywhere(name: str) -> None:
    for path, page in site_of(name).pages.items():
        assert [each for each in page.loads if not each.startswith("data:")] == [], path
        for text in [*page.styles, *(script for _, script in page.scripts)]:
            found = [each for each in ("http:", "https:", "url(", "@import") if each in text]
            assert found == [], path


@of_each
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


@of_each
def test_every_note_is_shown(name: str) -> None:
    site = site_of(name)
    notes = re.findall(r"'text': '([^']+)', 'cite'", str(data_of(ALL[name])))
    assert len(notes) >= (5 if name == "everything" else 0)
    pages = " ".join(page.words for path, page in site.pages.items() if path != "spec.html")
    kept = " ".join(site.files.values())
    assert [text for text in notes if text not in pages or text not in kept] == []


@of_each
def test_no_page_shows_what_is_not_there(name: str) -> None:
    for path, text in site_of(name).files.items():
        assert "| None" not in text, path
        assert ": None\n" not in text, path


@of_each
def test_every_entry_leads_to_a_page_and_a_place_on_it(name: str) -> None:
    pages = site_of(name).site
    for entry in index_of(site_of(name))["entries"]:
        page, _, anchor = entry["path"].partition("#")
        assert page in pages, entry
        assert not anchor or anchor in pages[page].ids, entry


@of_each
def test_all_that_has_a_name_is_found_by_it(name: str) -> None:
    model = site_of(name).model
    spec = model.spec
    found: dict[str, set[str]] = {}
    for entry in index_of(site_of(name))["entries"]:
        found.setdefault(entry["kind"], set()).update([entry["title"], *entry.get("names", [])])
    expected: dict[str, set[str]] = {
        "message": set(spec.messages)
        | {str(each) for m in model.messages.values() for each in m.ids},
        "method": {f"{m.method.name}()" for m in spec.messages.values() if m.method is not None},
        "erratum": {erratum.title for erratum in spec.errata},
        "lookalike": {other.title for other in spec.lookalikes.values()},
        "page": set(spec.sources) | set(spec.endpoints),
        "frame": {each.title for m in spec.messages.values() for each in m.examples},
        "field": set(),
        "value": set(),
    }
    for message in model.messages.values():
        for slot in message.body:
            for field in slot.slots if isinstance(slot, Items) else [slot]:
                if field.field is not None:
                    expected["field"].add(field.name)
                    expected["value"] |= {*field.field.values, *field.field.bits}
    for kind, names in expected.items():
        assert names <= found.get(kind, set()), kind


@needs_node
@of_each
def test_every_documented_frame_is_found_by_its_bytes(name: str) -> None:
    model = site_of(name).model
    frames = [
        (message.name, message.direction.key, list(example.hex))
        for message in model.messages.values()
        for example in message.message.examples
    ]
    program = """
    const bytesSearch = makeBytesSearch(asked.index);
    const answers = asked.frames.map(([, , bytes]) => bytesSearch.find(bytes).judged);
    """
    scripts = [*codec_scripts(model), "bytes_found"]
    asked = {"index": index_of(site_of(name)), "frames": frames}
    for (message, way, data), judged in zip(
        frames, run_script(scripts, program, asked), strict=True
    ):
        (mine,) = [each for each in judged if each["decoder"].endswith(f"&direction={way}")]
        assert mine["title"] == message, bytes(data).hex(" ")
        assert mine["path"] == f"{site_of(name).folder}messages/{message}.html"
        assert mine["hex"] == bytes(data).hex(" ").upper()


@pytest.mark.parametrize("name", each_protocol(ALL))
def test_the_stream_is_shown_as_the_reference_decodes_it(name: str) -> None:
    model = compiled_file(ALL[name]).model
    shown = stream_examples(model)
    assert len(shown) >= (3 if name in SPECS else 1)
    assert shown[0].walkthrough.events[0].message
    # Whether a frame of unknown id proves by itself that it is one.
    is_proof = any(frame.proves_unknown for frame in model.envelopes.values())
    many = 200 if name in SPECS else 40
    examples = [(each.walkthrough.direction, each.walkthrough.data) for each in shown]
    lines = [(model.directions[0], line) for line in noisy_lines(model, 4, many)]
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
            ["noise" if kind == "unknown" and not is_proof else kind, data, what]
            for kind, data, what in reference_events(model, line, way)
        ]
        assert joined(events) == joined(expected), line.hex(" ")
        for step in walk.steps:
            data = bytes.fromhex(step.bytes)
            assert line[step.offset : step.offset + len(data)] == data


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


@cache
def words_of(name: str, path: str) -> str:
    return " ".join(site_of(name).page(path).words.split())


@in_turn("name, path, fact", lambda: FACTS)
def test_a_reader_finds(name: str, path: str, fact: str) -> None:
    assert fact in words_of(name, path)
