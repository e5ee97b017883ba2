"""Hold the oracle to the documents: their examples, their length rules, their limits, their slips.

Every frame here was typed from the protocol document or from the notes on the controller family,
not produced by anything.  What passes here may judge the library.
"""

import ast
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import pytest

from tests import oracle
from tests.captures import make_noisy_line
from tests.in_turn import in_turn
from tests.oracle import CONTROLLER_TO_HOST, HOST_TO_CONTROLLER, OracleError, build, parse, scan

CAPTURES = Path(__file__).parents[1] / "captures"


def servos(*pairs: tuple[int, int]) -> list[dict[str, int]]:
    """Write (servo id, position) pairs the way the oracle does."""
    return [{"servo_id": servo_id, "position": position} for servo_id, position in pairs]


class Example(NamedTuple):
    """A frame that somebody has published, and what it says."""

    id: str
    hex: str
    direction: str
    name: str
    fields: dict[str, Any]

    @property
    def frame(self) -> bytes:
        """The bytes of the frame."""
        return bytes.fromhex(self.hex)


DOCUMENTED = (
    Example(
        "1.1 CMD_SERVO_MOVE example 1",
        "55 55 08 03 01 E8 03 01 20 03",
        HOST_TO_CONTROLLER,
        "ServoMove",
        {"time_ms": 1000, "targets": servos((1, 800))},
    ),
    Example(
        "1.1 CMD_SERVO_MOVE example 2",
        "55 55 0B 03 02 20 03 02 20 03 09 20 03",
        HOST_TO_CONTROLLER,
        "ServoMove",
        {"time_ms": 800, "targets": servos((2, 800), (9, 800))},
    ),
    Example(
        "1.2 CMD_ACTION_GROUP_RUN example 1",
        "55 55 05 06 08 01 00",
        HOST_TO_CONTROLLER,
        "ActionGroupRun",
        {"group": 8, "times": 1},
    ),
    Example(
        "1.2 CMD_ACTION_GROUP_RUN example 2",
        "55 55 05 06 02 00 00",
        HOST_TO_CONTROLLER,
        "ActionGroupRun",
        {"group": 2, "times": 0},
    ),
    Example(
        "1.3 CMD_ACTION_GROUP_STOP example",
        "55 55 02 07",
        HOST_TO_CONTROLLER,
        "ActionGroupStop",
        {},
    ),
    Example(
        "1.4 CMD_ACTION_GROUP_SPEED example 1",
        "55 55 05 0B 08 32 00",
        HOST_TO_CONTROLLER,
        "ActionGroupSpeed",
        {"group": 8, "percent": 50},
    ),
    Example(
        "1.4 CMD_ACTION_GROUP_SPEED example 2",
        "55 55 05 0B FF 2C 01",
        HOST_TO_CONTROLLER,
        "ActionGroupSpeed",
        {"group": 0xFF, "percent": 300},
    ),
    Example(
        "1.5 CMD_GET_BATTERY_VOLTAGE request",
        "55 55 02 0F",
        HOST_TO_CONTROLLER,
        "BatteryVoltageRead",
        {},
    ),
    Example(
        "1.5 CMD_GET_BATTERY_VOLTAGE reply",
        "55 55 04 0F 4C 1D",
        CONTROLLER_TO_HOST,
        "BatteryVoltage",
        {"voltage_mv": 7500},
    ),
    Example(
        "1.6 CMD_MULT_SERVO_UNLOAD example 1",
        "55 55 06 14 03 01 02 03",
        HOST_TO_CONTROLLER,
        "ServoUnload",
        {"servo_ids": [1, 2, 3]},
    ),
    Example(
        "1.6 CMD_MULT_SERVO_UNLOAD example 2",
        "55 55 09 14 06 01 02 03 04 05 06",
        HOST_TO_CONTROLLER,
        "ServoUnload",
        {"servo_ids": [1, 2, 3, 4, 5, 6]},
    ),
    Example(
        "1.7 CMD_MULT_SERVO_POS_READ request",
        "55 55 09 15 06 01 02 03 04 05 06",
        HOST_TO_CONTROLLER,
        "ServoPositionsRead",
        {"servo_ids": [1, 2, 3, 4, 5, 6]},
    ),
    Example(
        "1.7 CMD_MULT_SERVO_POS_READ reply",
        "55 55 15 15 06 01 F4 01 02 F4 01 03 F4 01 04 F4 01 05 F4 01 06 F4 01",
        CONTROLLER_TO_HOST,
        "ServoPositions",
        {"positions": servos((1, 500), (2, 500), (3, 500), (4, 500), (5, 500), (6, 500))},
    ),
    Example(
        "2.1 CMD_ACTION_GROUP_RUN report",
        "55 55 05 06 08 01 00",
        CONTROLLER_TO_HOST,
        "ActionGroupStarted",
        {"group": 8, "times": 1},
    ),
)

