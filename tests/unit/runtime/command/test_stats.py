"""The verb `stats`: its numbers are those of the decoder's events, and its drawing shows them."""

from __future__ import annotations

import io
import json
import random
import statistics
import sys
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import busservo
import busservo.__main__
import lxservo
import lxservo.__main__
import pytest
from busservo import (
    BatteryVoltage,
    BatteryVoltageRead,
    ServoMove,
    ServoPosition,
    ServoPositions,
    ServoTarget,
    recordings,
)
from busservo.__main__ import main
from framewire.tables.stats import extremes

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable
    from pathlib import Path
    from types import ModuleType

Capture = pytest.CaptureFixture[str]

BEGAN = "# recorded of 'COM7' from 2026-01-02 09:08:07.250000 +0000 on\n"
ABSENT = 65535


def stats(capsys: Capture, *words: str, run: Callable[[list[str]], int] = main) -> dict[str, Any]:
    assert run(["stats", "--json", *words]) == 0
    found: dict[str, Any] = json.loads(capsys.readouterr().out)
    return found


def line(message: Any, at: float, who: str = "controller") -> str:
    return f"{message.encode().hex(' ')}  # {at:.6f} s, {who}: {type(message).__name__}\n"


def events(library: ModuleType, data: bytes) -> list[Any]:
    """Return what the stream decoder makes of bytes, neighbouring noise joined."""
    decoder = library.StreamDecoder(None)
    found: list[Any] = []
    for event in [*decoder.feed(data), *decoder.flush()]:
        noise = [each for each in (*found[-1:], event) if type(each) is library.Noise]
        if len(noise) == 2 and noise[0].reason is event.reason:
            found[-1] = library.Noise(noise[0].data + event.data, event.reason)
        else:
            found.append(event)
    return found


def counted(pairs: Iterable[tuple[Any, int]]) -> dict[Any, list[int]]:
    """Count things, and their bytes."""
    found: dict[Any, list[int]] = {}
    for name, size in pairs:
        some = found.setdefault(name, [0, 0])
        some[0] += 1
        some[1] += size
    return found


def hostile(library: ModuleType, messages: list[Any], seed: int) -> bytes:
    """Return messages among noise, halves of frames and frames of unknown commands."""
    choose = random.Random(seed)  # noqa: S311
    parts = []
    for _ in range(400):
        frame = choose.choice(messages).encode()
        kind = choose.randrange(12)
        if kind == 0:
            frame = frame[: choose.randrange(len(frame))]
        elif kind == 1:
            frame = choose.randbytes(choose.randrange(9))
        elif kind == 2:
            frame = b"UU" * choose.randrange(4)
        elif kind == 3 and library is busservo:
            frame = b"UU\x04" + bytes([choose.choice([77, 78]), 1, 2])
        parts.append(frame)
    return b"".join(parts)


SERVOS = [
    ServoMove(800, [ServoTarget(1, 500), ServoTarget(7, 600)]),
    ServoMove(20, [ServoTarget(1, 40)]),
    busservo.ActionGroupStop(),
    BatteryVoltageRead(),
    BatteryVoltage(7412),
    BatteryVoltage(8001),
    ServoPositions([ServoPosition(1, 510), ServoPosition(2, ABSENT)]),
    ServoPositions([ServoPosition(2, 333)]),
]
BUS = [
    lxservo.Move(servo_id=1, position=200, time_ms=100),
    lxservo.PositionRead(servo_id=1),
    lxservo.Position(servo_id=1, position=-5),
    lxservo.Position(servo_id=1, position=1004),
    lxservo.Position(servo_id=9, position=77),
    lxservo.Voltage(servo_id=9, voltage_mv=6900),
]


@pytest.mark.parametrize(
    ("library", "run", "messages"),
    [(busservo, busservo.__main__.main, SERVOS), (lxservo, lxservo.__main__.main, BUS)],
    ids=["busservo", "lxservo"],
)
@pytest.mark.parametrize("seed", range(4))
def test_counts_are_those_of_the_decoder(
    capsys: Capture,
    tmp_path: Path,
    library: ModuleType,
    run: Callable[[list[str]], int],
    messages: list[Any],
    seed: int,
) -> None:
    file = tmp_path / "line.bin"
    data = hostile(library, messages, seed)
    file.write_bytes(data)
    found = stats(capsys, "--format", "raw", str(file), run=run)
    every = events(library, data)
    known = [each for each in every if not isinstance(each, library.Noise)]
    noise = [each for each in every if type(each) is library.Noise]
    unknown = [each for each in every if isinstance(each, library.UnknownFrame)]
    assert found["bytes"] == len(data)
    assert {each["message"]: [each["count"], each["bytes"]] for each in found["messages"]} == (
        counted((type(each).__name__, len(each.encode())) for each in known)
    )
    assert {
        each["reason"]: [each["count"], each["bytes"]] for each in found["noise"]["reasons"]
    } == counted((each.reason.value, len(each.data)) for each in noise)
    assert found["noise"]["bytes"] == sum(len(each.data) for each in (*noise, *unknown))
    assert {
        each["command"]: [each["count"], each["bytes"]] for each in found["noise"]["unknown_frames"]
    } == counted((each.command, len(each.data)) for each in unknown)
    assert sum(each["bytes"] for each in found["sent"]) == len(data)
    assert sum(each["share"] for each in found["messages"]) == pytest.approx(1)


