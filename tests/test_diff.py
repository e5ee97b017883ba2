"""`framegen diff`: what changed between two versions of a spec, and what of it breaks."""

import copy
import json
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

import pytest
from framegen.cli import main
from framegen.comparison.kinds import KINDS, differences
from framegen.language.spec import Spec
from framegen.model.model import Model, derive
from pydantic import ValidationError

from tests.factories import BUSSERVO, DEMO, Data, Steps, data_of, renamed, yaml_of
from tests.protocols.specs import FILES

SPECS = {
    "busservo": data_of(BUSSERVO),
    "greenhouse": data_of(DEMO),
    "everything": data_of(DEMO.with_name("everything.yaml")),
    "modbus": data_of(FILES["modbus"]),
}
GONE = "(gone)"


def derived(data: Data) -> Model:
    """Return the layout of a spec that may contradict itself: one fact is changed at a time."""
    return _derived(json.dumps(data))


@cache
def _derived(text: str) -> Model:
    return derive(Spec.model_validate(json.loads(text)))


def with_(data: Data, *path_and_value: Any) -> Data:
    """Return a copy with a value at a path, or without what is GONE; all else is shared."""
    *steps, last, value = path_and_value
    changed = copy.copy(data)
    around: Any = changed
    for step in steps:
        around[step] = copy.copy(around[step])
        around = around[step]
    if value == GONE:
        del around[last]
    else:
        around[last] = value
    return changed


def breaks(old: Data, new: Data) -> list[str]:
    """Return each difference as the command prints it."""
    found = differences(derived(old), derived(new))
    return [f"{each.breaks} {each.path}: {each.kind}: {each}" for each in found]


SERVO, HOUSE = SPECS["busservo"], SPECS["greenhouse"]
ALL, BUS = SPECS["everything"], SPECS["modbus"]
ASK, TELL = ("frames", "ask"), ("frames", "tell")
TAIL, ERROR = ("messages", "Tail"), ("messages", "Flags", "fields", "error")
LISTS = ("messages", "Lists", "fields")
OTHER = {"mark": {"is": "constant", "bytes": "01"}, **ALL["frames"]["tell"]}
# How the kind of frame is described with which Everything is asked, up to its checksum.
ASKED = (
    "C0 DE, reserved 07, address u16 little, counter u8, "
    "length u16 little of part 8, id u8, id u8, "
    "body, id u8 not sent, checksum u16 little"
)
COVERED = "of part 2 and 3 and 4 and 5 and 6 and 7 and 8 and 9, 0A"
TOLD = "01, BE EF, id u8, length u8 of part 5, body, checksum u8 sum of part 3 and 4 and 5"
MOVE = ("messages", "ServoMove")
VENTS = ("messages", "VentsOpen")
ANGLE = (*VENTS, "fields", "vents", "fields", "angle")
POSITION = (*MOVE, "fields", "targets", "fields", "position")
PLACE = ("messages", "ServoPositions", "fields", "positions", "fields", "position")
TARGET = ".".join(POSITION)
ELEMENT = ".".join(PLACE[:-1])


def reordered(data: Data, path: Steps, order: list[str]) -> Data:
    here: Any = data
    for step in path:
        here = here[step]
    return with_(data, *path, {name: here[name] for name in order})


BEEP: Data = {
    "id": 40,
    "direction": "host -> controller",
    "summary": "Beep.",
    "cite": "vendor, section 1.8",
    "length": "3",
    "fields": {"times": {"type": "u8", "about": "How often."}},
    "examples": [],
}

