"""Pairs of editions: a spec, and the same with one thing changed, by what was changed."""

import json
from functools import lru_cache
from typing import Any

from framegen.checks import check_model, check_structure
from framegen.comparison.edition import Edition
from framegen.comparison.pair import Pair
from framegen.compile import Compiled
from framegen.language.spec import Spec
from framegen.model.model import derive
from framegen.reading.source import Source
from framegen.reading.yamltree import Tree

from tests.factories import BUSSERVO, DEMO, Data, data_of
from tests.mutations.places import GONE, having, renamed, reordered, with_
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
@lru_cache(maxsize=64)
def _edition(text: str, label: str, *, checked: bool) -> Edition:
    values = json.loads(text)
    spec = Spec.model_validate(values)
    model, tree = derive(spec), Tree(values)
    tolerated = (check_structure(spec, tree) or check_model(model, tree)) if checked else ()
    compiled = Compiled(Source(label, ""), tree, [], spec, model, tuple(tolerated))
    return Edition(label, compiled, spec, model)


def pair_of(old: Data, new: Data, *, checked: bool = True) -> Pair:
    named = {"old.yaml": old, "new.yaml": new}
    return Pair(*(edition(each, name, checked=checked) for name, each in named.items()))


SERVO, HOUSE = SPECS["busservo"], SPECS["greenhouse"]
ALL, BUS = SPECS["everything"], SPECS["modbus"]
LISTS, JAMMED_FIELDS = ("messages", "Lists", "fields"), ("messages", "VentJammed", "fields")
TAIL, RUN = "messages.Tail", "messages.ActionGroupRun"
OPEN, JAMMED = "messages.VentsOpen", "messages.VentJammed"
OTHER_BOARD, OTHER_BYTES = {"vendor": 0x16C0, "product": 0x486}, "C3 5A A5 10 00 04 00 00 00 01"
TURNED = dict(reversed(SERVO["endpoints"].items()))
OTHER = {"mark": {"is": "constant", "bytes": "01"}, **ALL["frames"]["tell"]}
ANGLE = "messages.VentsOpen.fields.vents.fields.angle"
LIMITS = "messages.ServoMove.fields.targets.fields.position.limits"
PLACE = "messages.ServoPositions.fields.positions.fields.position"
BEEP: Data = {
    "id": 40,
    "direction": "host -> controller",
    "summary": "Beep.",
    "cite": "vendor, section 1.8",
    "length": "3",
    "fields": {"times": {"type": "u8", "about": "How often."}},
    "examples": [],
}


def _one(data: Data, place: str, value: Any) -> tuple[Data, Data]:
    """Return a spec, and the same with another value at a place."""
    return data, having(data, {place: value})


def _called(data: Data, old: str, new: str) -> tuple[Data, Data]:
    """Return a spec, and the same with another name wherever it stands."""
    return data, renamed(data, old, new)