def test_the_bytes_of_noise_are_whose_line_it_is(capsys: Capture, tmp_path: Path) -> None:
    file = tmp_path / "line.bin"
    file.write_bytes(SERVOS[0].encode() + b"noise")
    either = stats(capsys, str(file))["sent"]
    assert [(each["from"], each["bytes"]) for each in either] == [
        ("host", 13),
        ("controller", 0),
        ("either", 5),
    ]
    host = stats(capsys, str(file), "--direction", "host")["sent"]
    assert [(each["from"], each["bytes"]) for each in host] == [("host", 18), ("controller", 0)]


def test_values_are_given_for_each_servo_and_absent_ones_are_only_counted(
    capsys: Capture, tmp_path: Path
) -> None:
    file = tmp_path / "line.bin"
    file.write_bytes(b"".join(each.encode() for each in SERVOS))
    found = stats(capsys, str(file))["values"]
    assert [
        (each["message"], each["field"], each["number"], each["lowest"], each["highest"])
        for each in found
    ] == [
        ("ServoMove", "time_ms", None, 20, 800),
        ("ServoMove", "targets.position", 1, 40, 500),
        ("ServoMove", "targets.position", 7, 600, 600),
        ("BatteryVoltage", "voltage_mv", None, 7412, 8001),
        ("ServoPositions", "positions.position", 1, 510, 510),
        ("ServoPositions", "positions.position", 2, 333, 333),
    ]
    assert [each["absent"] for each in found] == [0, 0, 0, 0, 0, 1]
    assert {each["unit"] for each in found} == {None, "ms", "mV"}