# Two editions, and the differences between them.
CASES: list[tuple[Data, Data, list[str]]] = [
    # ------------------------------------------------------------------ the line
    (
        SERVO,
        with_(SERVO, "link", "baud", 19200),
        ["wire link.baud: link: 9600 became 19200"],
    ),
    (
        HOUSE,
        with_(HOUSE, "link", "parity", GONE),
        ["wire link.parity: link: even became none"],
    ),
    (
        HOUSE,
        with_(HOUSE, "link", "usb_hid", [{"vendor": 0x16C0, "product": 0x486}]),
        [
            "nothing link.usb_hid: hid-added: 16c0:0486 is new",
            "nothing link: words: is said otherwise",
        ],
    ),
    (
        SERVO,
        with_(SERVO, "link", "usb_hid", GONE),
        [
            "programs link.usb_hid: hid-removed: 0483:5750 is gone",
            "nothing link: words: is said otherwise",
        ],
    ),
    (
        SERVO,
        with_(SERVO, "link", "usb_hid", 0, "report_size", 32),
        ["wire link.usb_hid.report_size: hid-report: 64 became 32"],
    ),
    (
        SERVO,
        with_(SERVO, "link", "usb_hid", 0, "about", "Boards of 2016."),
        ["nothing link: words: is said otherwise"],
    ),
    (
        SERVO,
        with_(SERVO, "byte_order", "big"),
        ["wire byte_order: byte-order: little became big"],
    ),
    (
        SERVO,
        with_(SERVO, "frame", "header", "bytes", "55 AA"),
        [
            (
                "wire frame: frame: 55 55, length u8 of part 2 and 3 and 4, id u8, body became "
                "55 AA, length u8 of part 2 and 3 and 4, id u8, body"
            )
        ],
    ),
    (
        HOUSE,
        with_(HOUSE, "frame", "size", "counts", ["size", "payload"]),
        [
            (
                "wire frame: frame: C3 5A A5, id u8, length u16 of part 4, body became "
                "C3 5A A5, id u8, length u16 of part 3 and 4, body"
            ),
        ],
    ),
    # The name of a part is on no wire.
    (HOUSE, renamed(HOUSE, "preamble", "start"), ["nothing lookalikes: words: is said otherwise"]),
    (
        SERVO,
        with_(SERVO, "protocol", "name", "servobus"),
        ["programs protocol.name: library-renamed: busservo became servobus"],
    ),
    (
        SERVO,
        with_(SERVO, "protocol", "version", "2.0.0"),
        [
            f"nothing protocol.version: version: {SERVO['protocol']['version']} became 2.0.0",
        ],
    ),
    (
        HOUSE,
        renamed(HOUSE, "display", "screen"),
        [
            "programs endpoints.screen: endpoint-renamed: display became screen",
            (
                "nothing messages.TextShow.deprecated: message-deprecated: "
                "The display reads the bus by itself since 2024. became "
                "The screen reads the bus by itself since 2024."
            ),
            "nothing messages.TextShow: words: is said otherwise",
            "nothing protocol: words: is said otherwise",
        ],
    ),
    (
        SERVO,
        with_(SERVO, "endpoints", dict(reversed(SERVO["endpoints"].items()))),
        [
            "programs endpoints: client-changed: host became controller",
            "nothing endpoints: words: is said otherwise",
        ],
    ),
    # ------------------------------------------------------------------ frames of every kind
    (
        ALL,
        with_(ALL, *ASK, "check", "method", "crc-16/umts"),
        [
            (
                f"wire frames.ask: frame: {ASKED} crc-16/modbus {COVERED}"
                f" became {ASKED} crc-16/umts {COVERED}"
            ),
        ],
    ),
    (
        ALL,
        with_(ALL, "frames", "other", OTHER),
        [
            f"nothing frames.other: frame-added: {TOLD} is new",
            "nothing frame: words: is said otherwise",
        ],
    ),
    (
        ALL,
        with_(ALL, *ASK, "station", "range", "1..400"),
        [
            "wire frames.ask.station.range: range-narrowed: 1..500 became 1..400",
        ],
    ),
    (
        ALL,
        with_(ALL, *ASK, "station", "values", "first", "value", 2),
        [
            "wire frames.ask.station.values.first: value-changed: 1 became 2",
        ],
    ),
    (
        ALL,
        with_(ALL, *ASK, "station", "values", "all", "silent", False),
        [
            "programs frames.ask.station.values.all.silent: address-silent: True became False",
        ],
    ),
    (
        ALL,
        renamed(ALL, "station", "device"),
        [
            "programs frames.ask.device: field-renamed: station became device",
            "nothing frame: words: is said otherwise",
        ],
    ),
    (
        ALL,
        renamed(ALL, "ask", "query"),
        [],
    ),
    (
        ALL,
        with_(ALL, *TAIL, "frame", "ask"),
        [
            "wire messages.Tail.frame: message-frame: tell became ask",
        ],
    ),
    (
        ALL,
        with_(ALL, "messages", "Lists", "id", {"class": 1, "kind": 4, "version": 9}),
        [
            "wire messages.Lists.id: message-id: 1, 3, 9 became 1, 4, 9",
        ],
    ),
    (
        ALL,
        with_(ALL, *TAIL, "length", [2, 10]),
        [
            "wire messages.Tail.length: message-lengths: 2, 3, 10 became 2, 10",
        ],
    ),
    (
        ALL,
        with_(ALL, *TAIL, "fields", "second", "optional", GONE),
        [
            "wire messages.Tail.length: message-lengths: 2, 3, 10 became 3, 10",
            "wire messages.Tail.fields.second.optional: field-optional: True became False",
        ],
    ),
    (
        ALL,
        with_(ALL, "messages", "Texts", "failure", "size"),
        [
            "programs messages.Texts.failure: message-failure: size is new",
        ],
    ),
    (
        ALL,
        with_(ALL, "link", "local_echo", True),
        [
            "wire link.local_echo: link: False became True",
        ],
    ),
    (
        ALL,
        with_(ALL, "messages", "Flags", "fields", "layout", "always", 5),
        [
            "wire messages.Flags.fields.layout.type: field-type: constant 04 became constant 05",
        ],
    ),
    (
        ALL,
        with_(ALL, "messages", "Flags", "fields", "unused", "reserved", 3),
        [
            (
                "wire messages.Flags.fields.unused.type: field-type: reserved 01 02"
                " became reserved 00 03"
            ),
        ],
    ),
    (
        ALL,
        with_(ALL, *ERROR, "bits", "heat", 2),
        [
            "wire messages.Flags.fields.error.bits.heat: bit-changed: 1 became 2",
        ],
    ),
    (
        ALL,
        with_(ALL, *ERROR, "bits", "code", GONE),
        [
            "programs messages.Flags.fields.error.bits.code: bit-removed: 4..7 is gone",
        ],
    ),
    (
        ALL,
        with_(ALL, *ERROR, "bits", "load", 2),
        [
            "nothing messages.Flags.fields.error.bits.load: bit-added: 2 is new",
        ],
    ),
    (
        ALL,
        renamed(ALL, "heat", "warmth"),
        [
            "programs messages.Flags.fields.error.bits.warmth: bit-renamed: heat became warmth",
        ],
    ),
    (
        ALL,
        with_(ALL, "messages", "Numbers", "fields", "little_u16", "byte_order", "big"),
        [
            "wire messages.Numbers.fields.little_u16.byte_order: byte-order: little became big",
        ],
    ),
    (
        ALL,
        with_(ALL, "messages", "Flags", "fields", "temperature", "scale", "0.125 °C - 250"),
        [
            (
                "wire messages.Flags.fields.temperature.scale: "
                "field-unit: 0.125 °C - 256 became 0.125 °C - 250"
            ),
        ],
    ),
    (
        ALL,
        with_(ALL, "messages", "Texts", "fields", "name", "count", 9),
        [
            (
                "wire messages.Texts.fields.name.type: field-type: ascii text of 8"
                " became ascii text of 9"
            ),
        ],
    ),
    (
        ALL,
        with_(ALL, *LISTS, "channels", "count", 16),
        [
            "wire messages.Lists.fields.channels.type: field-type: 8 of u11 became 16 of u11",
        ],
    ),
    (
        ALL,
        with_(ALL, *LISTS, "low_bits", "byte_order", "big"),
        [
            "wire messages.Lists.fields.low_bits.byte_order: byte-order: little became big",
        ],
    ),
    (
        ALL,
        with_(ALL, *LISTS, "low_bits", "range", "0..8"),
        [
            "wire messages.Lists.fields.low_bits.range: range-narrowed: 0..9 became 0..8",
        ],
    ),
    (
        ALL,
        with_(ALL, *LISTS, "points", "count", 3),
        [
            "wire messages.Lists.fields.points.count: range-narrowed: 2..2 became 3..3",
        ],
    ),
    (
        ALL,
        with_(ALL, *LISTS, "readings", "sized_by", GONE),
        [
            "wire messages.Lists.fields.readings: list-length: counted and sized became counted",
            (
                "programs messages.Lists.method: method-arguments: "
                "(readings, channels, low_bits, triple, angles, points) became "
                "(readings, channels, low_bits, triple, angles, points, bytes_left)"
            ),
        ],
    ),
    (
        with_(ALL, "frames", "other", OTHER),
        ALL,
        [
            f"nothing frames.other: frame-removed: {TOLD} is gone",
            "nothing frame: words: is said otherwise",
        ],
    ),
    (
        BUS,
        with_(BUS, "messages", "HoldingRead", "refusal", GONE),
        [
            "programs messages.HoldingRead.refusal: message-refusal: HoldingReadRefused is gone",
        ],
    ),
    # ------------------------------------------------------------------ messages
    (
        SERVO,
        with_(SERVO, "messages", "Beep", BEEP),
        ["nothing messages.Beep: message-added: Beep is new"],
    ),
    (
        with_(SERVO, "messages", "Beep", BEEP),
        SERVO,
        ["wire messages.Beep: message-removed: Beep is gone"],
    ),
    (
        SERVO,
        with_(SERVO, *MOVE, "id", 4),
        ["wire messages.ServoMove.id: message-id: 3 became 4"],
    ),
    (
        HOUSE,
        with_(HOUSE, "messages", "TextShow", "direction", "gateway -> station"),
        [
            (
                "wire messages.TextShow.direction: message-direction: "
                "gateway -> display became gateway -> station"
            )
        ],
    ),
    (
        HOUSE,
        renamed(HOUSE, "StationState", "Measured"),
        [
            "programs messages.Measured: message-renamed: StationState became Measured",
            "nothing errata: words: is said otherwise",
            "nothing unknowns: words: is said otherwise",
        ],
    ),
    (
        HOUSE,
        with_(HOUSE, "messages", "StationRead", "reply", GONE),
        ["wire messages.StationRead.reply: message-reply: StationState is gone"],
    ),
    (
        HOUSE,
        with_(HOUSE, "messages", "VentJammed", "deprecated", "Vents do not jam any more."),
        [
            (
                "nothing messages.VentJammed.deprecated: message-deprecated: "
                "Vents do not jam any more. is new"
            )
        ],
    ),
    # ------------------------------------------------------------------ methods
    (
        HOUSE,
        with_(HOUSE, *VENTS, "method", "open(ramp_s, vents)"),
        [
            "programs messages.VentsOpen.method: method-renamed: vents_open became open",
            (
                "programs messages.VentsOpen.method: method-arguments: "
                "(vents, ramp_s) became (ramp_s, vents)"
            ),
        ],
    ),
    (
        HOUSE,
        with_(HOUSE, "messages", "StationRead", "method", "station_read() -> readings"),
        ["programs messages.StationRead.method: method-result: readings is new"],
    ),
    (
        HOUSE,
        with_(HOUSE, *VENTS, "lasts", "ramp_s"),
        ["nothing messages.VentsOpen.lasts: result-tells-more: ramp_s is new"],
    ),
    (
        with_(HOUSE, *VENTS, "lasts", "ramp_s"),
        HOUSE,
        ["programs messages.VentsOpen.lasts: result-tells-less: ramp_s is gone"],
    ),
    (
        with_(HOUSE, *VENTS, "lasts", "ramp_s"),
        renamed(with_(HOUSE, *VENTS, "lasts", "ramp_s"), "ramp_s", "time_s"),
        [
            "programs messages.VentsOpen.fields.time_s: field-renamed: ramp_s became time_s",
            (
                "programs messages.VentsOpen.method: method-arguments: "
                "(vents, ramp_s) became (vents, time_s)"
            ),
        ],
    ),
    (
        SERVO,
        with_(SERVO, "messages", "ActionGroupRun", "acknowledged", GONE),
        [
            (
                "programs messages.ActionGroupRun.acknowledged: result-tells-less: "
                "ActionGroupStarted is gone"
            )
        ],
    ),
    (
        SERVO,
        with_(SERVO, "messages", "ActionGroupRun", "acknowledged", "ActionGroupCompleted"),
        [
            (
                "programs messages.ActionGroupRun.acknowledged: result-tells-less: "
                "ActionGroupStarted became ActionGroupCompleted"
            )
        ],
    ),
    (
        SERVO,
        renamed(SERVO, "ActionGroupStarted", "GroupStarted"),
        [
            "nothing messages.ActionGroupRun: words: is said otherwise",
            (
                "programs messages.GroupStarted: message-renamed: "
                "ActionGroupStarted became GroupStarted"
            ),
        ],
    ),
    # ------------------------------------------------------------------ fields
    (
        HOUSE,
        with_(HOUSE, "messages", "VentJammed", "fields", "trim", GONE),
        ["wire messages.VentJammed.fields.trim: field-removed: i8 is gone"],
    ),
    (
        with_(HOUSE, "messages", "VentJammed", "fields", "trim", GONE),
        HOUSE,
        ["wire messages.VentJammed.fields.trim: field-added: i8 is new"],
    ),
    (
        HOUSE,
        renamed(HOUSE, "trim", "offset"),
        ["programs messages.VentJammed.fields.offset: field-renamed: trim became offset"],
    ),
    (
        SERVO,
        with_(SERVO, "messages", "ServoUnload", "fields", "servo_ids", GONE),
        ["wire messages.ServoUnload.fields.servo_ids: field-removed: a list is gone"],
    ),
    (
        with_(SERVO, "messages", "ServoUnload", "fields", "servo_ids", GONE),
        SERVO,
        ["wire messages.ServoUnload.fields.servo_ids: field-added: a list is new"],
    ),
    (
        HOUSE,
        reordered(HOUSE, ("messages", "VentJammed", "fields"), ["trim", "vent_id"]),
        ["wire messages.VentJammed.fields: field-order: vent_id, trim became trim, vent_id"],
    ),
    (
        HOUSE,
        with_(HOUSE, "messages", "VentJammed", "fields", "trim", "type", "i16"),
        ["wire messages.VentJammed.fields.trim.type: field-type: i8 became i16"],
    ),
    (
        SERVO,
        with_(SERVO, *MOVE, "fields", "time_ms", "unit", "s"),
        ["wire messages.ServoMove.fields.time_ms.unit: field-unit: ms became s"],
    ),
    (
        HOUSE,
        with_(HOUSE, "messages", "StationState", "fields", "readings", "scale", GONE),
        ["wire messages.StationState.fields.readings.scale: field-unit: 0.01 K is gone"],
    ),
    (
        HOUSE,
        with_(HOUSE, *ANGLE, "type", "i8"),
        ["wire messages.VentsOpen.fields.vents.fields.angle.type: field-type: i16 became i8"],
    ),
    (
        HOUSE,
        with_(HOUSE, *ANGLE, "range", "-900..800"),
        [
            (
                "wire messages.VentsOpen.fields.vents.fields.angle.range: range-narrowed: "
                "-900..900 became -900..800"
            )
        ],
    ),
    (
        HOUSE,
        with_(HOUSE, *ANGLE, "range", GONE),
        [
            (
                "nothing messages.VentsOpen.fields.vents.fields.angle.range: range-widened: "
                "-900..900 became -32768..32767"
            )
        ],
    ),
    (
        HOUSE,
        with_(HOUSE, *ANGLE, "range", "-800..1000"),
        [
            (
                "wire messages.VentsOpen.fields.vents.fields.angle.range: range-narrowed: "
                "-900..900 became -800..1000"
            )
        ],
    ),
    (
        HOUSE,
        with_(HOUSE, *VENTS, "fields", "vents", "count", "0..8"),
        ["nothing messages.VentsOpen.fields.vents.count: range-widened: 1..8 became 0..8"],
    ),
    (
        HOUSE,
        with_(HOUSE, *VENTS, "fields", "vents", "count", "1..7"),
        ["wire messages.VentsOpen.fields.vents.count: range-narrowed: 1..8 became 1..7"],
    ),
    (
        SERVO,
        # What was left open, and what the frame has room for.
        with_(SERVO, *MOVE, "fields", "targets", "count", "1..83"),
        [],
    ),
    (
        HOUSE,
        renamed(HOUSE, "vent_count", "how_many"),
        ["nothing messages.VentsOpen.fields.how_many: count-renamed: vent_count became how_many"],
    ),
    (
        HOUSE,
        renamed(HOUSE, "readings", "values"),
        [
            "programs messages.StationState.fields.values: field-renamed: readings became values",
            "nothing errata: words: is said otherwise",
            "nothing unknowns: words: is said otherwise",
        ],
    ),
    (
        HOUSE,
        renamed(HOUSE, "ramp_s", "seconds"),
        [
            "programs messages.VentsOpen.fields.seconds: field-renamed: ramp_s became seconds",
            (
                "programs messages.VentsOpen.method: method-arguments: "
                "(vents, ramp_s) became (vents, seconds)"
            ),
        ],
    ),
    (
        HOUSE,
        with_(HOUSE, *VENTS, "fields", "vents", "element", "Flap"),
        ["programs messages.VentsOpen.fields.vents.element: element: Vent became Flap"],
    ),
    # ------------------------------------------------------------------ named values
    (
        HOUSE,
        with_(HOUSE, *VENTS, "fields", "ramp_s", "values", GONE),
        ["programs messages.VentsOpen.fields.ramp_s.values.at_once: value-removed: 0 is gone"],
    ),
    (
        with_(HOUSE, *VENTS, "fields", "ramp_s", "values", GONE),
        HOUSE,
        ["nothing messages.VentsOpen.fields.ramp_s.values.at_once: value-added: 0 is new"],
    ),
    (
        HOUSE,
        renamed(HOUSE, "at_once", "now"),
        ["programs messages.VentsOpen.fields.ramp_s.values.now: value-renamed: at_once became now"],
    ),
    (
        HOUSE,
        with_(HOUSE, *VENTS, "fields", "ramp_s", "values", "at_once", "value", 1),
        ["wire messages.VentsOpen.fields.ramp_s.values.at_once: value-changed: 0 became 1"],
    ),
    # ------------------------------------------------------------------ what is said
    (
        HOUSE,
        with_(HOUSE, "messages", "TextShow", "examples", 0, "hex", "C3 5A A5 10 00 04 00 00 00 01"),
        [
            (
                "nothing messages.TextShow.examples: example-added: "
                "C3 5A A5 10 00 04 00 00 00 01 is new"
            ),
            (
                "nothing messages.TextShow.examples: example-removed: "
                "C3 5A A5 10 00 04 FF FF FF FE is gone"
            ),
        ],
    ),
    (
        HOUSE,
        with_(HOUSE, *ANGLE, "about", "How far it opens."),
        ["nothing messages.VentsOpen: words: is said otherwise"],
    ),
    # ------------------------------------------------------------------ limits, properties, poses
    (
        SERVO,
        with_(SERVO, *POSITION, "limits", "usual", "100..900"),
        [f"programs {TARGET}.limits: limits-narrowed: 0..1000 became 100..900"],
    ),
    (
        SERVO,
        with_(SERVO, *POSITION, "limits", "usual", "100..1100"),
        [f"programs {TARGET}.limits: limits-narrowed: 0..1000 became 100..1100"],
    ),
    (
        SERVO,
        with_(SERVO, *POSITION, "limits", "usual", "0..1100"),
        [f"nothing {TARGET}.limits: limits-widened: 0..1000 became 0..1100"],
    ),
    (
        SERVO,
        with_(SERVO, *POSITION, "limits", GONE),
        [
            f"nothing {TARGET}.limits: limits-widened: 0..1000 is gone",
            "nothing messages.ServoMove: words: is said otherwise",
        ],
    ),
    (
        with_(SERVO, *POSITION, "limits", GONE),
        SERVO,
        [
            f"programs {TARGET}.limits: limits-narrowed: 0..1000 is new",
            "nothing messages.ServoMove: words: is said otherwise",
        ],
    ),
    (
        SERVO,
        with_(SERVO, *POSITION, "limits", "others", {}),
        ["nothing messages.ServoMove: words: is said otherwise"],
    ),
    (
        SERVO,
        with_(SERVO, *PLACE, "signed_as", GONE),
        [f"programs {ELEMENT}.signed_position: property-removed: i16 is gone"],
    ),
    (
        with_(SERVO, *PLACE, "signed_as", GONE),
        SERVO,
        [f"nothing {ELEMENT}.signed_position: property-added: i16 is new"],
    ),
    (
        SERVO,
        with_(SERVO, *PLACE, "values", "absent", "absent", GONE),
        [f"programs {ELEMENT}.absent: property-removed: 65535 is gone"],
    ),
    (
        with_(SERVO, *PLACE, "signed_as", "i32"),
        SERVO,
        [f"programs {ELEMENT}.signed_position: property-changed: i32 became i16"],
    ),
    (
        SERVO,
        with_(SERVO, "pose", GONE),
        ["programs pose: pose-removed: hold_servos, present_servos is gone"],
    ),
    (
        with_(SERVO, "pose", GONE),
        SERVO,
        ["nothing pose: pose-added: hold_servos, present_servos is new"],
    ),
    (
        SERVO,
        with_(SERVO, "pose", {**SERVO["pose"], "hold": "stop_servos", "ids": "1..20"}),
        [
            "programs pose.ids: pose-changed: 1..253 became 1..20",
            "programs pose.hold: pose-changed: hold_servos became stop_servos",
        ],
    ),
    (HOUSE, with_(HOUSE, "reserved", []), ["nothing reserved: words: is said otherwise"]),
]