# Not in the document: the capture from a real board, and the two reports known from elsewhere,
# whose frames are written out from the description of their parameters.
FROM_ELSEWHERE = (
    Example(
        "battery reply captured",
        "55 55 04 0F C9 1E",
        CONTROLLER_TO_HOST,
        "BatteryVoltage",
        {"voltage_mv": 7881},
    ),
    Example("stop report", "55 55 02 07", CONTROLLER_TO_HOST, "ActionGroupStopped", {}),
    Example(
        "completion report",
        "55 55 05 08 08 01 00",
        CONTROLLER_TO_HOST,
        "ActionGroupCompleted",
        {"group": 8, "times": 1},
    ),
)

each_example = in_turn(
    "example", lambda: DOCUMENTED + FROM_ELSEWHERE, ids=lambda example: example.id
)


# --- The published frames, both ways -------------------------------------------------------------


def test_the_document_has_fourteen_examples() -> None:
    assert len(DOCUMENTED) == 14


def test_every_message_with_an_example_is_known() -> None:
    named = {(example.direction, example.name) for example in DOCUMENTED + FROM_ELSEWHERE}

    assert named <= {(way, name) for way, names in oracle.MESSAGES.items() for name in names}


@each_example
def test_an_example_is_read(example: Example) -> None:
    assert parse(example.frame, example.direction) == (example.name, example.fields)


@each_example
def test_an_example_is_written(example: Example) -> None:
    assert build(example.name, example.fields) == example.frame


@each_example
def test_what_is_read_is_plain(example: Example) -> None:
    name, fields = parse(example.frame, example.direction)

    assert ast.literal_eval(repr((name, fields))) == (example.name, example.fields)
    assert all(type(each) in (int, list, dict) for each in _everything_in(fields))


def _everything_in(value: Any) -> Iterator[Any]:
    yield value
    if isinstance(value, (dict, list)):
        for each in value.values() if isinstance(value, dict) else value:
            yield from _everything_in(each)


# --- The slips of the document -------------------------------------------------------------------


@each_example
def test_the_length_is_the_number_of_parameters_plus_two(example: Example) -> None:
    # "Data length: the number of parameters (N)", says one line, and the next: N + 2.
    header_and_length_and_command = 4
    parameters = example.frame[header_and_length_and_command:]
    of_parameters_only = bytearray(example.frame)
    of_parameters_only[2] = len(parameters)

    assert example.frame[2] == len(parameters) + 2
    with pytest.raises(OracleError):
        parse(bytes(of_parameters_only), example.direction)


def test_unload_example_2_holds_six_servos_and_not_the_five_of_its_prose() -> None:
    frame = bytes.fromhex("55 55 09 14 06 01 02 03 04 05 06")

    assert parse(frame, HOST_TO_CONTROLLER)[1]["servo_ids"] == [1, 2, 3, 4, 5, 6]
    assert build("ServoUnload", {"servo_ids": [1, 2, 3, 4, 5]}) != frame


def test_a_position_reply_is_id_low_high_and_not_high_low() -> None:
    # 500 for servo 1, read by the prose of section 1.7 ("high 8 bits", "low 8 bits", no id), would
    # be 1 * 256 + 244 by accident; 0x0102 for servo 3 is not symmetric in any way.
    frame = bytes.fromhex("55 55 06 15 01 03 02 01")

    assert parse(frame, CONTROLLER_TO_HOST) == (
        "ServoPositions",
        {"positions": [{"servo_id": 3, "position": 0x0102}]},
    )