def test_values_of_many_servos_are_taken_together(
    capsys: Capture, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = tmp_path / "line.bin"
    some = [ServoPosition(each, 100 + each) for each in range(20)] + [ServoPosition(20, ABSENT)]
    file.write_bytes(2 * ServoPositions(some).encode())
    assert main(["stats", str(file)]) == 0
    together = "ServoPositions.positions.position  100..119 (2 absent)"
    assert f"  {together}, 21 numbers as servo_id\n" in capsys.readouterr().out
    # Of still more, none has a range of its own.
    monkeypatch.setattr(extremes, "_MOST_KEYS", 3)
    (found,) = stats(capsys, str(file))["values"]
    assert (found["number"], found["count"], found["absent"]) == (None, 42, 2)
    assert (found["lowest"], found["highest"]) == (100, 119)
    assert main(["stats", str(file)]) == 0
    assert f"  {together}\n" in capsys.readouterr().out


def test_values_of_a_bus_are_given_for_each_address(capsys: Capture, tmp_path: Path) -> None:
    file = tmp_path / "line.bin"
    file.write_bytes(b"".join(each.encode() for each in BUS))
    found = stats(capsys, str(file), run=lxservo.__main__.main)["values"]
    assert [
        (each["field"], each["of"], each["number"], each["lowest"], each["highest"])
        for each in found
        if each["message"] == "Position"
    ] == [("position", "servo_id", 1, -5, 1004), ("position", "servo_id", 9, 77, 77)]


def recording(tmp_path: Path, times: list[float]) -> Path:
    file = tmp_path / "line.hex"
    lines = [line(BatteryVoltage(7000 + number), at) for number, at in enumerate(times)]
    lines += [line(BatteryVoltageRead(), times[-1] + 0.25, "host")]
    file.write_text(BEGAN + "".join(lines))
    return file


def test_rates_gaps_and_loads_of_a_recording(capsys: Capture, tmp_path: Path) -> None:
    choose = random.Random(7)  # noqa: S311
    times = sorted(round(choose.uniform(1, 60), 6) for _ in range(200))
    file = recording(tmp_path, times)
    found = stats(capsys, str(file))
    entries = [*recordings.read(file)]
    at = [each.time for each in entries if each.time is not None]
    seconds = at[-1] - at[0]
    between = [after - before for before, after in pairwise(times)]
    assert found["span"] == {
        "first": times[0],
        "last": pytest.approx(at[-1]),
        "seconds": pytest.approx(seconds),
        "clock": found["span"]["clock"],
        "recordings": 1,
    }
    assert found["span"]["clock"].startswith("2026-01-02T09:08:")
    asked, answered = found["messages"]
    assert (asked["median_gap"], asked["longest_gap"]) == (None, None)
    assert answered["per_second"] == pytest.approx(200 / seconds)
    assert answered["median_gap"] == pytest.approx(statistics.median(between), abs=1e-6)
    assert answered["longest_gap"] == pytest.approx(max(between), abs=1e-6)
    host, controller = found["sent"]
    assert host["load"] == pytest.approx(4 * 10 / 9600 / seconds)
    assert controller["load"] == pytest.approx(200 * 6 * 10 / 9600 / seconds)
    longest = sorted(zip(between, times, range(6, 1200, 6), strict=False), reverse=True)[:5]
    assert [(each["seconds"], each["time"], each["offset"]) for each in found["silences"]] == [
        (pytest.approx(gap, abs=1e-6), before, offset) for gap, before, offset in longest
    ]
    faster = stats(capsys, str(file), "--baud", "19200")
    assert faster["sent"][0]["load"] == pytest.approx(host["load"] / 2)


def test_the_median_of_many_gaps_is_right_to_a_percent(capsys: Capture, tmp_path: Path) -> None:
    choose = random.Random(3)  # noqa: S311
    times, now = [], 0.0
    for _ in range(9000):
        now += choose.choice([0.01, 0.02, 0.5])
        times.append(round(now, 6))
    (_, answered) = stats(capsys, str(recording(tmp_path, times)))["messages"]
    assert answered["median_gap"] == pytest.approx(0.02, rel=0.01)


def test_the_time_between_two_recordings_is_no_silence(capsys: Capture, tmp_path: Path) -> None:
    file = tmp_path / "two.hex"
    first = BEGAN + line(BatteryVoltage(7000), 1.0) + line(BatteryVoltage(7001), 3.0)
    second = first.replace("09:08:07", "17:00:00")
    file.write_text(first + second)
    found = stats(capsys, str(file))
    assert found["span"]["recordings"] == 2
    assert found["span"]["seconds"] == 4.0
    assert [each["seconds"] for each in found["silences"]] == [2.0, 2.0]
    (answered,) = found["messages"]
    assert (answered["count"], answered["longest_gap"]) == (4, 2.0)


def test_without_times_there_is_no_rate(capsys: Capture, tmp_path: Path) -> None:
    file = tmp_path / "line.bin"
    file.write_bytes(SERVOS[0].encode() * 2)
    found = stats(capsys, str(file))
    assert (found["span"], found["silences"]) == (None, [])
    assert found["wire_seconds"] == pytest.approx(26 * 10 / 9600)
    (moved,) = found["messages"]
    assert (moved["per_second"], moved["median_gap"], moved["longest_gap"]) == (None, None, None)
    assert main(["stats", str(file)]) == 0
    shown = capsys.readouterr().out
    assert "No times in this capture. At 9600 baud, its bytes take 27.1 ms." in shown
    assert "per second" not in shown
    assert "servo_id 1:500, 7:600" in shown


@pytest.mark.parametrize("data", [b"", b"U", b"noise and nothing else" * 9])
def test_a_capture_without_a_message_has_statistics_too(
    capsys: Capture, monkeypatch: pytest.MonkeyPatch, data: bytes
) -> None:
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(data)))
    found = stats(capsys, "--format", "raw", "-")
    assert (found["bytes"], found["noise"]["bytes"]) == (len(data), len(data))
    assert (found["messages"], found["values"]) == ([], [])
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(data)))
    assert main(["stats", "--format", "raw"]) == 0
    assert capsys.readouterr().out.startswith(f"standard input: {len(data)} byte")


def test_a_broken_recording_names_its_line(capsys: Capture, tmp_path: Path) -> None:
    file = tmp_path / "line.hex"
    file.write_text(BEGAN + line(BatteryVoltage(1), 0.5) + "55 5  # 1.0 s, host: what\n")
    assert main(["stats", str(file)]) == 2
    output, errors = capsys.readouterr()
    assert output == ""
    assert errors.startswith(f"busservo: error: {file}, line 3: no hex: '5' is half a byte")


@pytest.mark.parametrize(
    ("missing", "words", "extra"),
    [("numpy", [], "tables"), ("pyarrow", [], "tables"), ("matplotlib", ["--plot"], "plots")],
)
def test_a_missing_extra_is_named(
    capsys: Capture,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    missing: str,
    words: list[str],
    extra: str,
) -> None:
    monkeypatch.setitem(sys.modules, missing, None)
    for name in [*sys.modules]:
        if name.startswith(
            ("framewire.tables", "framewire.command.measuring", "framewire.command.drawing")
        ):
            monkeypatch.delitem(sys.modules, name)
    picture = [str(tmp_path / "a.svg")] * len(words)
    assert main(["stats", "55", *words, *picture]) == 2
    output, errors = capsys.readouterr()
    assert output == ""
    assert f"busservo: error: {missing} is needed here" in errors
    assert errors.endswith(f"pip install 'busservo[{extra}]'\n")