def _named(case: object) -> str:
    return case[0] if isinstance(case, list) and case else ""


@pytest.mark.parametrize(("old", "new", "expected"), CASES, ids=_named)
def test_a_difference_is_reported_with_what_it_breaks(
    old: Data, new: Data, expected: list[str]
) -> None:
    assert breaks(old, new) == expected


def test_every_kind_of_difference_is_shown_above() -> None:
    shown = {line.split(": ")[1] for _, _, lines in CASES for line in lines}
    assert shown == set(KINDS)


@pytest.mark.parametrize(("old", "new"), [case[:2] for case in CASES])
def test_what_is_new_one_way_is_gone_the_other_way(old: Data, new: Data) -> None:
    there, back = differences(derived(old), derived(new)), differences(derived(new), derived(old))
    turned = [(each.new, each.old) for each in there]
    assert sorted(map(str, turned)) == sorted(str((each.old, each.new)) for each in back)


@pytest.mark.parametrize("name", SPECS)
def test_nothing_differs_from_itself(name: str) -> None:
    assert breaks(SPECS[name], copy.deepcopy(SPECS[name])) == []


def _leaves(value: Any, path: Steps = ()) -> Iterator[tuple[Steps, Any]]:
    if isinstance(value, dict | list):
        for key, item in value.items() if isinstance(value, dict) else enumerate(value):
            yield from _leaves(item, (*path, key))
    else:
        yield path, value


