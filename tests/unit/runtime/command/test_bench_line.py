"""The verb `bench-line`: what it measures, and its output for questions without an answer."""

import re
from types import SimpleNamespace
from unittest import mock

import pytest
from busservo import BatteryVoltage, Controller, Message, ServoPositions
from busservo_simulator import Faults, VirtualController
from framewire.command import bench_line

from tests.commands import Ended, records, run
from tests.lines.timed_line import client_on
from tests.lines.virtual_line import VirtualLine
from tests.timeouts import GENEROUS

Replies = list[tuple[float, bytes | Message]]
PATIENT = ("--timeout", GENEROUS)


def test_round_trips_and_the_share_of_the_line_rate_are_reported() -> None:
    words = ("ServoPositionsRead", "servo_ids=1,2,3,4,5,6", "-n", "5")
    with VirtualController("tcp", baud=9600) as board:
        status, output, _ = run("bench-line", "--port", board.port, *words, *PATIENT)
        assert (status, board.accepted, board.rejects.total) == (0, 5, 0)
    first, wire, trips, rate, errors = output.splitlines()
    question = "ServoPositionsRead servo_ids=1,2,3,4,5,6"
    assert first == f"{question} on {board.port}: 5 requests, 5 answered"
    assert wire == "  the wire alone  35.42 ms: 11 bytes there and 23 back, at 9600 baud"
    times = [float(each) for each in re.findall(r"([0-9.]+) ms", trips)]
    assert times == sorted(times)
    assert times[0] >= 35.42
    share = re.fullmatch(r"  rate +[0-9.]+ a second, ([0-9.]+)% of what the line allows", rate)
    assert share is not None
    assert 0 < float(share[1]) <= 100
    assert errors == "  errors          none"


def test_a_line_that_takes_no_time_allows_any_rate() -> None:
    with VirtualController("tcp") as board:
        words = ("bench-line", "--port", board.port, "-n", "3", "--baud", "inf", *PATIENT)
        _, wire, _, rate, _ = run(*words).out.splitlines()
        (found,) = records(*words, "--json")
    size = "4 bytes there and 6 back"
    assert wire == f"  the wire alone  0.00 ms: {size}, on a line that takes no time"
    assert re.fullmatch("  rate +[0-9.]+ a second", rate)
    assert (found["baud"], found["wire"], found["share"]) == (None, 0.0, None)


def measured(line: VirtualLine, *words: str) -> Ended:
    """Measure the line to a device, in its own time."""
    client = client_on(line, Controller)
    with (
        mock.patch.object(bench_line, "open_client", return_value=client),
        mock.patch.object(bench_line, "time", SimpleNamespace(perf_counter=line.clock)),
    ):
        return run("bench-line", "--port", "COM7", *words)


def test_replies_faster_than_the_line_rate_are_reported() -> None:
    line = VirtualLine(lambda _: [(0.001, BatteryVoltage(7500))])
    status, output, _ = measured(line, "-n", "30")
    assert status == 0
    assert "it is faster than that rate, so try --baud inf" in output
    assert "too soon        3 questions had a reply that no such wire can have carried" in output
    assert "slips" not in output


def test_a_duplicate_reply_is_counted_and_not_taken_for_speed() -> None:
    twice: Replies = [(0.0105, BatteryVoltage(7500)), (0.0107, BatteryVoltage(7500))]
    answers = iter([twice])
    status, output, _ = measured(VirtualLine(lambda _: next(answers, twice[:1])), "-n", "30")
    assert status == 0
    assert "faster" not in output
    assert "slips           1 reply to nothing, sent twice or too late: dropped" in output


def test_errors_are_counted_by_kind() -> None:
    replies: list[Replies] = [
        [(0.0, ServoPositions([(1, 5), (2, 6)]))],
        [],
        [(0.0, ServoPositions([(2, 6)]))],
        [(0.0, BatteryVoltage(7500))],
        [(0.0, b"noise")],
        [(0.0, ServoPositions([(1, 5), (2, 6)]))],
    ]
    line = VirtualLine(lambda _: replies.pop(0))
    status, output, _ = measured(line, "ServoPositionsRead", "servo_ids=1,2", "-n", "6")
    assert status == 1
    first, *_, errors, without = output.splitlines()
    assert first.endswith(" on COM7: 6 requests, 3 answered")
    assert errors == "  errors          3 no reply, 1 incomplete reply"
    assert without == (
        "  without a reply 5 bytes came that are no frame: wrong baud rate?; "
        "1 report came, so the device can be heard"
    )


def test_a_lost_line_ends_the_measurement() -> None:
    with VirtualController("tcp", faults=Faults(hang_up=1.0)) as board:
        status, output, errors = run("bench-line", "--port", board.port, *PATIENT)
    assert output.splitlines()[0].endswith(": 0 requests, 0 answered")
    assert (status, "the line was lost" in errors) == (3, True)


def test_without_a_reply_there_are_no_times() -> None:
    status, output, _ = run("bench-line", "--port", "loop://", "--timeout", "0.02", "-n", "2")
    assert status == 1
    assert output.splitlines() == [
        "BatteryVoltageRead on loop://: 2 requests, 0 answered",
        "  errors          2 no reply",
        "  without a reply 8 bytes came that are no frame: wrong baud rate?",
    ]


def test_a_question_must_be_named_where_each_has_fields(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(bench_line, "_usual", lambda _: None)
    status, _, errors = run("bench-line", "--port", "no-such-port")
    assert (status, "name the question to measure" in errors) == (2, True)
    assert "questions are BatteryVoltageRead, ServoPositionsRead" in errors
