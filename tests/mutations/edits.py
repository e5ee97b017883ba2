"""Pairs of editions: a spec, and the same with one thing changed, by what was changed."""

from __future__ import annotations

import json
from functools import lru_cache

from framegen.checks import check_model, check_structure
from framegen.comparison.edition import Edition
from framegen.comparison.pair import Pair
from framegen.compile import Compiled
from framegen.language.spec import Spec
from framegen.model.model import derive
from framegen.reading.source import Source
from framegen.reading.yamltree import Tree

from tests.factories import BUSSERVO, DEMO, Data, data_of, renamed
from tests.mutations.places import GONE, reordered, with_
from tests.protocols.specs import FILES

SPECS = {
    "busservo": data_of(BUSSERVO),
    "greenhouse": data_of(DEMO),
    "everything": data_of(DEMO.with_name("everything.yaml")),
    "modbus": data_of(FILES["modbus"]),
}


def edition(data: Data, label: str = "made_up.yaml", *, checked: bool = True) -> Edition:
    """Return an edition of a spec that may contradict itself: one fact is changed at a time.

    Its text is not read again, so that nothing in it has a place. Of one that is not checked,
    nobody knows what is wrong with it.
    """
    return _edition(json.dumps(data), label, checked=checked)


# What is the same edition is one: what is worked out of it, such as its library, stays with it.
@lru_cache(maxsize=256)
def _edition(text: str, label: str, *, checked: bool) -> Edition:
    values = json.loads(text)
    spec = Spec.model_validate(values)
    model, tree = derive(spec), Tree(values)
    tolerated = (check_structure(spec, tree) or check_model(model, tree)) if checked else ()
    compiled = Compiled(Source(label, ""), tree, [], spec, model, tuple(tolerated))
    return Edition(label, compiled, spec, model)


def pair_of(old: Data, new: Data, *, checked: bool = True) -> Pair:
    """Return the pair of two editions."""
    return Pair(
        *(
            edition(each, f"{name}.yaml", checked=checked)
            for name, each in (("old", old), ("new", new))
        )
    )


SERVO, HOUSE = SPECS["busservo"], SPECS["greenhouse"]
ALL, BUS = SPECS["everything"], SPECS["modbus"]
ASK, TELL = ("frames", "ask"), ("frames", "tell")
TAIL, ERROR = ("messages", "Tail"), ("messages", "Flags", "fields", "error")
LISTS = ("messages", "Lists", "fields")
OTHER = {"mark": {"is": "constant", "bytes": "01"}, **ALL["frames"]["tell"]}
MOVE = ("messages", "ServoMove")
VENTS = ("messages", "VentsOpen")
ANGLE = (*VENTS, "fields", "vents", "fields", "angle")
POSITION = (*MOVE, "fields", "targets", "fields", "position")
PLACE = ("messages", "ServoPositions", "fields", "positions", "fields", "position")


BEEP: Data = {
    "id": 40,
    "direction": "host -> controller",
    "summary": "Beep.",
    "cite": "vendor, section 1.8",
    "length": "3",
    "fields": {"times": {"type": "u8", "about": "How often."}},
    "examples": [],
}