def _other(value: Any) -> list[Any]:
    """Return another value for a place, right or not: the spec decides."""
    if isinstance(value, bool) or value is None:
        return []
    if isinstance(value, int):
        return [value + 1]
    return [f"{value} too", f"{value}2", "host -> controller", "55 55 02 07", "0..9", "u8", "odd"]


def follows(path: Steps) -> bool:
    """Return whether it follows from other facts, and is compared with those."""
    return path[-1] in {"length", "counted_by", "sized_by"} or {"examples", "values"} <= {*path}


@pytest.mark.parametrize("name", ["greenhouse", "everything"])
def test_every_changed_fact_is_a_difference(name: str) -> None:
    """One text or number at a time, wherever the spec can be read with another in its place."""
    data = SPECS[name]
    before = derived(data)
    seen = 0
    for path, value in _leaves(data):
        for other in () if follows(path) else _other(value):
            try:
                after = derived(with_(data, *path, other))
            except (ValidationError, AssertionError, KeyError, StopIteration, OverflowError):
                continue
            if other != value:
                assert differences(before, after), (path, value, other)
                seen += 1
                break
    assert seen > 130


# ------------------------------------------------------------------ the command


def written(folder: Path, name: str, data: Data) -> str:
    file = folder / name
    file.write_text(yaml_of(data), encoding="utf-8")
    return str(file)


