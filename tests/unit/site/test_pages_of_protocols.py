"""The reference of protocols with frames of every kind: complete, linked, and true to the spec.

So is its search: it has all there is, and leads to it.
"""

import json
import re
from collections.abc import Iterator
from functools import lru_cache
from itertools import pairwise
from typing import Any

import pytest
from framegen.model.layout import MessageLayout
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


def index_of(site: Reference) -> Any:
    return json.loads(site.site["search.html"].data)


def slots_of(message: MessageLayout) -> Iterator[Any]:
    """Yield every part of a message, and for a list those of its items."""
    for slot in message.body:
        yield from slot.slots if isinstance(slot, Items) else [slot]


@of_each
def test_ids_are_unique_and_every_link_leads_somewhere(name: str) -> None:
    site = site_of(name)
    for path, page in site.site.items():
        assert sorted(page.ids) == sorted(set(page.ids)), path
    assert broken_links(site.site, site.rendered) == []
    for entry in index_of(site)["entries"]:
        path, _, anchor = entry["path"].partition("#")
        assert path in site.site, entry
        assert not anchor or anchor in site.site[path].ids, entry


@of_each
def test_headings_are_in_order_landmarks_are_there_and_nothing_is_loaded(name: str) -> None:
    for path, page in site_of(name).pages.items():
        assert page.headings[0] == 1, path
        assert page.headings.count(1) == 1, path
        assert [b for a, b in pairwise(page.headings) if b > a + 1] == [], path
        tags = [tag for tag, _ in page.tags]
        assert [tags.count(each) for each in ("header", "main", "footer")] == [1, 1, 1], path
        named = [given["aria-label"] for tag, given in page.tags if tag == "nav"]
        assert "Documentation" in named, path
        assert len(named) == len(set(named)), path
        assert [each for each in page.loads if not each.startswith("data:")] == [], path
        text = "".join([*page.styles, *(script for _, script in page.scripts)])
        assert re.findall(r"https?:|url\(|@import", text) == [], path


@of_each
def test_every_part_field_and_note_is_shown_and_nothing_that_is_not_there(name: str) -> None:
    site = site_of(name)
    parts = {part for frame in site.model.spec.envelopes.values() for part in frame}
    assert site.pages["index.html"].lacks(parts) == []
    assert [each for each in parts if each.replace("_", "\\_") not in site.files["README.md"]] == []
    for message in site.model.messages.values():
        names = [slot.name for slot in slots_of(message)]
        assert site.pages[f"messages/{message.name}.html"].lacks(names) == [], message.name
    notes = re.findall(r"'text': '([^']+)', 'cite'", str(data_of(ALL[name])))
    assert len(notes) >= (5 if name == "everything" else 0)
    pages = " ".join(page.words for path, page in site.pages.items() if path != "spec.html")
    kept = " ".join(site.files.values())
    assert [text for text in notes if text not in pages or text not in kept] == []
    assert [path for path, text in site.files.items() if re.search(r"\| None|: None\n", text)] == []


@of_each
def test_all_that_has_a_name_is_found_by_it(name: str) -> None:
    model = site_of(name).model
    spec = model.spec
    found: dict[str, set[str]] = {}
    for entry in index_of(site_of(name))["entries"]:
        found.setdefault(entry["kind"], set()).update([entry["title"], *entry.get("names", [])])
    layouts, messages = model.messages.values(), spec.messages.values()
    fields = [slot for each in layouts for slot in slots_of(each) if slot.field is not None]
    expected = {
        "message": {*spec.messages, *(str(each) for message in layouts for each in message.ids)},
        "method": {f"{each.method.name}()" for each in messages if each.method is not None},
        "erratum": {each.title for each in spec.errata},
        "lookalike": {each.title for each in spec.lookalikes.values()},
        "page": {*spec.sources, *spec.endpoints},
        "frame": {example.title for each in messages for example in each.examples},
        "field": {slot.name for slot in fields},
        "value": {each for slot in fields for each in (*slot.field.values, *slot.field.bits)},
    }
    for kind, names in expected.items():
        assert names <= found.get(kind, set()), kind