# Two editions by what was changed from the one to the other. Each is a case both ways.
EDITS: dict[str, tuple[Data, Data]] = {
    "baud": (SERVO, with_(SERVO, "link", "baud", 19200)),
    "parity": (HOUSE, with_(HOUSE, "link", "parity", GONE)),
    "HID board of another vendor": (
        HOUSE,
        with_(HOUSE, "link", "usb_hid", [{"vendor": 0x16C0, "product": 0x486}]),
    ),
    "no HID board": (SERVO, with_(SERVO, "link", "usb_hid", GONE)),
    "size of a HID report": (SERVO, with_(SERVO, "link", "usb_hid", 0, "report_size", 32)),
    "words about a HID board": (
        SERVO,
        with_(SERVO, "link", "usb_hid", 0, "about", "Boards of 2016."),
    ),
    "byte order of all": (SERVO, with_(SERVO, "byte_order", "big")),
    "bytes of the header": (SERVO, with_(SERVO, "frame", "header", "bytes", "55 AA")),
    "length counts itself": (HOUSE, with_(HOUSE, "frame", "size", "counts", ["size", "payload"])),
    "name of a constant part": (HOUSE, renamed(HOUSE, "preamble", "start")),
    "name of the library": (SERVO, with_(SERVO, "protocol", "name", "servobus")),
    "version": (HOUSE, with_(HOUSE, "protocol", "version", "9.0.0")),
    "name of an end": (HOUSE, renamed(HOUSE, "display", "screen")),
    "client and device exchanged": (
        SERVO,
        with_(SERVO, "endpoints", dict(reversed(SERVO["endpoints"].items()))),
    ),
    "method of a checksum": (ALL, with_(ALL, *ASK, "check", "method", "crc-16/umts")),
    "another kind of frame": (ALL, with_(ALL, "frames", "other", OTHER)),
    "range of addresses": (ALL, with_(ALL, *ASK, "station", "range", "1..400")),
    "value of a named address": (ALL, with_(ALL, *ASK, "station", "values", "first", "value", 2)),
    "silent address": (ALL, with_(ALL, *ASK, "station", "values", "all", "silent", False)),
    "name of the address": (ALL, renamed(ALL, "station", "device")),
    "name of a kind of frame": (ALL, renamed(ALL, "ask", "query")),
    "frame of a message": (
        ALL,
        with_(
            with_(ALL, *TAIL, "frame", "ask"), *TAIL, "id", {"class": 1, "kind": 9, "version": 9}
        ),
    ),
    "id of several": (
        ALL,
        with_(ALL, "messages", "Lists", "id", {"class": 1, "kind": 4, "version": 9}),
    ),
    "sizes of optional fields": (ALL, with_(ALL, *TAIL, "length", [2, 10])),
    "field not optional any more": (ALL, with_(ALL, *TAIL, "fields", "second", "optional", GONE)),
    "failure": (ALL, with_(ALL, "messages", "Texts", "failure", "size")),
    "good value of a failure": (
        with_(ALL, "messages", "Texts", "failure", "size"),
        with_(ALL, "messages", "Texts", "failure", "size unless 1"),
    ),
    "items asked for": (
        with_(SPECS["modbus"], "messages", "HoldingRead", "asks_for", GONE),
        SPECS["modbus"],
    ),
    "local echo": (ALL, with_(ALL, "link", "local_echo", True)),
    "bytes of a constant field": (
        ALL,
        with_(ALL, "messages", "Flags", "fields", "layout", "always", 5),
    ),
    "bytes of a reserved field": (
        ALL,
        with_(ALL, "messages", "Flags", "fields", "unused", "reserved", 3),
    ),
    "place of a bit": (ALL, with_(ALL, *ERROR, "bits", "heat", 2)),
    "bits removed": (ALL, with_(ALL, *ERROR, "bits", "code", GONE)),
    "bit added": (ALL, with_(ALL, *ERROR, "bits", "load", 2)),
    "name of a bit": (ALL, renamed(ALL, "heat", "warmth")),
    "byte order of a field": (
        ALL,
        with_(ALL, "messages", "Numbers", "fields", "little_u16", "byte_order", "big"),
    ),
    "offset of a scale": (
        ALL,
        with_(ALL, "messages", "Flags", "fields", "temperature", "scale", "0.125 °C - 250"),
    ),
    "size of a text": (ALL, with_(ALL, "messages", "Texts", "fields", "name", "count", 9)),
    "count of packed numbers": (ALL, with_(ALL, *LISTS, "channels", "count", 16)),
    "byte order of packed numbers": (ALL, with_(ALL, *LISTS, "low_bits", "byte_order", "big")),
    "range of packed numbers": (ALL, with_(ALL, *LISTS, "low_bits", "range", "0..8")),
    "count of a fixed list": (ALL, with_(ALL, *LISTS, "points", "count", 3)),
    "list not sized any more": (ALL, with_(ALL, *LISTS, "readings", "sized_by", GONE)),
    "no refusal": (BUS, with_(BUS, "messages", "HoldingRead", "refusal", GONE)),
    "message added": (SERVO, with_(SERVO, "messages", "Beep", BEEP)),
    "id": (SERVO, with_(SERVO, *MOVE, "id", 4)),
    "direction": (HOUSE, with_(HOUSE, "messages", "TextShow", "direction", "gateway -> station")),
    "name of a message": (HOUSE, renamed(HOUSE, "StationState", "Measured")),
    "no reply": (HOUSE, with_(HOUSE, "messages", "StationRead", "reply", GONE)),
    "message deprecated": (
        HOUSE,
        with_(HOUSE, "messages", "VentJammed", "deprecated", "Vents do not jam any more."),
    ),
    "name and arguments of a method": (
        HOUSE,
        with_(HOUSE, *VENTS, "method", "open(ramp_s, vents)"),
    ),
    "verb of a message": (SERVO, with_(SERVO, *MOVE, "verb", "turn")),
    "result of a method": (
        HOUSE,
        with_(HOUSE, "messages", "StationRead", "method", "station_read() -> readings"),
    ),
    "field that says how long it lasts": (HOUSE, with_(HOUSE, *VENTS, "lasts", "ramp_s")),
    "name of a field named elsewhere": (
        with_(HOUSE, *VENTS, "lasts", "ramp_s"),
        renamed(with_(HOUSE, *VENTS, "lasts", "ramp_s"), "ramp_s", "time_s"),
    ),
    "not acknowledged": (SERVO, with_(SERVO, "messages", "ActionGroupRun", "acknowledged", GONE)),
    "acknowledged by another": (
        SERVO,
        with_(SERVO, "messages", "ActionGroupRun", "acknowledged", "ActionGroupCompleted"),
    ),
    "name of a report": (SERVO, renamed(SERVO, "ActionGroupStarted", "GroupStarted")),
    "field removed": (HOUSE, with_(HOUSE, "messages", "VentJammed", "fields", "trim", GONE)),
    "name of the last field": (HOUSE, renamed(HOUSE, "trim", "offset")),
    "list removed": (SERVO, with_(SERVO, "messages", "ServoUnload", "fields", "servo_ids", GONE)),
    "order of fields": (
        HOUSE,
        reordered(HOUSE, ("messages", "VentJammed", "fields"), ["trim", "vent_id"]),
    ),
    "type of the last field": (
        HOUSE,
        with_(HOUSE, "messages", "VentJammed", "fields", "trim", "type", "i16"),
    ),
    "unit": (SERVO, with_(SERVO, *MOVE, "fields", "time_ms", "unit", "s")),
    "no scale": (
        HOUSE,
        with_(HOUSE, "messages", "StationState", "fields", "readings", "scale", GONE),
    ),
    "type in an element": (HOUSE, with_(HOUSE, *ANGLE, "type", "i8")),
    "range narrowed": (HOUSE, with_(HOUSE, *ANGLE, "range", "-900..800")),
    "range removed": (HOUSE, with_(HOUSE, *ANGLE, "range", GONE)),
    "range moved": (HOUSE, with_(HOUSE, *ANGLE, "range", "-800..1000")),
    "count widened": (HOUSE, with_(HOUSE, *VENTS, "fields", "vents", "count", "0..8")),
    "count narrowed": (HOUSE, with_(HOUSE, *VENTS, "fields", "vents", "count", "1..7")),
    "count as it was": (SERVO, with_(SERVO, *MOVE, "fields", "targets", "count", "1..83")),
    "name of a count": (HOUSE, renamed(HOUSE, "vent_count", "how_many")),
    "name of a list": (HOUSE, renamed(HOUSE, "readings", "values")),
    "name of a timed field": (HOUSE, renamed(HOUSE, "ramp_s", "seconds")),
    "name of an element": (HOUSE, with_(HOUSE, *VENTS, "fields", "vents", "element", "Flap")),
    "named value removed": (HOUSE, with_(HOUSE, *VENTS, "fields", "ramp_s", "values", GONE)),
    "name of a value": (HOUSE, renamed(HOUSE, "at_once", "now")),
    "number of a named value": (
        HOUSE,
        with_(HOUSE, *VENTS, "fields", "ramp_s", "values", "at_once", "value", 1),
    ),
    "bytes of an example": (
        HOUSE,
        with_(HOUSE, "messages", "TextShow", "examples", 0, "hex", "C3 5A A5 10 00 04 00 00 00 01"),
    ),
    "words about a field": (HOUSE, with_(HOUSE, *ANGLE, "about", "How far it opens.")),
    "limits narrowed": (SERVO, with_(SERVO, *POSITION, "limits", "usual", "100..900")),
    "limits moved": (SERVO, with_(SERVO, *POSITION, "limits", "usual", "100..1100")),
    "limits widened": (SERVO, with_(SERVO, *POSITION, "limits", "usual", "0..1100")),
    "no limits": (SERVO, with_(SERVO, *POSITION, "limits", GONE)),
    "limits of no others": (SERVO, with_(SERVO, *POSITION, "limits", "others", {})),
    "not signed any more": (SERVO, with_(SERVO, *PLACE, "signed_as", GONE)),
    "a value not absent any more": (
        SERVO,
        with_(SERVO, *PLACE, "values", "absent", "absent", GONE),
    ),
    "signed as another type": (with_(SERVO, *PLACE, "signed_as", "i32"), SERVO),
    "no pose": (SERVO, with_(SERVO, "pose", GONE)),
    "names and ids of a pose": (
        SERVO,
        with_(SERVO, "pose", {**SERVO["pose"], "hold": "stop_servos", "ids": "1..20"}),
    ),
    "nothing reserved": (HOUSE, with_(HOUSE, "reserved", [])),
}


def of_the_day(name: str, seed: int) -> tuple[Data, Data]:
    """Return the editions of an edit, one way round or, for the next seed, the other."""
    old, new = EDITS[name]
    return (old, new) if (seed + [*EDITS].index(name)) % 2 else (new, old)
