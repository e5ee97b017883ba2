"""Hold the oracle to the documents: their examples, their length rules, their limits, their slips.

Every frame in the table of truth, and every frame here, was typed from the protocol document or
from the notes on the controller family. What passes here may judge the library.
"""

import ast
from pathlib import Path
from typing import Any

import pytest

from tests import oracle
from tests.captures import make_noisy_line
from tests.cases import CASES, Case, each_case
from tests.in_turn import in_turn
from tests.oracle import CONTROLLER_TO_HOST, HOST_TO_CONTROLLER, OracleError, build, parse, scan
from tests.strategies import said

CAPTURES = Path(__file__).parents[1] / "captures"
# Those that somebody has published: of the others, the document has the rule alone.
DOCUMENTED = [case for case in CASES if case.source[0].isdigit()]


def servos(*pairs: tuple[int, int]) -> list[dict[str, int]]:
    """Write (servo id, position) pairs the way the oracle does."""
    return [{"servo_id": servo_id, "position": position} for servo_id, position in pairs]


# --- The published frames, both ways -------------------------------------------------------------


def test_the_document_has_fourteen_examples() -> None:
    assert len(DOCUMENTED) == 14


def test_every_message_with_a_frame_is_known_and_no_other() -> None:
    named = {(case.direction.value, type(case.message).__name__) for case in CASES}
    assert named == {(way, name) for way, names in oracle.MESSAGES.items() for name in names}


@each_case
def test_a_frame_is_read_and_written(case: Case) -> None:
    name, fields = parse(case.frame, case.direction.value)

    assert (name, fields) == said(case.message)
    assert build(name, fields) == case.frame
    # It is plain: text, numbers, lists and dicts.
    assert ast.literal_eval(repr((name, fields))) == (name, fields)


# --- The slips of the document -------------------------------------------------------------------


@in_turn("case", lambda: DOCUMENTED, ids=lambda case: case.source)
def test_the_length_is_the_number_of_parameters_plus_two(case: Case) -> None:
    # "Data length: the number of parameters (N)", says one line, and the next: N + 2.
    assert case.frame[2] == len(case.frame[4:]) + 2


def test_unload_example_2_holds_six_servos_and_not_the_five_of_its_prose() -> None:
    frame = bytes.fromhex("55 55 09 14 06 01 02 03 04 05 06")

    assert parse(frame, HOST_TO_CONTROLLER)[1]["servo_ids"] == [1, 2, 3, 4, 5, 6]
    assert build("ServoUnload", {"servo_ids": [1, 2, 3, 4, 5]}) != frame


# --- Length rules and limits, as printed ---------------------------------------------------------