def test_run_parameters_2_and_3_are_the_run_count() -> None:
    assert build("ActionGroupRun", {"group": 2, "times": 0x0102}) == bytes.fromhex(
        "55 55 05 06 02 02 01"
    )


# --- Length rules and limits, as printed ---------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "key", "others", "element", "per_servo", "fixed", "counts"),
    [
        # "The number of servos*3+5"; one byte of length allows 83 servos.
        ("ServoMove", "targets", {"time_ms": 1}, *servos((1, 2)), 3, 5, range(1, 84)),
        # "The numbers of servos+3", twice; 252 servos.
        ("ServoUnload", "servo_ids", {}, 1, 1, 3, range(1, 253)),
        ("ServoPositionsRead", "servo_ids", {}, 1, 1, 3, range(1, 253)),
        # The reply's own rule, which the document leaves out: 3 * servos + 3; 84 servos, or none.
        ("ServoPositions", "positions", {}, *servos((1, 2)), 3, 3, range(85)),
    ],
    ids=["ServoMove", "ServoUnload", "ServoPositionsRead", "ServoPositions"],
)
def test_every_count_has_the_printed_length_and_no_other_count_exists(
    name: str,
    key: str,
    others: dict[str, int],
    element: Any,
    per_servo: int,
    fixed: int,
    counts: range,
) -> None:
    # Behind the last that is legal, all are refused alike, until the count itself is too large.
    for count in sorted({*range(counts.stop + 20), *range(250, 260), 299}):
        fields = {**others, key: [element] * count}
        if count not in counts:
            with pytest.raises(OracleError):
                build(name, fields)
            continue
        frame = build(name, fields)
        assert frame[:2] == b"\x55\x55"
        assert frame[2] == per_servo * count + fixed == len(frame) - 2
        assert parse(frame, None) == (name, fields)


@pytest.mark.parametrize(
    ("hex_frame", "direction"),
    [
        ("55 55 05 03 00 E8 03", HOST_TO_CONTROLLER),
        ("55 55 03 14 00", HOST_TO_CONTROLLER),
        ("55 55 03 15 00", HOST_TO_CONTROLLER),
    ],
    ids=["move", "unload", "positions read"],
)
def test_a_request_for_no_servo_is_refused(hex_frame: str, direction: str) -> None:
    with pytest.raises(OracleError):
        parse(bytes.fromhex(hex_frame), direction)


def test_a_reply_may_hold_no_position() -> None:
    frame = bytes.fromhex("55 55 03 15 00")

    assert parse(frame, CONTROLLER_TO_HOST) == ("ServoPositions", {"positions": []})
    assert build("ServoPositions", {"positions": []}) == frame


# --- What is not exactly one legal frame ---------------------------------------------------------


@each_example
def test_an_example_cut_anywhere_is_refused(example: Example) -> None:
    for end in range(len(example.frame)):
        with pytest.raises(OracleError):
            parse(example.frame[:end], example.direction)


@each_example
def test_an_example_with_a_byte_more_is_refused(example: Example) -> None:
    for byte in (0x00, 0x55, 0xFF):
        with pytest.raises(OracleError):
            parse(example.frame + bytes([byte]), example.direction)


@each_example
def test_an_example_with_any_other_header_is_refused(example: Example) -> None:
    for header in (b"\x55\x54", b"\x54\x55", b"\xaa\xaa", b"\x00\x00"):
        with pytest.raises(OracleError):
            parse(header + example.frame[2:], example.direction)


@each_example
def test_an_example_with_any_other_length_is_refused(example: Example) -> None:
    for length in set(range(256)) - {example.frame[2]}:
        with pytest.raises(OracleError):
            parse(example.frame[:2] + bytes([length]) + example.frame[3:], example.direction)


@pytest.mark.parametrize(
    "example",
    [each for each in DOCUMENTED if each.frame[3] in (0x03, 0x14, 0x15)],
    ids=lambda example: example.id,
)
def test_an_example_with_any_other_count_is_refused(example: Example) -> None:
    for count in set(range(256)) - {example.frame[4]}:
        with pytest.raises(OracleError):
            parse(example.frame[:4] + bytes([count]) + example.frame[5:], example.direction)


