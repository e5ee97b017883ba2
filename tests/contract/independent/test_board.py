"""The independent board and what else is written apart: by the document, and in no code of ours."""

from __future__ import annotations

import ast
import math
import sys
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.contract.independent import faults, firmware
from tests.contract.independent.board import Board
from tests.contract.independent.levels import received
from tests.contract.independent.ports import VirtualPort
from tests.contract.independent.strangers import Print, Stranger
from tests.in_turn import in_turn

HERE = Path(__file__).parent
PARTS = ["firmware", "faults", "board", "ports", "levels", "strangers"]
# One byte at 9600 baud, 8N1.
BYTE = 10 / 9600
# Sent by a host, and what a board of group 8 answers: the first reply is numbered 1.
SPOKEN = {
    "move": ("55 55 08 03 01 E8 03 01 20 03", ""),
    "move two": ("55 55 0B 03 02 20 03 02 20 03 09 20 03", ""),
    "run": ("55 55 05 06 08 01 00", "55 55 05 06 08 01 00"),
    "stop, with nothing running": ("55 55 02 07", ""),
    "run for ever, stop": ("55 55 05 06 02 00 00 55 55 02 07", "55 55 05 06 02 00 00 55 55 02 07"),
    "speed": ("55 55 05 0B 08 32 00", ""),
    "speed of all": ("55 55 05 0B FF 2C 01", ""),
    "battery": ("55 55 02 0F", "55 55 04 0F 01 00"),
    "unload": ("55 55 06 14 03 01 02 03", ""),
    "unload six": ("55 55 09 14 06 01 02 03 04 05 06", ""),
    "positions": (
        "55 55 09 15 06 01 02 03 04 05 06",
        "55 55 15 15 06 01 01 00 02 01 00 03 01 00 04 01 00 05 01 00 06 01 00",
    ),
    "noise, then battery": ("00 55 13 55 55 02 0F", "55 55 04 0F 01 00"),
}


@in_turn("part", lambda: PARTS)
def test_it_shares_no_code_with_what_it_tests(part: str) -> None:
    tree = ast.parse((HERE / f"{part}.py").read_text(encoding="utf-8"))
    imports = [each for each in ast.walk(tree) if isinstance(each, ast.Import)]
    names = [alias.name for each in imports for alias in each.names]
    names += [str(each.module) for each in ast.walk(tree) if isinstance(each, ast.ImportFrom)]
    apart = {"typing_extensions", *(f"tests.contract.independent.{each}" for each in PARTS)}
    assert names
    shared = [each for each in names if each.split(".")[0] not in sys.stdlib_module_names]
    assert {*shared} <= apart


@in_turn("name", lambda: SPOKEN)
def test_it_answers_as_the_document_says(name: str) -> None:
    sent, answered = SPOKEN[name]
    board = Board()
    board.write(bytes.fromhex(sent), 0)
    assert board.read(0) == bytes.fromhex(answered)
    assert board.refused == []


def test_a_group_that_has_ended_is_reported() -> None:
    board = Board(group_seconds=1)
    board.write(firmware.frame(firmware.RUN, b"\x08\x02\x00"), 0)
    assert board.read(1.9) == bytes.fromhex("55 55 05 06 08 02 00")
    assert board.next_event == 2
    assert board.read(2) == bytes.fromhex("55 55 05 08 08 02 00")
    assert board.reported == [board.said[0].data, board.said[1].data]


def test_a_frame_that_was_cut_off_eats_the_beginning_of_the_next() -> None:
    board = Board()
    board.write(bytes.fromhex("55 55 08 03 01 E8") + 2 * firmware.battery_question(), 0)
    swallowed = bytes.fromhex("55 55 08 03 01 E8 55 55 02 0F")
    frames = [received.frame for received in board.received]
    assert frames == [swallowed, firmware.battery_question()]
    assert board.read(0) == firmware.battery_reply(1)


def test_each_answer_has_a_number_of_its_own() -> None:
    board = Board(servos=[2])
    for _ in range(2):
        board.write(firmware.battery_question() + firmware.positions_question([1, 2]), 0)
    replies = board.read(0)
    assert replies == b"".join(
        firmware.battery_reply(n) + firmware.positions_reply([(2, n + 1)]) for n in (1, 3)
    )
    assert [received.number for received in board.received] == [1, 2, 3, 4]