@pytest.mark.parametrize(
    ("change", "code", "line", "summary"),
    [
        (
            ("link", "baud", 9600),
            1,
            "wire      link.baud: link: 19200 became 9600\n",
            "1 difference: 1 break the wire, 0 break programs\n",
        ),
        (
            ("protocol", "name", "hothouse"),
            1,
            "programs  protocol.name: library-renamed: greenhouse became hothouse\n",
            "1 difference: 0 break the wire, 1 break programs\n",
        ),
        (
            ("protocol", "summary", "Frames."),
            0,
            "nothing   protocol: words: is said otherwise\n",
            "1 difference: 0 break the wire, 0 break programs\n",
        ),
        (("protocol", "name", "greenhouse"), 0, "", "nothing changed that a spec says\n"),
    ],
)
def test_the_exit_code_says_whether_anything_breaks(
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    change: tuple[Any, ...],
    code: int,
    line: str,
    summary: str,
) -> None:
    old = written(tmp_path, "old.yaml", HOUSE)
    new = written(tmp_path, "new.yaml", with_(HOUSE, *change))
    assert main(["diff", old, new]) == code
    assert capsys.readouterr() == (line, summary)


def test_what_breaks_most_comes_first(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    changed = with_(HOUSE, "protocol", "name", "hothouse")
    changed = with_(changed, "messages", "StationRead", "id", 0x20)
    example = ("messages", "StationRead", "examples", 0, "hex")
    changed = with_(changed, *example, "C3 5A A5 20 00 00")
    files = written(tmp_path, "old.yaml", HOUSE), written(tmp_path, "new.yaml", changed)
    assert main(["diff", *files]) == 1
    assert [line.split()[0] for line in capsys.readouterr().out.splitlines()] == [
        "wire",
        "programs",
        "nothing",
        "nothing",
    ]


def test_a_difference_is_a_line_of_json(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    files = (
        written(tmp_path, "old.yaml", HOUSE),
        written(tmp_path, "new.yaml", with_(HOUSE, "link", "baud", 9600)),
    )
    assert main(["diff", *files, "--json"]) == 1
    assert [json.loads(line) for line in capsys.readouterr().out.splitlines()] == [
        {"breaks": "wire", "kind": "link", "path": "link.baud", "old": "19200", "new": "9600"}
    ]


def test_a_spec_with_findings_is_not_compared(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    broken = written(tmp_path, "broken.yaml", with_(HOUSE, *VENTS, "length", "5"))
    assert main(["diff", broken, str(DEMO)]) == 2
    assert "length-rule" in capsys.readouterr().err


def test_what_is_compared_with_is_the_spec_of_the_project(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(BUSSERVO.parent)
    assert main(["diff", written(tmp_path, "same.yaml", SERVO)]) == 0
    assert capsys.readouterr().err == "nothing changed that a spec says\n"
