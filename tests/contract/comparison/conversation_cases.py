"""Editions that differ in what ends wait for, and what is to be said of each, typed in by hand."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from tests.factories import data_of, first_edition
from tests.mutations.edits import SPECS
from tests.mutations.places import GONE, with_
from tests.protocols.specs import FILES

if TYPE_CHECKING:
    from tests.factories import Data


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
    """Two editions, and what is said of the first exchanges of both pairs of ends."""

    old: Data
    new: Data
    said: list[Said]


def _moved(data: Data, message: str, id_: Any) -> Data:
    return with_(data, "messages", message, "id", id_)


_OLD_HOST, _NEW_HOST = "old host, new controller", "new host, old controller"
_OLD_CLIENT, _NEW_CLIENT = "old client, new device", "new client, old device"
_OLD_LX, _NEW_LX = "old host, new servo", "new host, old servo"
_OLD_DXL, _NEW_DXL = "old controller, new actuator", "new controller, old actuator"

CASES: dict[str, Case] = {
    "a reply is gone": Case(
        SERVO,
        with_(SERVO, *BATTERY, "reply", GONE),
        [
            Said(_OLD_HOST, "no reply", "BatteryVoltageRead"),
            Said(_OLD_HOST, "no report", "BatteryVoltage", breaks=False),
            Said(_NEW_HOST, "unawaited", "BatteryVoltageRead", breaks=False),
        ],
    ),
    "a reply is new": Case(
        with_(SERVO, *BATTERY, "reply", GONE),
        SERVO,
        [
            Said(_OLD_HOST, "unawaited", "BatteryVoltageRead", breaks=False),
            # Devices may have sent it all along; but programs were given it as a report.
            Said(_NEW_HOST, "no reply", "BatteryVoltageRead", breaks=False),
            Said(_NEW_HOST, "no report", "BatteryVoltage"),
        ],
    ),
    "a request has another id": Case(
        SERVO,
        _moved(SERVO, "BatteryVoltageRead", 16),
        [
            Said(_OLD_HOST, "no reply", "BatteryVoltageRead"),
            Said(_NEW_HOST, "no reply", "BatteryVoltageRead"),
        ],
    ),
    "a reply has another id": Case(
        SERVO,
        _moved(SERVO, "BatteryVoltage", 16),
        [
            Said(_OLD_HOST, "no reply", "BatteryVoltageRead"),
            Said(_NEW_HOST, "no reply", "BatteryVoltageRead"),
        ],
    ),
    "a reply carries less": Case(
        SERVO,
        with_(SERVO, *VOLTAGE, "fields", "voltage_mv", "range", "0..20000"),
        [Said(_NEW_HOST, "no reply", "BatteryVoltageRead")],
    ),
    "a reply carries more": Case(
        with_(SERVO, *VOLTAGE, "fields", "voltage_mv", "range", "0..20000"),
        SERVO,
        [Said(_OLD_HOST, "no reply", "BatteryVoltageRead")],
    ),
    "a question must say more": Case(
        SERVO,
        with_(SERVO, *BATTERY, "fields", {"cell": {"type": "u8", "about": "Which of them."}}),
        [
            Said(_OLD_HOST, "no reply", "BatteryVoltageRead"),
            Said(_NEW_HOST, "no reply", "BatteryVoltageRead"),
        ],
    ),
    "a question is gone": Case(
        SERVO,
        with_(SERVO, *BATTERY, GONE),
        [
            Said(_OLD_HOST, "no reply", "BatteryVoltageRead"),
            Said(_OLD_HOST, "no report", "BatteryVoltage", breaks=False),
        ],
    ),
    "a question is new": Case(
        with_(with_(SERVO, *BATTERY, GONE), *VOLTAGE, GONE),
        SERVO,
        [Said(_NEW_HOST, "no reply", "BatteryVoltageRead", breaks=False)],
    ),
    "a command is acknowledged by nothing any more": Case(
        SERVO,
        with_(SERVO, *RUN, "acknowledged", GONE),
        [Said(_OLD_HOST, "not acknowledged", "ActionGroupRun")],
    ),
    "a command is acknowledged": Case(
        with_(SERVO, *RUN, "acknowledged", GONE),
        SERVO,
        [Said(_NEW_HOST, "not acknowledged", "ActionGroupRun", breaks=False)],
    ),
    "a command is not followed by a report any more": Case(
        SERVO,
        with_(SERVO, *RUN, "reports", ["ActionGroupStarted"]),
        [Said(_OLD_HOST, "no report", "ActionGroupRun")],
    ),
    "a refusal is gone": Case(
        BUS,
        with_(BUS, *HOLDING, "refusal", GONE),
        [
            Said(_OLD_CLIENT, "no report", "HoldingReadRefused", breaks=False),
            Said(_NEW_CLIENT, "no error", "HoldingRead"),
        ],
    ),
    "a refusal is new": Case(
        with_(with_(BUS, *HOLDING, "refusal", GONE), "messages", "HoldingReadRefused", GONE),
        BUS,
        [Said(_OLD_CLIENT, "no error", "HoldingRead", breaks=False)],
    ),
    "a refusal has another id": Case(
        BUS,
        _moved(BUS, "HoldingReadRefused", 135),
        [
            Said(_OLD_CLIENT, "no error", "HoldingRead"),
            Said(_NEW_CLIENT, "no error", "HoldingRead"),
        ],
    ),
    "another field is repeated": Case(
        BUS,
        with_(BUS, "messages", "RegisterWrite", "echoed", {"value": "value"}),
        [
            Said(_OLD_CLIENT, "not recognized", "RegisterWrite"),
            Said(_NEW_CLIENT, "not recognized", "RegisterWrite"),
        ],
    ),
    "nothing is repeated": Case(
        BUS,
        with_(BUS, "messages", "RegisterWrite", "echoed", GONE),
        [Said(_OLD_CLIENT, "not recognized", "RegisterWrite")],
    ),
    "an address is silent": Case(
        with_(LX, "frame", "servo_id", "values", "all", "silent", GONE),
        LX,
        [
            Said(_OLD_LX, "no reply", "MoveRead"),
            Said(_NEW_LX, "not asked", "MoveRead"),
        ],
    ),
    "an address is silent no longer": Case(
        LX,
        with_(LX, "frame", "servo_id", "values", "all", "silent", GONE),
        [Said(_NEW_LX, "no reply", "MoveRead", breaks=False)],
    ),
    "a failure is not told": Case(
        DYNAMIXEL,
        with_(DYNAMIXEL, "messages", "Status", "failure", GONE),
        [Said(_OLD_DXL, "error", "Ping"), Said(_NEW_DXL, "no error", "Ping")],
    ),
    "a failure is told": Case(
        with_(DYNAMIXEL, "messages", "Status", "failure", GONE),
        DYNAMIXEL,
        [Said(_OLD_DXL, "no error", "Ping", breaks=False), Said(_NEW_DXL, "error", "Ping")],
    ),
    "another value is the good one": Case(
        DYNAMIXEL,
        with_(DYNAMIXEL, "messages", "Status", "failure", "error unless 1"),
        [
            Said(_OLD_DXL, "error", "Ping"),
            Said(_OLD_DXL, "no error", "Ping"),
            Said(_NEW_DXL, "error", "Ping"),
            Said(_NEW_DXL, "no error", "Ping"),
        ],
    ),
    "a reply may be of another size no longer": Case(
        with_(BUS, "messages", "HoldingRead", "asks_for", GONE),
        BUS,
        [Said("new client, old device", "not recognized", "HoldingRead")],
    ),
    "a reply may be of another size": Case(
        BUS,
        with_(BUS, "messages", "HoldingRead", "asks_for", GONE),
        [Said("old client, new device", "not recognized", "HoldingRead")],
    ),
    "an answer may be taken for another": Case(
        DYNAMIXEL,
        with_(DYNAMIXEL, "messages", "SyncWrite", "reply", "Status"),
        [Said(_OLD_DXL, "unawaited", "SyncWrite"), Said(_NEW_DXL, "no reply", "SyncWrite")],
    ),
    "a refusal in a frame of its own is gone": Case(
        MSP,
        with_(MSP, "messages", "ApiVersionRead", "refusal", GONE),
        [
            Said(_OLD_HOST, "no report", "ApiVersionRefused", breaks=False),
            Said(_NEW_HOST, "no error", "ApiVersionRead"),
        ],
    ),
    "replies have each other's ids": Case(
        LX,
        _moved(_moved(LX, "Temperature", 25), "TemperatureLimit", 26),
        [
            Said(_OLD_LX, "other reply", "TemperatureLimitRead"),
            Said(_NEW_LX, "other reply", "TemperatureLimitRead"),
        ],
    ),
    "a reply has room for fewer": Case(
        SERVO, SMALL, [Said(_OLD_HOST, "in part", "ServoPositionsRead")]
    ),
    # The old host asks in parts.
    "a reply has room for more": Case(
        SMALL, SERVO, [Said(_NEW_HOST, "in part", "ServoPositionsRead")]
    ),
    "a board without a port is gone": Case(
        SERVO, BOARDLESS, [Said(_NEW_HOST, "not found", "link.usb_hid")]
    ),
    "a board without a port is new": Case(
        BOARDLESS, SERVO, [Said(_OLD_HOST, "not found", "link.usb_hid", breaks=False)]
    ),
    # And the others, of which nobody asks.
    "both ends ask": Case(
        SERVO,
        TURNED,
        [
            Said("old host, new controller", "no reply", "endpoints"),
            Said("new host, old controller", "no reply", "endpoints"),
        ],
    ),
    "all is written down": Case(SERVO, with_(SERVO, *BATTERY, "summary", "Ask."), []),
}
