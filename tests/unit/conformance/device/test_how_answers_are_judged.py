"""Errors of a device are found, and named; variations that it may have are no fault."""

import pytest
from framegen.conformance.device.judgement import judge
from framegen.conformance.device.permission import permit
from framegen.conformance.device.queries import requests
from framegen.conformance.device.recording import Recording
from framegen.conformance.device.session import Session, Timing
from hypothesis import given
from hypothesis import strategies as st

from tests.contract.independent import faults, firmware
from tests.contract.independent.board import Board
from tests.contract.independent.faults import Piece, Script
from tests.contract.independent.ports import VirtualPort
from tests.in_turn import in_turn
from tests.lines.at_board import end_of, virtual_board
from tests.lines.devices import Answer
from tests.lines.timed_line import TimedLine
from tests.unit.conformance.device.runs import Run, model_of, run

MODEL = model_of()
BATTERY = "BatteryVoltageRead, example 1"
POSITIONS = "ServoPositionsRead, example 1"
TOGETHER = "BatteryVoltageRead and ServoPositionsRead at once"
# Which query a step sends first.
QUERY = {BATTERY: 1, POSITIONS: 2, "ServoPositionsRead, one element": 3, TOGETHER: 10}
REPORT = firmware.report(firmware.STARTED, 8, 1)
UNKNOWN = bytes.fromhex("55 55 03 63 01")


def on_a_board(
    script: Script | None, at: int = 2, *options: str, thinks: float = 0.002, baud: float = 9600
) -> Run:
    """Return a run on the independent board, with one fault in the reply to that question."""
    scripts = {} if script is None else {at: script}
    board = Board(baud=baud, thinks=thinks, faults=scripts.get, servos=range(1, 7))
    return run(MODEL, VirtualPort(board), *options)


def changed(at: int, value: int) -> Script:
    """Return a script that changes one byte of the reply."""
    return lambda reply: [Piece(0.0, reply[:at] + bytes([value]) + reply[at + 1 :])]


@pytest.mark.parametrize("thinks", [0.0, 0.002, 0.2])
@pytest.mark.parametrize("baud", [9600, 115200])
def test_a_board_without_faults_passes(thinks: float, baud: float) -> None:
    done = on_a_board(None, thinks=thinks, baud=baud)
    assert (done.code, done.faults) == (0, [])
    assert done.report["passed"]


@pytest.mark.parametrize(
    "malformed", [False, pytest.param(True, marks=pytest.mark.garbage)], ids=["", "malformed"]
)
def test_the_simulator_passes(malformed: bool) -> None:
    with virtual_board(via="memory", baud=9600) as board:
        done = run(MODEL, end_of(board), *(["--malformed"] if malformed else []))
    assert (done.code, done.faults) == (0, [])
    steps = [step["title"] for step in done.report["steps"] if step["malformed"]]
    assert len(steps) == (7 if malformed else 0)


# What becomes of a reply, to which step, what that is called, and how it is put in words.
NOTHING = "no ServoPositions within 0.285 s"
UNHEADED = (
    "no BatteryVoltage within 0.260 s; 5 bytes came without any header: is the baud rate right?"
)
MISCOUNTED = "count mismatch at byte 4: a length of 21 makes servo_count 6, not 7"
LATE = "ServoPositions came after 0.437 s, and was due within 0.285 s"
UNASKED = "ServoPositions reports positions.servo_id 99, which was not requested"
OVERTAKEN = "BatteryVoltage came after the reply to ServoPositionsRead, which was requested later"
ONCE_MORE = "BatteryVoltage came once more than it was requested"
VOLTAGE = firmware.battery_reply(7500)
FAULTS: dict[str, tuple[Script, str, str, str]] = {
    "dropped": (faults.dropped, POSITIONS, "silence", NOTHING),
    "cut": (faults.cut(7), POSITIONS, "no frame", ""),
    "cut in its header": (faults.cut(1), POSITIONS, "silence", ""),
    "a byte lost": (faults.lost(6, 1), POSITIONS, "no frame", ""),
    "its first byte lost": (faults.lost(0, 1), BATTERY, "silence", ""),
    "a count too high": (
        faults.miscounted(1),
        POSITIONS,
        "no frame",
        f"{NOTHING}; what came is none: {MISCOUNTED}",
    ),
    "a count too low": (faults.miscounted(-1), POSITIONS, "no frame", ""),
    "a length too high": (faults.mislengthened(1), POSITIONS, "no frame", ""),
    "a length too low": (faults.mislengthened(-1), BATTERY, "no frame", ""),
    "late": (faults.late(0.4), POSITIONS, "late reply", LATE),
    "very late": (faults.late(1.0), BATTERY, "late reply", ""),
    "twice": (faults.duplicated(), POSITIONS, "unsolicited reply", ""),
    "once more": (faults.duplicated(), BATTERY, "unsolicited reply", ONCE_MORE),
    "three times": (faults.duplicated(copies=2), BATTERY, "unsolicited reply", ""),
    "of another servo": (changed(5, 99), POSITIONS, "wrong reply", UNASKED),
    "of one servo twice": (changed(5, 2), POSITIONS, "wrong reply", ""),
    "behind the next one": (faults.late(0.05), TOGETHER, "wrong order", OVERTAKEN),
    "of another question": (lambda _: [Piece(0, VOLTAGE)], POSITIONS, "unsolicited reply", ""),
    "zeros": (lambda _: [Piece(0.0, bytes(5))], BATTERY, "silence", UNHEADED),
}


