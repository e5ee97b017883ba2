"""Ids and fields may be called like what is said beside them: no column, no key is there twice."""

import json
from functools import cache
from importlib import import_module
from typing import Any

import pytest
from framegen.compile import Compiled
from framegen.site.scripts.codec_scripts import codec_scripts
from framegen.site.scripts.protocol_data import protocol_data

from tests.factories import DEMO, compiled_of, data_of, library, library_files
from tests.handed import handed_by
from tests.unit.site.reference import NODE
from tests.unit.site.scripts import run_script
from tests.unit.site.test_captures_js import SAVE, SAVERS

# Each of these stands somewhere beside the numbers of an unknown frame, or beside fields.
IDS = ["offset", "sender", "time", "from", "noise", "reason", "unknown", "parameters", "count"]
FIELDS = ["offset", "size", "clock"]
# Which message it would be: one number for each id.
NOBODY = bytes(range(0x40, 0x40 + len(IDS)))


@cache
def crowded() -> Compiled:
    """Return a protocol in which ids and fields have such names."""
    data = data_of(DEMO.with_name("lamp.yaml"))
    part = data["frame"].pop("kind")
    body = data["frame"].pop("payload")
    data["frame"] |= dict.fromkeys(IDS, part) | {"payload": body}
    data["frame"]["size"]["counts"] = [*IDS, "payload"]
    for number, (name, message) in enumerate(data["messages"].items()):
        message["id"] = dict.fromkeys(IDS, number)
        message["length"] = len(IDS)
        (example,) = message["examples"]
        frame = bytes([number]) * len(IDS)
        if name == "ColourShow":
            message["fields"] = {new: {"type": "u8", "about": "A colour."} for new in FIELDS}
            message["length"] += len(FIELDS)
            frame += bytes(range(1, len(FIELDS) + 1))
            example["values"] = {new: at for at, new in enumerate(FIELDS, 1)}
        example["hex"] = (b"\x7e" + bytes([len(frame)]) + frame).hex(" ").upper()
    return compiled_of(data)


def line() -> bytes:
    """Return noise, a frame of no message, and one with fields."""
    known = crowded().model.messages["ColourShow"].message.examples[0].hex
    return b"\x00" + b"\x7e" + bytes([len(NOBODY) + 1]) + NOBODY + b"\x09" + known


def each_once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    assert len(dict(pairs)) == len(pairs), pairs
    return dict(pairs)


def printed() -> tuple[list[dict[str, Any]], str]:
    """Return what the command prints of the line, and of the frame of no message in words."""
    with library(library_files(crowded())) as made:
        entries: Any = import_module("framewire.command.events")
        codec = handed_by(made.__name__).codec
        events = made.StreamDecoder(None).feed(line())
        texts = [entries.in_json(event, None, codec) for event in events]
        said = [json.loads(text, object_pairs_hook=each_once) for text in texts]
        return said, entries.in_words(events[1], None, codec)


def test_what_is_printed_has_each_key_once_and_each_number() -> None:
    said, words = printed()
    assert [each.get("reason") for each in said] == ["bad header", "unknown command", None]
    assert [each for each in said[1].values() if isinstance(each, int)] == [*NOBODY]
    assert (said[1]["offset_"], said[1]["parameters"]) == (NOBODY[0], "09")
    assert words.endswith(f"parameters_={NOBODY[7]} count={NOBODY[8]} parameters=09")


def test_a_table_has_each_column_once_and_each_number() -> None:
    with library(library_files(crowded())) as made:
        tables: Any = import_module(f"{made.__name__}.tables")
        found = tables.read(line())
        noise, colours = found["noise"], found["ColourShow"]
    for table in (noise, colours):
        assert len({*table.schema.names}) == len(table.schema.names)
    nobody = noise.to_pylist()[1]
    assert (nobody["offset"], nobody["reason"], nobody["unknown"]) == (1, "unknown command", True)
    for name in ("offset", "reason", "unknown", "parameters"):
        assert nobody[f"{name}_"] == NOBODY[IDS.index(name)]
    (shown,) = colours.to_pylist()
    assert (shown["offset"], shown["offset_"], shown["size_"], shown["clock_"]) == (13, 1, 2, 3)


@pytest.mark.skipif(NODE is None, reason="node is not installed")
def test_the_pages_save_it_under_the_same_names() -> None:
    model = crowded().model
    asked = {"protocol": protocol_data(model), "texts": [(line().hex(" "), None, "json")]}
    program = SAVE.replace("controller_to_host", "desk_to_lamp")
    (saved,) = run_script([*codec_scripts(model), *SAVERS], program, asked)
    shown = [json.loads(each, object_pairs_hook=each_once) for each in saved.splitlines()]
    assert [each.pop("offset") for each in shown] == [0, 1, 13]
    assert shown == printed()[0]