@needs_node
@of_each
def test_every_documented_frame_is_found_by_its_bytes(name: str) -> None:
    model = site_of(name).model
    examples = [
        (each, shown) for each in model.messages.values() for shown in each.message.examples
    ]
    frames = [(each.name, each.direction.key, list(shown.hex)) for each, shown in examples]
    program = """
    const bytesSearch = makeBytesSearch(asked.index);
    const answers = asked.frames.map(([, , bytes]) => bytesSearch.find(bytes));
    """
    scripts = [*codec_scripts(model), "bytes_found"]
    asked = {"index": index_of(site_of(name)), "frames": frames}
    answers = run_script(scripts, program, asked)
    for (message, way, data), (_, shown), found in zip(frames, examples, answers, strict=True):
        assert shown.title in [each["title"] for each in found["known"]]
        of_this_way = [
            each for each in found["judged"] if each["decoder"].endswith(f"&direction={way}")
        ]
        (mine,) = of_this_way
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
        kinds = [
            "message" if e.message else "unknown" if e.certain else "noise" for e in walk.events
        ]
        said = [(each.data.hex(), each.message or each.reason) for each in walk.events]
        events = [[kind, *each] for kind, each in zip(kinds, said, strict=True)]
        expected = reference_events(model, line, way)
        for event in expected:
            event[0] = "noise" if event[0] == "unknown" and not is_proof else event[0]
        assert joined(events) == joined(expected), line.hex(" ")
        for step in walk.steps:
            data = bytes.fromhex(step.bytes)
            assert line[step.offset : step.offset + len(data)] == data


# What a reader finds, by protocol and page.
FACTS = """
dynamixel1 index
    Devices have 0..253.
    254 is all: Every actuator; none returns a status. Nobody answers.
dynamixel1 messages/Status
    Failure error, where it is not 0
    bit 1 angle_limit The goal is outside the angle limits.
dynamixel1 messages/Ping
    Frame instruction
dynamixel1 messages/BulkRead
    Nothing. Never given.
    Length 3 * items + 3: 6, 9, 12 .. 255
dynamixel1 sequences
    the actuator answers with Status. Nobody answers at servo_id 254. Where error in
lxservo stream
    16: 01 + 07 + 01 + F4 + 01 + E8 + 03 = 1E9, of which E9, inverted 16
    An unknown command with a right checksum is certain.
    A checksum of 8 bits agrees by chance with one of 256 damaged frames.
lxservo messages/ModeWrite
    Reserved: written as 0, read as anything, and never given.
mavlink1 index
    It is not sent: both ends know it, and the checksum covers it.
mavlink1 messages/Heartbeat
    Extra 0x32, 50 in decimal, not sent
mavlink1 messages/ParameterRead
    text up to 16 characters
modbus index
    ·· ·· crc checksum low byte first
    The crc-16/modbus of unit, function and data: CRC of 16 bits
modbus stream
    Every byte may begin a frame that can be its unit
    An unknown function costs one byte. Nothing proves where its frame
modbus messages/Holding
    Size of the frame 2 * registers + 5: 7, 9, 11 .. 255
    Never given: the library counts.
modbus messages/HoldingRead
    Refused by HoldingReadRefused
modbus messages/HoldingReadRefused
    Refuses HoldingRead
sbus index
    All frames by name
sbus messages/Channels
    16 of u11, low byte and low bits first 0..2047
sbus stream
    There is no checksum. A header is believed only while everything
tfmini messages/Measurement
    one step is 0.125 °C, and 0 is -256 °C
ubx index
    0x06 0x08 6, 8
ubx messages/NavPvt
    Length 84 or 92
    May be absent, with all that is behind it.
ubx messages/InfNotice
    characters
"""


@in_turn(
    "protocol, page, facts", lambda: re.findall(r"^(\w+) (\S+)\n((?: .*\n)+)", FACTS, re.MULTILINE)
)
def test_a_reader_finds(protocol: str, page: str, facts: str) -> None:
    lines = [line.strip() for line in facts.splitlines()]
    assert site_of(protocol).page(f"{page}.html").lacks(lines) == []