@in_turn("name", lambda: FAULTS)
def test_a_fault_is_found_where_it_is_and_called_by_its_name(name: str) -> None:
    script, title, kind, words = FAULTS[name]
    done = on_a_board(script, QUERY[title])
    assert done.code == 1
    assert (title, kind) in done.faults
    assert {found for found, _ in done.faults} == {title}
    assert not done.report["passed"]
    assert words in [fault["text"] for fault in done.step(title)["faults"]] or not words


def of_servos(*servos: int) -> Script:
    """Return a script that replies with the positions of these."""
    return lambda _: [Piece(0.0, firmware.positions_reply([(servo, 5) for servo in servos]))]


# What a device may do, and how it is noted.
BEGUN = bytes.fromhex("55 55 FC 15 53")
NOTES: dict[str, tuple[Script, str]] = {
    "late, but in time": (faults.late(0.2), ""),
    "with a pause in it": (faults.halted(7, 0.1), ""),
    "noise before it": (faults.preceded(bytes(3)), "noise, bad header: 3 bytes, 00 00 00"),
    "noise behind it": (faults.followed(b"\xff"), "noise, bad header: 1 byte, FF"),
    "a header byte before it": (faults.preceded(b"\x55"), "noise, length mismatch: 1 byte, 55"),
    "a frame begun before it": (
        faults.preceded(BEGUN),
        "noise, too short: 5 bytes, 55 55 FC 15 53",
    ),
    "a report before it": (faults.preceded(REPORT), "report: ActionGroupStarted after 0.0"),
    "a report behind it": (faults.followed(REPORT), "report: ActionGroupStarted after 0.0"),
    "an unknown frame": (faults.preceded(UNKNOWN), "unknown frame: 5 bytes, 55 55 03 63 01"),
    "no servo": (of_servos(), "ServoPositions reports 0 of 6"),
    "four of six": (of_servos(6, 1, 3, 2), "ServoPositions reports 4 of 6"),
}


@in_turn("name", lambda: NOTES)
def test_permitted_behaviour_is_noted_and_no_fault(name: str) -> None:
    script, note = NOTES[name]
    done = on_a_board(script)
    assert (done.code, done.faults) == (0, [])
    notes = done.step(POSITIONS)["notes"]
    assert any(note in each for each in notes) if note else notes == []


def test_bytes_before_the_first_query_are_no_fault() -> None:
    board = Board(baud=9600)
    board.report(firmware.COMPLETED, 8, 1, at=0.1)
    done = run(MODEL, VirtualPort(board), form="text")
    assert "before anything was sent came ActionGroupCompleted group=8 times=1\n" in done.out
    assert done.code == 0


def test_a_line_with_echo_is_reported() -> None:
    done = run(MODEL, VirtualPort(Board(baud=9600, echo=True, servos=range(1, 7))))
    assert done.code == 0
    assert done.step(BATTERY)["notes"] == ["the line gives back what is sent"]
    assert done.step(TOGETHER)["not_sent"].startswith("the line gives back what is sent, and so")


def test_a_silent_device_is_given_up_soon() -> None:
    done = on_a_board(None, 1, "--malformed")
    line = TimedLine()
    silent = run(MODEL, line, "--malformed")
    assert silent.code == 1
    assert len(silent.report["steps"]) == 3 < len(done.report["steps"])
    assert silent.report["stopped"].startswith("nothing comes at all: is the device switched on")
    assert line.now < 6