@pytest.mark.parametrize(
    ("direction", "commands"),
    [
        (HOST_TO_CONTROLLER, {3, 6, 7, 11, 15, 20, 21}),
        (CONTROLLER_TO_HOST, {6, 7, 8, 15, 21}),
    ],
)
def test_a_direction_has_its_commands_and_no_more_than_it_has_messages(
    direction: str, commands: set[int]
) -> None:
    # Parameters that suit one command each, so that all but the command is legal.
    parameters = ("", "01 00", "01 00 00", "01 01", "00", "01 00 00 01 00 00", "01 01 00 00")

    found = set()
    for command in range(256):
        for each in parameters:
            body = bytes([command]) + bytes.fromhex(each)
            try:
                parse(b"\x55\x55" + bytes([len(body) + 1]) + body, direction)
            except OracleError:
                continue
            found.add(command)

    assert found >= commands
    assert len(found) <= len(oracle.MESSAGES[direction])


def test_a_reply_is_no_request_and_a_request_no_reply() -> None:
    request, reply = "55 55 02 0F", "55 55 04 0F C9 1E"

    with pytest.raises(OracleError):
        parse(bytes.fromhex(reply), HOST_TO_CONTROLLER)
    with pytest.raises(OracleError):
        parse(bytes.fromhex(request), CONTROLLER_TO_HOST)


def test_without_a_direction_a_frame_that_is_legal_both_ways_is_the_hosts() -> None:
    assert parse(bytes.fromhex("55 55 02 07"), None) == ("ActionGroupStop", {})
    assert parse(bytes.fromhex("55 55 05 06 08 01 00"), None)[0] == "ActionGroupRun"
    assert parse(bytes.fromhex("55 55 05 08 08 01 00"), None)[0] == "ActionGroupCompleted"


# --- Values that cannot be sent ------------------------------------------------------------------


@in_turn("value", lambda: [-1, 256, True, 1.0, "1", b"1", None, [1], {}])
def test_a_group_is_one_byte(value: object) -> None:
    with pytest.raises(OracleError):
        build("ActionGroupRun", {"group": value, "times": 1})


@in_turn("value", lambda: [-1, 65536, False, 0.5, "", None, [], [1, 2]])
def test_a_time_is_two_bytes(value: object) -> None:
    with pytest.raises(OracleError):
        build("ServoMove", {"time_ms": value, "targets": servos((1, 500))})


@pytest.mark.parametrize("value", [0, 1, 254, 255])
def test_every_servo_id_can_be_sent(value: int) -> None:
    assert build("ServoUnload", {"servo_ids": [value]}) == bytes([0x55, 0x55, 4, 20, 1, value])


@pytest.mark.parametrize("value", [0, 1000, 1001, 2500, 65535])
def test_every_position_can_be_sent(value: int) -> None:
    fields = {"time_ms": 0, "targets": servos((1, value))}

    assert parse(build("ServoMove", fields), HOST_TO_CONTROLLER) == ("ServoMove", fields)


@in_turn(
    "name, fields",
    lambda: [
        ("ActionGroupRun", {"group": 1}),
        ("ActionGroupRun", {"group": 1, "times": 1, "speed": 1}),
        ("ActionGroupStop", {"group": 1}),
        ("ServoMove", {"time_ms": 1}),
        ("ServoMove", {"time_ms": 1, "targets": 1}),
        ("ServoMove", {"time_ms": 1, "targets": [1]}),
        ("ServoMove", {"time_ms": 1, "targets": [{"servo_id": 1}]}),
        ("ServoMove", {"time_ms": 1, "targets": {"servo_id": 1, "position": 1}}),
        ("ServoMove", {"time_ms": 1, "servo_count": 1, "targets": servos((1, 500))}),
        ("ServoUnload", {"servo_ids": servos((1, 500))}),
        ("ServoUnload", {"servo_ids": "\x01"}),
        ("ServoUnload", {"servo_ids": None}),
        ("ServoMoves", {"time_ms": 1, "targets": servos((1, 500))}),
    ],
)
def test_fields_of_another_shape_cannot_be_sent(name: str, fields: dict[str, Any]) -> None:
    with pytest.raises(OracleError):
        build(name, fields)


