"""Editions that differ in what ends wait for, and what is to be said of each, typed in by hand."""

from typing import Any, NamedTuple

from tests.factories import Data, data_of, first_edition
from tests.mutations.edits import SPECS
from tests.mutations.places import GONE, with_
from tests.protocols.specs import FILES


def _some(data: Data, *beginnings: str) -> Data:
    """Return a spec with those of its messages whose names begin so."""
    messages = data["messages"].items()
    return {**data, "messages": {n: each for n, each in messages if n.startswith(beginnings)}}


# The other messages have exchanges of the same kinds.
SERVO, HOUSE = first_edition(), SPECS["greenhouse"]
BUS = _some(SPECS["modbus"], "Holding", "RegisterWrit")
LX = _some(data_of(FILES["lxservo"]), "Move", "LastMove", "Temperature")
DYNAMIXEL = _some(data_of(FILES["dynamixel1"]), "Ping", "SyncWrite", "Status")
MSP = data_of(FILES["msp"])
SMALL = with_(SERVO, "messages", "ServoPositions", "fields", "positions", "count", "1..5")
TURNED = with_(SERVO, "endpoints", dict(reversed(SERVO["endpoints"].items())))
BOARDLESS = with_(SERVO, "link", "usb_hid", GONE)
BATTERY = ("messages", "BatteryVoltageRead")
VOLTAGE = ("messages", "BatteryVoltage")
HOLDING = ("messages", "HoldingRead")
RUN = ("messages", "ActionGroupRun")


class Said(NamedTuple):
    """What is said of an exchange: of whom, what becomes of it, and whether it breaks.

    What is said of the line has the path of a key instead of a message.
    """

    ends: str
    outcome: str
    message: str
    breaks: bool = True


class Case(NamedTuple):
    old: Data
    new: Data
    said: list[Said]


def _case(old: Data, new: Data, *said: str) -> Case:
    """Return a case; it is said of the client of an edition: `old: no reply, Ping`.

    What breaks nothing has a + in front.
    """
    client, device = [*old["endpoints"]][:2]
    other = {"old": "new", "new": "old"}
    found = []
    for each in said:
        which, _, rest = each.removeprefix("+ ").partition(": ")
        outcome, message = rest.split(", ")
        ends = f"{which} {client}, {other[which]} {device}"
        found.append(Said(ends, outcome, message, breaks=each[0] != "+"))
    return Case(old, new, found)


def _moved(data: Data, message: str, id_: Any) -> Data:
    return with_(data, "messages", message, "id", id_)