REPLY, REPORT = firmware.battery_reply(1), firmware.report(firmware.STOPPED)
BEHIND = faults.Piece(0.5, REPORT, is_report=True)
# The script, and what comes within a tenth of a second, and after that.
SCRIPTS = {
    "duplicated": (faults.duplicated(), 2 * REPLY, b""),
    "duplicated later": (faults.duplicated(0.5), REPLY, REPLY),
    "late": (faults.late(0.5), b"", REPLY),
    "dropped": (faults.dropped, b"", b""),
    "cut": (faults.cut(4), REPLY[:4], b""),
    "cut, silence, report": (faults.cut(4, BEHIND), REPLY[:4], REPORT),
    "bytes lost": (faults.lost(2, 2), REPLY[:2] + REPLY[4:], b""),
    "wrong count": (faults.miscounted(-1), REPLY[:4] + b"\x00\x00", b""),
    "wrong length": (faults.mislengthened(1), REPLY[:2] + b"\x05" + REPLY[3:], b""),
    "noise before": (faults.preceded(b"\x00\x55"), b"\x00\x55" + REPLY, b""),
    "report between": (faults.preceded(REPORT, is_report=True), REPORT + REPLY, b""),
    "report behind": (faults.followed(REPORT, 0.5, is_report=True), REPLY, REPORT),
    "a pause within": (faults.halted(3, 0.5), REPLY[:3], REPLY[3:]),
}


ASKED = firmware.battery_question()
# When which bytes are with the host that asks at 0 s.
ARRIVALS: dict[str, tuple[dict[str, Any], list[tuple[float, bytes]]]] = {
    "byte by byte": ({}, [((5 + n) * BYTE, REPLY[n : n + 1]) for n in range(6)]),
    "what has come in its time": ({"latency": 0.016}, [(0.016, REPLY)]),
    "each frame when it is whole": (
        {"gathers": True, "faults": {1: faults.duplicated()}.get},
        [(10 * BYTE, REPLY), (16 * BYTE, REPLY)],
    ),
    "what is sent, from a half-duplex adapter": (
        {"echo": True, "thinks": 0.01},
        [((1 + n) * BYTE, ASKED[n : n + 1]) for n in range(4)]
        + [((5 + n) * BYTE + 0.01, REPLY[n : n + 1]) for n in range(6)],
    ),
}


@in_turn("name", lambda: ARRIVALS)
def test_bytes_take_their_time_both_ways(name: str) -> None:
    given, expected = ARRIVALS[name]
    port = VirtualPort(Board(baud=9600, **given))
    port.write(ASKED)
    came = []
    while data := port.read(1):
        came.append((port.now, data))
    assert [data for _, data in came] == [data for _, data in expected]
    assert [at for at, _ in came] == pytest.approx([at for at, _ in expected])


@in_turn("name", lambda: SCRIPTS)
def test_a_fault_happens_to_the_reply_that_it_is_meant_for(name: str) -> None:
    script, soon, later = SCRIPTS[name]
    board = Board(faults={1: script}.get)
    board.write(firmware.battery_question(), 0)
    assert board.read(0.1) == soon
    assert board.read(1) == later
    assert board.reported == [REPORT] * ("report" in name)
    board.write(firmware.battery_question(), 1)
    assert board.read(1) == firmware.battery_reply(2)


def test_another_is_answered_while_a_reply_is_late() -> None:
    board = Board(faults={1: faults.late(0.5)}.get)
    board.write(firmware.battery_question(), 0)
    board.write(firmware.battery_question(), 0.2)
    assert board.read(0.3) == firmware.battery_reply(2)
    assert board.read(math.inf) == firmware.battery_reply(1)


# --------------------------------------------------------- levels of a line, and strangers
@given(data=st.binary(max_size=40), rate=st.sampled_from([9600.0, 115200.0]))
def test_a_port_of_the_same_rate_reads_what_was_sent(data: bytes, rate: float) -> None:
    assert received(data, sent_at=rate, read_at=rate) == data
    # No port is exact: by up to two per cent, all bits are read as they are.
    assert received(data, sent_at=rate, read_at=rate * 1.02) == data
    assert received(data, sent_at=rate, read_at=rate * 0.98) == data


# Worked out on paper, by the levels of start bit, data and stop bit.
LEVELS = [
    # 00 11 00 11 00 11 00 11 00 11, read a level at a time; the first stop bit is low.
    ("55", 2.0, False, "66 E6"),
    # 0000000001 1111..., of which every second level is read.
    ("00", 0.5, False, "F8"),
    # 1 01010101 0 on a line that is low: it falls behind what was the start bit.
    ("55", 1.0, True, "55"),
    ("55 55", 1.0, True, "55 55"),
    ("FF", 1.0, True, "00"),
    ("00", 1.0, True, "00"),
]


@in_turn("sent, rate, inverted, read", lambda: LEVELS)
def test_a_port_reads_the_levels_by_its_own_rate(
    sent: str, rate: float, inverted: bool, read: str
) -> None:
    data = bytes.fromhex(sent)
    found = received(data, sent_at=9600, read_at=9600 * rate, inverted=inverted)
    assert found.hex(" ").upper() == read


def test_a_stranger_prints_at_its_times_and_begins_anew_when_it_resets() -> None:
    for resets, later in ((False, b"b"), (True, b"a")):
        stranger = Stranger(Print(1.0, b"a"), Print(2.0, b"b", 3.0), resets=resets)
        assert [stranger.read(at) for at in (0.5, 1.0, 2.5, 5.5)] == [b"", b"a", b"b", b"b"]
        stranger.opened(9600, 7.0)
        assert stranger.next_event == 8.0
        assert stranger.read(8.5) == later
