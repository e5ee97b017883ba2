"""A second opinion: frames of protocols that no package speaks, by hand with `struct` alone."""

import struct
from binascii import crc_hqx
from collections.abc import Callable, Sequence
from functools import partial

from tests.protocols.peer import Values


def _pack(layout: str, values: Values, *names: str) -> bytes:
    return struct.pack(layout, *(values[name] for name in names or values))


def _channels(values: Sequence[int]) -> bytes:
    """Pack sixteen channels of eleven bits, bit by bit, the lowest first."""
    bits = [value >> place & 1 for value in values for place in range(11)]
    octets = [bits[at : at + 8] for at in range(0, len(bits), 8)]
    return bytes(sum(bit << place for place, bit in enumerate(octet)) for octet in octets)


def _crc8_dvb_s2(data: bytes) -> int:
    crc = 0
    for byte in data:
        crc ^= byte
        for _ in range(8):
            crc = (crc << 1 ^ 0xD5) & 0xFF if crc & 0x80 else crc << 1
    return crc


def _crc_x25_without_inversion(data: bytes) -> int:
    """As MAVLink's own header works it out, a byte at a time."""
    crc = 0xFFFF
    for byte in data:
        step = (byte ^ crc) & 0xFF
        step = (step ^ step << 4) & 0xFF
        crc = crc >> 8 ^ step << 8 ^ step << 3 ^ step >> 4
    return crc


def _camera(opening: str, values: Values) -> bytes:
    """Write the values as bytes between the beginning of a frame and its end."""
    found = bytearray.fromhex(opening)
    for value in values.values():
        found += bytes(value if isinstance(value, list) else [value])
    return bytes(found) + b"\xff"


def _motor_answer(command: int, layout: str, values: Values) -> bytes:
    data = _pack(layout, values)
    return data + struct.pack(">H", crc_hqx(bytes([0x80, command]) + data, 0))


def _motor_question(command: int) -> bytes:
    question = bytes([0x80, command])
    return question + struct.pack(">H", crc_hqx(question, 0))


def _msp(direction: bytes, command: int, payload: bytes) -> bytes:
    checked = bytes([len(payload), command]) + payload
    total = 0
    for byte in checked:
        total ^= byte
    return b"$M" + direction + checked + bytes([total])


def _crsf(kind: int, payload: bytes) -> bytes:
    checked = bytes([kind]) + payload
    return bytes([0xC8, len(checked) + 1]) + checked + bytes([_crc8_dvb_s2(checked)])


def _mavlink(values: Values, message: int, extra: int, payload: bytes) -> bytes:
    sender = struct.pack("<H", values["sender"])
    checked = bytes([len(payload), values["sequence"]]) + sender + bytes([message]) + payload
    crc = _crc_x25_without_inversion(checked + bytes([extra]))
    return b"\xfe" + checked + struct.pack("<H", crc)


def _tfmini(values: Values) -> bytes:
    frame = b"YY" + _pack("<HHH", values)
    return frame + bytes([sum(frame) % 256])


def _sbus(values: Values) -> bytes:
    return b"\x0f" + _channels(values["channels"]) + bytes([values["flags"], 0])


def _sensor(command: int, data: bytes) -> bytes:
    checked = bytes([1, command]) + data.ljust(5, b"\0")
    return b"\xff" + checked + bytes([-sum(checked) % 256])


def _concentration(values: Values) -> bytes:
    checked = b"\x86" + _pack(">HB", values) + bytes(3)
    return b"\xff" + checked + bytes([-sum(checked) % 256])


def _bus(source: int, destination: int, command: int, data: bytes) -> bytes:
    frame = bytes([source, len(data) + 3, destination, command]) + data
    total = 0
    for byte in frame:
        total ^= byte
    return frame + bytes([total])


def _altitude(values: Values) -> bytes:
    tail = b"" if values["barometer"] is None else struct.pack("<i", values["barometer"])
    return _pack("<ih", values, "altitude", "climb") + tail


def _name(text: str, size: int) -> bytes:
    return text.encode("ascii").ljust(size, b"\0")