@in_turn(
    "name, key, others, element, per_servo, fixed, counts",
    lambda: [
        # "The number of servos*3+5"; one byte of length allows 83 servos.
        ("ServoMove", "targets", {"time_ms": 1}, *servos((1, 2)), 3, 5, range(1, 84)),
        # "The numbers of servos+3", twice; 252 servos.
        ("ServoUnload", "servo_ids", {}, 1, 1, 3, range(1, 253)),
        ("ServoPositionsRead", "servo_ids", {}, 1, 1, 3, range(1, 253)),
        # The reply's own rule, which the document leaves out: 3 * servos + 3; 84 servos, or none.
        ("ServoPositions", "positions", {}, *servos((1, 2)), 3, 3, range(85)),
    ],
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


def test_a_request_names_at_least_one_servo() -> None:
    for frame in ("55 55 05 03 00 E8 03", "55 55 03 14 00", "55 55 03 15 00"):
        with pytest.raises(OracleError):
            parse(bytes.fromhex(frame), HOST_TO_CONTROLLER)


# --- What is not exactly one legal frame ---------------------------------------------------------


@in_turn("case", lambda: DOCUMENTED, ids=lambda case: case.source)
def test_an_example_cut_lengthened_or_changed_in_its_head_is_refused(case: Case) -> None:
    frame, counted = case.frame, case.frame[3] in (0x03, 0x14, 0x15)
    others = [frame[:end] for end in range(len(frame))]
    others += [frame + bytes([byte]) for byte in (0x00, 0x55, 0xFF)]
    others += [head + frame[2:] for head in (b"\x55\x54", b"\x54\x55", b"\xaa\xaa", b"\0\0")]
    # The length, and the count where there is one.
    for at in (2, 4) if counted else (2,):
        others += [
            frame[:at] + bytes([byte]) + frame[at + 1 :] for byte in {*range(256)} - {frame[at]}
        ]
    for other in others:
        with pytest.raises(OracleError):
            parse(other, case.direction.value)


@in_turn(
    "direction, commands",
    lambda: [
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
    for text, way in (
        ("55 55 04 0F C9 1E", HOST_TO_CONTROLLER),
        ("55 55 02 0F", CONTROLLER_TO_HOST),
    ):
        with pytest.raises(OracleError):
            parse(bytes.fromhex(text), way)


def test_without_a_direction_a_frame_that_is_legal_both_ways_is_the_hosts() -> None:
    assert parse(bytes.fromhex("55 55 02 07"), None) == ("ActionGroupStop", {})
    assert parse(bytes.fromhex("55 55 05 06 08 01 00"), None)[0] == "ActionGroupRun"
    assert parse(bytes.fromhex("55 55 05 08 08 01 00"), None)[0] == "ActionGroupCompleted"


# --- Values that cannot be sent ------------------------------------------------------------------


@in_turn("value", lambda: [-1, 256, 65536, True, 1.0, "1", b"1", "", None, [1], [1, 2], {}])
def test_a_group_is_one_byte_and_a_time_two(value: object) -> None:
    with pytest.raises(OracleError):
        build("ActionGroupRun", {"group": value, "times": 1})
    if value != 256:
        with pytest.raises(OracleError):
            build("ServoMove", {"time_ms": value, "targets": servos((1, 500))})


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
    frame = bytes.fromhex("55 55 06 14 03 01 02 03")
    assert build("ServoUnload", {"servo_ids": (1, 2, 3)}) == frame


# --- The reading of a whole recording ------------------------------------------------------------

STOP: tuple[str, dict[str, Any]] = ("ActionGroupStop", {})
STREAMS: dict[str, tuple[str, list[Any]]] = {
    "nothing": ("", []),
    "one frame": ("55 55 02 07", [STOP]),
    "two frames": ("55 55 02 07 55 55 02 07", [STOP, STOP]),
    "noise alone": ("00 FF 55 13", [b"\x00\xff\x55\x13"]),
    "noise around": ("00 FF 55 55 02 07 13", [b"\x00\xff", STOP, b"\x13"]),
    "a stray 55": ("55 55 55 02 07", [b"\x55", STOP]),
    "a stray header": ("55 55 55 55 02 07", [b"\x55\x55", STOP]),
    "the length of an unknown one": ("55 55 FF 55 55 02 07", [b"\x55\x55\xff", STOP]),
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


@in_turn(
    "data, events",
    lambda: [
        pytest.param(bytes.fromhex(hex_data), events, id=name)
        for name, (hex_data, events) in STREAMS.items()
    ],
)
def test_a_recording_is_read_and_nothing_is_taken_back(data: bytes, events: list[Any]) -> None:
    assert scan(data, HOST_TO_CONTROLLER) == events
    assert bytes_of(events) == data
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


@each_case
def test_a_frame_may_come_until_it_is_there_also_behind_a_stray_55(case: Case) -> None:
    way = case.direction.value
    for end in range(len(case.frame)):
        assert oracle.may_become_frame(case.frame[:end], way)
    assert not oracle.may_become_frame(case.frame, way)
    assert scan(b"\x55" + case.frame, way) == [b"\x55", said(case.message)]


def test_a_stray_55_before_a_move_of_five_is_not_taken_for_an_unload() -> None:
    five = "55 55 14 03 05 DC 05 01 F4 01 02 F4 01 03 F4 01 04 F4 01 05 F4 01"
    noise, message = scan(bytes.fromhex("55" + five), HOST_TO_CONTROLLER)

    assert noise == b"\x55"
    assert message == parse(bytes.fromhex(five), HOST_TO_CONTROLLER)


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
    assert {(case.direction.sender, case.frame) for case in DOCUMENTED} <= seen


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
    found = [node for node in ast.walk(tree) if isinstance(node, (ast.Import, ast.ImportFrom))]
    imported = {
        name
        for node in found
        for name in (
            [a.name for a in node.names] if isinstance(node, ast.Import) else [node.module]
        )
    }

    assert imported == {"collections.abc", "construct", "functools", "operator", "typing"}