def test_a_sequence_may_be_a_tuple() -> None:
    assert build("ServoUnload", {"servo_ids": (1, 2, 3)}) == bytes.fromhex(
        "55 55 06 14 03 01 02 03"
    )


# --- The reading of a whole recording ------------------------------------------------------------

STOP: tuple[str, dict[str, Any]] = ("ActionGroupStop", {})
FIVE_SERVOS = "55 55 14 03 05 DC 05 01 F4 01 02 F4 01 03 F4 01 04 F4 01 05 F4 01"

STREAMS: dict[str, tuple[str, list[Any]]] = {
    "nothing": ("", []),
    "one frame": ("55 55 02 07", [STOP]),
    "two frames": ("55 55 02 07 55 55 02 07", [STOP, STOP]),
    "noise alone": ("00 FF 55 13", [b"\x00\xff\x55\x13"]),
    "noise around": ("00 FF 55 55 02 07 13", [b"\x00\xff", STOP, b"\x13"]),
    "a stray 55": ("55 55 55 02 07", [b"\x55", STOP]),
    "a stray header": ("55 55 55 55 02 07", [b"\x55\x55", STOP]),
    "an unknown command's length is not believed": (
        "55 55 FF 55 55 02 07",
        [b"\x55\x55\xff", STOP],
    ),
    "a command of the other direction": (
        "55 55 05 08 08 01 00 55 55 02 07",
        [b"\x55\x55\x05\x08\x08\x01\x00", STOP],
    ),
    "an illegal length": ("55 55 01 07 55 55 02 07", [b"\x55\x55\x01\x07", STOP]),
    "a frame cut before its count": ("55 55 0B 03 55 55 02 07", [b"\x55\x55\x0b\x03", STOP]),
    "a frame that never ends hides another": (
        "55 55 0B 03 02 55 55 02 07",
        [b"\x55\x55\x0b\x03\x02", STOP],
    ),
    "two that never end hide a third": (
        "55 55 17 03 06 E8 03 55 55 0B 03 02 20 03 55 55 02 07",
        [bytes.fromhex("55 55 17 03 06 E8 03 55 55 0B 03 02 20 03"), STOP],
    ),
    "a frame's own bytes are no frame": (
        "55 55 0B 03 02 E8 03 55 55 02 07 F4 01",
        [("ServoMove", {"time_ms": 1000, "targets": servos((85, 597), (7, 500))})],
    ),
    "a frame cut short eats what follows": (
        "55 55 05 06 08 55 55 02 07",
        [("ActionGroupRun", {"group": 8, "times": 0x5555}), b"\x02\x07"],
    ),
    "half a header at the end": ("55 55 02 07 55", [STOP, b"\x55"]),
}
each_stream = in_turn(
    "data, events",
    lambda: [
        pytest.param(bytes.fromhex(hex_data), events, id=name)
        for name, (hex_data, events) in STREAMS.items()
    ],
)


@each_stream
def test_a_recording_is_read(data: bytes, events: list[Any]) -> None:
    assert scan(data, HOST_TO_CONTROLLER) == events


@each_stream
def test_a_reading_loses_nothing(data: bytes, events: list[Any]) -> None:
    assert bytes_of(events) == data


@each_stream
def test_what_is_read_before_the_line_is_quiet_is_never_taken_back(
    data: bytes, events: list[Any]
) -> None:
    for end in range(len(data) + 1):
        early = scan(data[:end], HOST_TO_CONTROLLER, quiet=False)
        held = data[len(bytes_of(early)) : end]

        assert data.startswith(bytes_of(early))
        assert not held or oracle.may_become_frame(held, HOST_TO_CONTROLLER)
        # Whole messages agree; only a last piece of noise may still grow.
        whole = oracle.messages_of(early)
        assert whole == oracle.messages_of(events)[: len(whole)]


def bytes_of(events: list[Any]) -> bytes:
    """Write a reading back as the bytes that were read."""
    return b"".join(event if isinstance(event, bytes) else build(*event) for event in events)