def test_firmware_that_waits_for_the_rest_of_a_frame_loses_the_query_behind_it() -> None:
    """As the sibling boards do, which have no time-out between bytes."""
    done = on_a_board(None, 1, "--malformed")
    after = "and BatteryVoltageRead at once"
    assert done.faults == [
        (f"a query cut short in its fields, {after}", "silence"),
        (f"a query cut short before its fields, {after}", "silence"),
        (f"a length that is one too many, {after}", "silence"),
    ]
    notes = [step["notes"] for step in done.report["steps"] if step["faults"]]
    assert notes[0] == ["BatteryVoltageRead is answered again: number 2 behind it"]
    assert notes[1:] == [["BatteryVoltageRead is answered again: the next"]] * 2
    assert done.code == 1
    assert not done.report["stopped"]


def silent_after(malformed: bytes) -> Answer:
    """Return a device that hangs after some bytes."""
    board = Board()
    is_silent = False

    def answer(data: bytes) -> list[tuple[float, bytes]]:
        nonlocal is_silent
        is_silent = is_silent or malformed in data
        if is_silent:
            return []
        board.write(data, 0.0)
        return [(0.001, board.read(1.0))]

    return answer


def test_a_device_that_hangs_is_distinguished_from_one_that_recovers() -> None:
    unknown = bytes.fromhex("55 55 02 FF")
    done = run(MODEL, TimedLine(silent_after(unknown)), "--malformed")
    assert done.report["stopped"] == (
        "BatteryVoltageRead is not answered any more, 8 times: switch the device off and on"
    )
    last = done.report["steps"][-1]
    assert (last["title"][:19], last["faults"][0]["kind"]) == ("an id that nobody h", "silence")
    assert done.code == 1


def careless(data: bytes) -> list[tuple[float, bytes]]:
    """Return a device that answers by header and id alone."""
    replies = {15: firmware.battery_reply(7500), 21: firmware.positions_reply([])}
    return [
        (0.001, replies[data[at + 3]])
        for at in range(len(data) - 3)
        if data[at : at + 2] == b"UU" and data[at + 3] in replies
    ]


def test_a_device_that_answers_malformed_frames_is_found() -> None:
    done = run(MODEL, TimedLine(careless), "--malformed")
    found = dict(done.faults)
    assert set(found.values()) == {"unsolicited reply"}
    assert "a count that is one too many, and BatteryVoltageRead at once" in found
    assert "a length that is one too few, and BatteryVoltageRead at once" in found
    texts = [each["text"] for step in done.report["steps"] for each in step["faults"]]
    assert all(text.endswith("does it answer what is no frame?") for text in texts)


def test_a_command_that_is_acknowledged_is_noted() -> None:
    done = on_a_board(None, 1, "--allow", "ActionGroupRun")
    step = done.step("ActionGroupRun, example 1, then BatteryVoltageRead")
    assert step["notes"][0].startswith("report: ActionGroupStarted after 0.0")
    board = Board(baud=9600, unknown_groups=[2, 8])
    ignored = run(MODEL, VirtualPort(board), "--allow", "ActionGroupRun")
    step = ignored.step("ActionGroupRun, example 1, then BatteryVoltageRead")
    assert step["notes"] == ["no ActionGroupStarted came for ActionGroupRun"]
    assert (done.code, ignored.code) == (0, 0)


# What might come: whole replies and pieces of them, reports, the requests, and noise.
REPLIES = [VOLTAGE, *map(firmware.positions_reply, ([(1, 500), (2, 500)], [(9, 500)]))]
WHOLE = st.sampled_from([*REPLIES, firmware.positions_question([1, 2]), REPORT, UNKNOWN, b"UU"])
PIECES = WHOLE | st.binary(max_size=8)


@given(st.lists(st.tuples(st.floats(0, 1.5), PIECES), max_size=6))
def test_any_input_is_judged_within_its_time(pieces: list[tuple[float, bytes]]) -> None:
    line = TimedLine(lambda _: pieces, in_order=False)
    permission = permit(MODEL, [])
    with Recording(MODEL, None) as recording:
        session = Session(line, permission, Timing(9600, 10, 0.25), recording, line.clock)
        transcript = session.send(tuple(requests(permission)[:2]))
    came = b"".join(each.event.data for each in transcript.received)
    ordered = b"".join(data for at, data in sorted(pieces, key=lambda piece: piece[0]))
    assert ordered.startswith(came)
    assert line.now < 3.0
    judgement = judge(MODEL, transcript)
    assert len(judgement.seconds) <= 2
    assert bool(judgement.faults) or len(judgement.seconds) == 2