# What writes a frame, by protocol and message.
BY_HAND: dict[str, dict[str, Callable[[Values], bytes]]] = {
    "msp": {
        "ApiVersionRead": lambda _: _msp(b"<", 1, b""),
        "ApiVersion": lambda values: _msp(b">", 1, _pack("<BBB", values)),
        "ApiVersionRefused": lambda _: _msp(b"!", 1, b""),
        "AltitudeRead": lambda _: _msp(b"<", 109, b""),
        "Altitude": lambda values: _msp(b">", 109, _altitude(values)),
        "RawRcSet": lambda values: _msp(
            b"<", 200, struct.pack(f"<{len(values['channels'])}H", *values["channels"])
        ),
        "RawRcTaken": lambda _: _msp(b">", 200, b""),
    },
    "crsf": {
        "Gps": lambda values: _crsf(0x02, _pack(">iiHHHB", values)),
        "Battery": lambda values: _crsf(
            0x08,
            _pack(">hh", values, "voltage", "current")
            + struct.pack(">I", values["used"])[1:]
            + _pack(">b", values, "remaining"),
        ),
        "FlightMode": lambda values: _crsf(0x21, bytes(values["letters"])),
        "LinkStatistics": lambda values: _crsf(
            0x14,
            bytes(values["uplink_rssi"]) + struct.pack(">BbBBBBBb", *list(values.values())[1:]),
        ),
        "Channels": lambda values: _crsf(0x16, _channels(values["channels"])),
    },
    "sbus": {"Channels": _sbus},
    "mhz19": {
        "ConcentrationRead": lambda _: _sensor(0x86, b""),
        "Concentration": _concentration,
        "AutomaticCalibrationSet": lambda values: _sensor(0x79, _pack("B", values)),
        "RangeSet": lambda values: _sensor(0x99, b"\0" + _pack(">I", values)),
    },
    "ibus": {
        "Poll": lambda _: _bus(0x68, 0x18, 0x01, b""),
        "Control": lambda values: _bus(0x68, 0x18, 0x38, _pack("BB", values)),
        "Ready": lambda values: _bus(0x18, 0xFF, 0x02, _pack("B", values)),
        "Status": lambda values: _bus(
            *(0x18, 0x68, 0x39), struct.pack("BBxBxBB", *values.values())
        ),
    },
    "tfmini": {"Measurement": _tfmini},
    "mavlink1": {
        "Heartbeat": lambda values: _mavlink(
            values,
            *(0, 50),
            _pack(
                "<IBBBBB",
                values,
                *("custom_mode", "type", "autopilot", "base_mode", "system_status", "version"),
            ),
        ),
        "SystemTime": lambda values: _mavlink(
            values, 2, 137, _pack("<QI", values, "unix_us", "boot_ms")
        ),
        "ParameterRead": lambda values: _mavlink(
            values,
            *(20, 214),
            _pack("<hBB", values, "index", "target_system", "target_component")
            + _name(values["name"], 16),
        ),
        "Parameter": lambda values: _mavlink(
            values,
            *(22, 220),
            _pack("<fHH", values, "value", "count", "index")
            + _name(values["name"], 16)
            + _pack("<B", values, "type"),
        ),
        "Attitude": lambda values: _mavlink(
            values,
            *(30, 39),
            struct.pack("<I6f", values["boot_ms"], *values["angles"], *values["rates"]),
        ),
    },
    "visca": {
        name: partial(_camera, opening)
        for name, opening in {
            "PowerSet": "81 01 04 00",
            "ZoomTo": "81 01 04 47",
            "Turn": "81 01 06 01",
            "PowerRead": "81 09 04 00",
            "ZoomRead": "81 09 04 47",
            "AimRead": "81 09 06 12",
            "AddressSet": "88 30",
            "Accepted": "90 41",
            "Completed": "90 51",
            "Refused": "90 60",
            **dict.fromkeys(("Power", "Zoom", "Aim"), "90 50"),
        }.items()
    },
    "roboclaw": {
        "EncoderOneRead": lambda _: _motor_question(16),
        "VersionRead": lambda _: _motor_question(21),
        "VoltageRead": lambda _: _motor_question(24),
        "EncoderOne": lambda values: _motor_answer(16, ">IB", values),
        "Version": lambda values: _motor_answer(
            21, "28s", {"text": values["text"].encode("ascii")}
        ),
        "Voltage": lambda values: _motor_answer(24, ">H", values),
    },
}