CELL = {"cell": {"type": "u8", "about": "Which of them."}}
NO_REPLY = with_(SERVO, *BATTERY, "reply", GONE)
LESS = with_(SERVO, *VOLTAGE, "fields", "voltage_mv", "range", "0..20000")
UNACKNOWLEDGED = with_(SERVO, *RUN, "acknowledged", GONE)
NO_REFUSAL = with_(BUS, *HOLDING, "refusal", GONE)
LOUD = with_(LX, "frame", "servo_id", "values", "all", "silent", GONE)
NO_FAILURE = with_(DYNAMIXEL, "messages", "Status", "failure", GONE)
ANY_SIZE = with_(BUS, *HOLDING, "asks_for", GONE)
OTHER_GOOD = with_(DYNAMIXEL, "messages", "Status", "failure", "error unless 1")
SILENT_SYNC = with_(DYNAMIXEL, "messages", "SyncWrite", "reply", "Status")
BOTH_LOST = ("old: no reply, BatteryVoltageRead", "new: no reply, BatteryVoltageRead")
CASES: dict[str, Case] = {
    "a reply is gone": _case(
        *(SERVO, NO_REPLY),
        "old: no reply, BatteryVoltageRead",
        "+ old: no report, BatteryVoltage",
        "+ new: unawaited, BatteryVoltageRead",
    ),
    # Devices may have sent it all along; but programs were given it as a report.
    "a reply is new": _case(
        *(NO_REPLY, SERVO),
        "+ old: unawaited, BatteryVoltageRead",
        "+ new: no reply, BatteryVoltageRead",
        "new: no report, BatteryVoltage",
    ),
    "a request has another id": _case(SERVO, _moved(SERVO, "BatteryVoltageRead", 16), *BOTH_LOST),
    "a reply has another id": _case(SERVO, _moved(SERVO, "BatteryVoltage", 16), *BOTH_LOST),
    "a reply carries less": _case(SERVO, LESS, "new: no reply, BatteryVoltageRead"),
    "a reply carries more": _case(LESS, SERVO, "old: no reply, BatteryVoltageRead"),
    "a question must say more": _case(SERVO, with_(SERVO, *BATTERY, "fields", CELL), *BOTH_LOST),
    "a question is gone": _case(
        *(SERVO, with_(SERVO, *BATTERY, GONE)),
        "old: no reply, BatteryVoltageRead",
        "+ old: no report, BatteryVoltage",
    ),
    "a question is new": _case(
        *(with_(with_(SERVO, *BATTERY, GONE), *VOLTAGE, GONE), SERVO),
        "+ new: no reply, BatteryVoltageRead",
    ),
    "a command is acknowledged by nothing any more": _case(
        SERVO, UNACKNOWLEDGED, "old: not acknowledged, ActionGroupRun"
    ),
    "a command is acknowledged": _case(
        UNACKNOWLEDGED, SERVO, "+ new: not acknowledged, ActionGroupRun"
    ),
    "a command is not followed by a report any more": _case(
        *(SERVO, with_(SERVO, *RUN, "reports", ["ActionGroupStarted"])),
        "old: no report, ActionGroupRun",
    ),
    "a refusal is gone": _case(
        BUS, NO_REFUSAL, "+ old: no report, HoldingReadRefused", "new: no error, HoldingRead"
    ),
    "a refusal is new": _case(
        *(with_(NO_REFUSAL, "messages", "HoldingReadRefused", GONE), BUS),
        "+ old: no error, HoldingRead",
    ),
    "a refusal has another id": _case(
        *(BUS, _moved(BUS, "HoldingReadRefused", 135)),
        "old: no error, HoldingRead",
        "new: no error, HoldingRead",
    ),
    "another field is repeated": _case(
        *(BUS, with_(BUS, "messages", "RegisterWrite", "echoed", {"value": "value"})),
        "old: not recognized, RegisterWrite",
        "new: not recognized, RegisterWrite",
    ),
    "nothing is repeated": _case(
        *(BUS, with_(BUS, "messages", "RegisterWrite", "echoed", GONE)),
        "old: not recognized, RegisterWrite",
    ),
    "an address is silent": _case(LOUD, LX, "old: no reply, MoveRead", "new: not asked, MoveRead"),
    "an address is silent no longer": _case(LX, LOUD, "+ new: no reply, MoveRead"),
    "a failure is not told": _case(
        DYNAMIXEL, NO_FAILURE, "old: error, Ping", "new: no error, Ping"
    ),
    "a failure is told": _case(NO_FAILURE, DYNAMIXEL, "+ old: no error, Ping", "new: error, Ping"),
    "another value is the good one": _case(
        *(DYNAMIXEL, OTHER_GOOD),
        *("old: error, Ping", "old: no error, Ping", "new: error, Ping", "new: no error, Ping"),
    ),
    "a reply may be of another size no longer": _case(
        ANY_SIZE, BUS, "new: not recognized, HoldingRead"
    ),
    "a reply may be of another size": _case(BUS, ANY_SIZE, "old: not recognized, HoldingRead"),
    "an answer may be taken for another": _case(
        DYNAMIXEL, SILENT_SYNC, "old: unawaited, SyncWrite", "new: no reply, SyncWrite"
    ),
    "a refusal in a frame of its own is gone": _case(
        *(MSP, with_(MSP, "messages", "ApiVersionRead", "refusal", GONE)),
        "+ old: no report, ApiVersionRefused",
        "new: no error, ApiVersionRead",
    ),
    "replies have each other's ids": _case(
        *(LX, _moved(_moved(LX, "Temperature", 25), "TemperatureLimit", 26)),
        "old: other reply, TemperatureLimitRead",
        "new: other reply, TemperatureLimitRead",
    ),
    "a reply has room for fewer": _case(SERVO, SMALL, "old: in part, ServoPositionsRead"),
    # The old host asks in parts.
    "a reply has room for more": _case(SMALL, SERVO, "new: in part, ServoPositionsRead"),
    "a board without a port is gone": _case(SERVO, BOARDLESS, "new: not found, link.usb_hid"),
    "a board without a port is new": _case(BOARDLESS, SERVO, "+ old: not found, link.usb_hid"),
    # And the others, of which nobody asks.
    "both ends ask": _case(SERVO, TURNED, "old: no reply, endpoints", "new: no reply, endpoints"),
    "all is written down": _case(SERVO, with_(SERVO, *BATTERY, "summary", "Ask.")),
}