@each_example
def test_a_stray_55_costs_no_example(example: Example) -> None:
    message = (example.name, example.fields)

    assert scan(b"\x55" + example.frame, example.direction) == [b"\x55", message]


def test_a_stray_55_before_a_move_of_five_is_not_taken_for_an_unload() -> None:
    noise, (name, fields) = scan(bytes.fromhex("55" + FIVE_SERVOS), HOST_TO_CONTROLLER)

    assert noise == b"\x55"
    assert name == "ServoMove"
    assert isinstance(fields, dict)
    assert len(fields["targets"]) == 5


@each_example
def test_every_beginning_of_an_example_may_become_a_frame(example: Example) -> None:
    for end in range(len(example.frame)):
        assert oracle.may_become_frame(example.frame[:end], example.direction)
    assert not oracle.may_become_frame(example.frame, example.direction)


@in_turn(
    "hex_data, direction",
    lambda: [
        ("56", None),
        ("55 54", None),
        # A length that no command can have, refused at the third byte.
        ("55 55 00", None),
        ("55 55 01", None),
        ("55 55 03", HOST_TO_CONTROLLER),
        ("55 55 07", CONTROLLER_TO_HOST),
        # A length that this command cannot have, or no known command, at the fourth.
        ("55 55 07 03", HOST_TO_CONTROLLER),
        ("55 55 04 0F", HOST_TO_CONTROLLER),
        ("55 55 02 0F", CONTROLLER_TO_HOST),
        ("55 55 02 01", None),
        ("55 55 FF 55", None),
        # A count that disagrees with the length, at the fifth.
        ("55 55 08 03 02", HOST_TO_CONTROLLER),
        ("55 55 55 14 05", HOST_TO_CONTROLLER),
        ("55 55 15 15 06", HOST_TO_CONTROLLER),
        ("55 55 15 15 12", CONTROLLER_TO_HOST),
    ],
)
def test_an_impossible_beginning_is_refused_at_once(hex_data: str, direction: str | None) -> None:
    data = bytes.fromhex(hex_data)

    assert not oracle.may_become_frame(data, direction)
    # And not before: without its last byte it was still possible.
    assert oracle.may_become_frame(data[:-1], direction)


# --- The noisy line ------------------------------------------------------------------------------


def test_the_noisy_line_is_what_its_script_writes() -> None:
    assert (CAPTURES / "noisy_line.bin").read_bytes() == make_noisy_line.recording()
    assert (CAPTURES / "noisy_line.md").read_text(encoding="utf-8") == make_noisy_line.description()


def test_the_noisy_line_holds_every_published_frame() -> None:
    seen = {(event.sender, event.data) for event in make_noisy_line.EVENTS}
    senders = {HOST_TO_CONTROLLER: "host", CONTROLLER_TO_HOST: "controller"}

    for example in DOCUMENTED + FROM_ELSEWHERE:
        assert (senders[example.direction], example.frame) in seen


def test_the_noisy_line_reads_as_its_script_says() -> None:
    # One (number of the scanned event, its name) for each byte of the recording.
    owners: list[tuple[int, str]] = []
    for number, scanned in enumerate(scan(make_noisy_line.recording(), None)):
        name = "noise" if isinstance(scanned, bytes) else scanned[0]
        owners += [(number, name)] * len(bytes_of([scanned]))

    offset = 0
    for event in make_noisy_line.EVENTS:
        found = dict(owners[offset : offset + len(event.data)]).values()
        assert (offset, event.hex, ", ".join(found)) == (offset, event.hex, event.reads_as)
        offset += len(event.data)
    assert len(owners) == offset


# --- Independence --------------------------------------------------------------------------------


def test_the_oracle_imports_nothing_but_construct_and_the_standard_library() -> None:
    tree = ast.parse(Path(oracle.__file__).read_text(encoding="utf-8"))
    imported = {
        alias.name
        for node in ast.walk(tree)
        if isinstance(node, ast.Import)
        for alias in node.names
    } | {node.module for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)}

    assert imported == {"collections.abc", "construct", "functools", "operator", "typing"}