IDS = {"class": 1, "kind": 9, "version": 9}
LASTING = with_(HOUSE, "messages", "VentsOpen", "lasts", "ramp_s")
# Two editions by what was changed from the one to the other. Each is a case both ways.
EDITS: dict[str, tuple[Data, Data]] = {
    "baud": _one(SERVO, "link.baud", 19200),
    "parity": _one(HOUSE, "link.parity", GONE),
    "HID board of another vendor": _one(HOUSE, "link.usb_hid", [OTHER_BOARD]),
    "no HID board": _one(SERVO, "link.usb_hid", GONE),
    "size of a HID report": _one(SERVO, "link.usb_hid.0.report_size", 32),
    "words about a HID board": _one(SERVO, "link.usb_hid.0.about", "Boards of 2016."),
    "byte order of all": _one(SERVO, "byte_order", "big"),
    "bytes of the header": _one(SERVO, "frame.header.bytes", "55 AA"),
    "length counts itself": _one(HOUSE, "frame.size.counts", ["size", "payload"]),
    "name of a constant part": _called(HOUSE, "preamble", "start"),
    "name of the library": _one(SERVO, "protocol.name", "servobus"),
    "name of the client": _one(HOUSE, "protocol.client", "Climate"),
    "version": _one(HOUSE, "protocol.version", "9.0.0"),
    "name of an end": _called(HOUSE, "display", "screen"),
    "client and device exchanged": _one(SERVO, "endpoints", TURNED),
    "method of a checksum": _one(ALL, "frames.ask.check.method", "crc-16/umts"),
    "another kind of frame": _one(ALL, "frames.other", OTHER),
    "range of addresses": _one(ALL, "frames.ask.station.range", "1..400"),
    "value of a named address": _one(ALL, "frames.ask.station.values.first.value", 2),
    "silent address": _one(ALL, "frames.ask.station.values.all.silent", False),
    "name of the address": _called(ALL, "station", "device"),
    "name of a kind of frame": _called(ALL, "ask", "query"),
    "frame of a message": (ALL, having(ALL, {f"{TAIL}.frame": "ask", f"{TAIL}.id": IDS})),
    "id of several": _one(ALL, "messages.Lists.id", {"class": 1, "kind": 4, "version": 9}),
    "sizes of optional fields": _one(ALL, "messages.Tail.length", [2, 10]),
    "field not optional any more": _one(ALL, "messages.Tail.fields.second.optional", GONE),
    "failure": _one(ALL, "messages.Texts.failure", "size"),
    "good value of a failure": _one(
        having(ALL, {"messages.Texts.failure": "size"}), "messages.Texts.failure", "size unless 1"
    ),
    "items asked for": _one(BUS, "messages.HoldingRead.asks_for", GONE)[::-1],
    "local echo": _one(ALL, "link.local_echo", True),
    "bytes of a constant field": _one(ALL, "messages.Flags.fields.layout.always", 5),
    "bytes of a reserved field": _one(ALL, "messages.Flags.fields.unused.reserved", 3),
    "place of a bit": _one(ALL, "messages.Flags.fields.error.bits.heat", 2),
    "bits removed": _one(ALL, "messages.Flags.fields.error.bits.code", GONE),
    "bit added": _one(ALL, "messages.Flags.fields.error.bits.load", 2),
    "name of a bit": _called(ALL, "heat", "warmth"),
    "byte order of a field": _one(ALL, "messages.Numbers.fields.little_u16.byte_order", "big"),
    "offset of a scale": _one(ALL, "messages.Flags.fields.temperature.scale", "0.125 °C - 250"),
    "size of a text": _one(ALL, "messages.Texts.fields.name.count", 9),
    "count of packed numbers": _one(ALL, "messages.Lists.fields.channels.count", 16),
    "byte order of packed numbers": _one(ALL, "messages.Lists.fields.low_bits.byte_order", "big"),
    "range of packed numbers": _one(ALL, "messages.Lists.fields.low_bits.range", "0..8"),
    "count of a fixed list": _one(ALL, "messages.Lists.fields.points.count", 3),
    "list not sized any more": _one(ALL, "messages.Lists.fields.readings.sized_by", GONE),
    "no refusal": _one(BUS, "messages.HoldingRead.refusal", GONE),
    "message added": _one(SERVO, "messages.Beep", BEEP),
    "id": _one(SERVO, "messages.ServoMove.id", 4),
    "direction": _one(HOUSE, "messages.TextShow.direction", "gateway -> station"),
    "name of a message": _called(HOUSE, "StationState", "Measured"),
    "no reply": _one(HOUSE, "messages.StationRead.reply", GONE),
    "message deprecated": _one(HOUSE, f"{JAMMED}.deprecated", "Vents do not jam any more."),
    "name and arguments of a method": _one(HOUSE, f"{OPEN}.method", "open(ramp_s, vents)"),
    "verb of a message": _one(SERVO, "messages.ServoMove.verb", "turn"),
    "result of a method": _one(HOUSE, "messages.StationRead.method", "station_read() -> readings"),
    "field that says how long it lasts": _one(HOUSE, "messages.VentsOpen.lasts", "ramp_s"),
    "name of a field named elsewhere": _called(LASTING, "ramp_s", "time_s"),
    "not acknowledged": _one(SERVO, "messages.ActionGroupRun.acknowledged", GONE),
    "acknowledged by another": _one(SERVO, f"{RUN}.acknowledged", "ActionGroupCompleted"),
    "name of a report": _called(SERVO, "ActionGroupStarted", "GroupStarted"),
    "field removed": _one(HOUSE, "messages.VentJammed.fields.trim", GONE),
    "name of the last field": _called(HOUSE, "trim", "offset"),
    "list removed": _one(SERVO, "messages.ServoUnload.fields.servo_ids", GONE),
    "order of fields": (HOUSE, reordered(HOUSE, JAMMED_FIELDS, ["trim", "vent_id"])),
    "type of the last field": _one(HOUSE, "messages.VentJammed.fields.trim.type", "i16"),
    "unit": _one(SERVO, "messages.ServoMove.fields.time_ms.unit", "s"),
    "no scale": _one(HOUSE, "messages.StationState.fields.readings.scale", GONE),
    "type in an element": _one(HOUSE, f"{ANGLE}.type", "i8"),
    "range narrowed": _one(HOUSE, f"{ANGLE}.range", "-900..800"),
    "range removed": _one(HOUSE, f"{ANGLE}.range", GONE),
    "range moved": _one(HOUSE, f"{ANGLE}.range", "-800..1000"),
    "count widened": _one(HOUSE, "messages.VentsOpen.fields.vents.count", "0..8"),
    "count narrowed": _one(HOUSE, "messages.VentsOpen.fields.vents.count", "1..7"),
    "count as it was": _one(SERVO, "messages.ServoMove.fields.targets.count", "1..83"),
    "name of a count": _called(HOUSE, "vent_count", "how_many"),
    "name of a list": _called(HOUSE, "readings", "values"),
    "name of a timed field": _called(HOUSE, "ramp_s", "seconds"),
    "name of an element": _one(HOUSE, "messages.VentsOpen.fields.vents.element", "Flap"),
    "named value removed": _one(HOUSE, "messages.VentsOpen.fields.ramp_s.values", GONE),
    "name of a value": _called(HOUSE, "at_once", "now"),
    "number of a named value": _one(HOUSE, f"{OPEN}.fields.ramp_s.values.at_once.value", 1),
    "bytes of an example": _one(HOUSE, "messages.TextShow.examples.0.hex", OTHER_BYTES),
    "words about a field": _one(HOUSE, f"{ANGLE}.about", "How far it opens."),
    "limits narrowed": _one(SERVO, f"{LIMITS}.usual", "100..900"),
    "limits moved": _one(SERVO, f"{LIMITS}.usual", "100..1100"),
    "limits widened": _one(SERVO, f"{LIMITS}.usual", "0..1100"),
    "no limits": _one(SERVO, LIMITS, GONE),
    "limits of no others": _one(SERVO, f"{LIMITS}.others", {}),
    "not signed any more": _one(SERVO, f"{PLACE}.signed_as", GONE),
    "a value not absent any more": _one(SERVO, f"{PLACE}.values.absent.absent", GONE),
    "signed as another type": _one(SERVO, f"{PLACE}.signed_as", "i32")[::-1],
    "no pose": _one(SERVO, "pose", GONE),
    "names and ids of a pose": (
        SERVO,
        having(SERVO, {"pose.hold": "stop_servos", "pose.ids": "1..20"}),
    ),
    "nothing reserved": _one(HOUSE, "reserved", []),
}


def of_the_day(name: str, seed: int) -> tuple[Data, Data]:
    """Return the editions of an edit, one way round or, for the next seed, the other."""
    old, new = EDITS[name]
    return (old, new) if (seed + [*EDITS].index(name)) % 2 else (new, old)
