"""The verb `stats`: its figures, those of an excerpt, and what it refuses."""

import random
import statistics
import sys
from itertools import pairwise
from pathlib import Path
from typing import Any

import busservo
import lxservo
import lxservo.__main__
import pytest
from busservo import BatteryVoltage, BatteryVoltageRead, ServoMove, ServoPosition, ServoPositions
from framewire.recording.excerpt import Moment
from framewire.tables.stats import extremes

from tests.commands import records, run

ABSENT = 65535
SERVOS = [
    ServoMove(800, [(1, 500), (7, 600)]),
    ServoMove(20, [(1, 40)]),
    busservo.ActionGroupStop(),
    BatteryVoltageRead(),
    BatteryVoltage(7412),
    BatteryVoltage(8001),
    ServoPositions([(1, 510), (2, ABSENT)]),
    ServoPositions([(2, 333)]),
]
BUS = [
    lxservo.PositionRead(servo_id=1),
    lxservo.Position(servo_id=1, position=-5),
    lxservo.Position(servo_id=1, position=1004),
    lxservo.Position(servo_id=9, position=77),
]


def stats(*words: object, **how: Any) -> dict[str, Any]:
    (found,) = records("stats", "--json", *words, **how)
    return dict(found)


def shown(*words: object) -> str:
    status, output, _ = run("stats", *words)
    assert status == 0
    return output


def picked(rows: list[dict[str, Any]], *names: str) -> list[tuple[Any, ...]]:
    """Return some columns."""
    return [tuple(row[name] for name in names) for row in rows]


def encoded(messages: list[Any]) -> bytes:
    return b"".join(each.encode() for each in messages)


@pytest.fixture
def raw(tmp_path: Path) -> Path:
    return tmp_path / "line.bin"


def test_messages_and_noise_are_counted_with_their_bytes(raw: Path) -> None:
    unknown = [bytes.fromhex(f"55 55 04 {command} 01 02") for command in ("4D", "4E", "4D")]
    raw.write_bytes(b"\x13\x14" + encoded(SERVOS) + b"".join(unknown) + b"\x15" + b"UU\x09\x0f")
    found = stats(raw)
    assert picked(found["messages"], "message", "count", "bytes", "share") == [
        ("ServoMove", 2, 23, 0.25),
        ("ActionGroupStop", 1, 4, 0.125),
        ("BatteryVoltageRead", 1, 4, 0.125),
        ("BatteryVoltage", 2, 12, 0.25),
        ("ServoPositions", 2, 19, 0.25),
    ]
    noise = found["noise"]
    assert picked(noise["reasons"], "reason", "count", "bytes") == [
        ("length mismatch", 1, 4),
        ("bad header", 2, 3),
    ]
    assert picked(noise["unknown_frames"], "command", "count", "bytes") == [(77, 2, 12), (78, 1, 6)]
    assert (noise["bytes"], found["bytes"]) == (25, 87)
    assert sum(each["bytes"] for each in found["sent"]) == 87


def test_values_are_given_for_each_servo_and_absent_ones_are_only_counted(raw: Path) -> None:
    raw.write_bytes(encoded(SERVOS))
    found = stats(raw)["values"]
    names = ("message", "field", "number", "lowest", "highest", "absent", "unit")
    assert picked(found, *names) == [
        ("ServoMove", "time_ms", None, 20, 800, 0, "ms"),
        ("ServoMove", "targets.position", 1, 40, 500, 0, None),
        ("ServoMove", "targets.position", 7, 600, 600, 0, None),
        ("BatteryVoltage", "voltage_mv", None, 7412, 8001, 0, "mV"),
        ("ServoPositions", "positions.position", 1, 510, 510, 0, None),
        ("ServoPositions", "positions.position", 2, 333, 333, 1, None),
    ]
    raw.write_bytes(encoded(BUS))
    found = stats(raw, main=lxservo.__main__.main)["values"]
    assert picked(found, "message", "field", "of", "number", "lowest", "highest") == [
        ("Position", "position", "servo_id", 1, -5, 1004),
        ("Position", "position", "servo_id", 9, 77, 77),
    ]


def test_values_of_many_servos_are_put_together(raw: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    some = [ServoPosition(each, 100 + each) for each in range(20)] + [ServoPosition(20, ABSENT)]
    raw.write_bytes(2 * ServoPositions(some).encode())
    together = "ServoPositions.positions.position  100..119 (2 absent)"
    assert f"  {together}, 21 numbers as servo_id\n" in shown(raw)
    # Of still more, none has a range of its own.
    monkeypatch.setattr(extremes, "_MOST_KEYS", 3)
    names = ("number", "count", "absent", "lowest", "highest")
    assert picked(stats(raw)["values"], *names) == [(None, 42, 2, 100, 119)]
    assert f"  {together}\n" in shown(raw)


BEGAN = "# recorded of 'COM7' from 2026-01-02 10:08:07.250000 +0100 on\n"
AGAIN = "# recorded of 'COM7' from 2026-01-02 12:00:00 +0100 on\n"


def line(message: Any, at: float, who: str = "controller") -> str:
    return f"{message.encode().hex(' ')}  # {at:.6f} s, {who}: {type(message).__name__}\n"


def test_rates_gaps_and_loads_of_a_recording(tmp_path: Path) -> None:
    choose = random.Random(7)  # noqa: S311
    times = sorted(round(choose.uniform(1, 60), 6) for _ in range(200))
    asked_at = round(times[-1] + 0.25, 6)
    file = tmp_path / "line.hex"
    told = "".join(line(BatteryVoltage(7000 + number), at) for number, at in enumerate(times))
    file.write_text(BEGAN + told + line(BatteryVoltageRead(), asked_at, "host"))
    found = stats(file)
    seconds = pytest.approx(asked_at - times[0])
    between = [after - before for before, after in pairwise(times)]
    clock = found["span"].pop("clock")
    assert clock.startswith("2026-01-02T09:08:")
    ends = {"first": times[0], "last": pytest.approx(asked_at)}
    assert found["span"] == {**ends, "seconds": seconds, "recordings": 1}
    asked, answered = found["messages"]
    assert (asked["median_gap"], asked["longest_gap"]) == (None, None)
    assert answered["per_second"] == pytest.approx(200 / (asked_at - times[0]))
    assert answered["median_gap"] == pytest.approx(statistics.median(between), abs=1e-6)
    assert answered["longest_gap"] == pytest.approx(max(between), abs=1e-6)
    host, controller = found["sent"]
    assert host["load"] == pytest.approx(4 * 10 / 9600 / (asked_at - times[0]))
    assert controller["load"] == pytest.approx(200 * 6 * 10 / 9600 / (asked_at - times[0]))
    longest = sorted(zip(between, times, range(6, 1200, 6), strict=False), reverse=True)[:5]
    assert picked(found["silences"], "seconds", "time", "offset") == [
        (pytest.approx(gap, abs=1e-6), before, offset) for gap, before, offset in longest
    ]
    faster = stats(file, "--baud", "19200")
    assert faster["sent"][0]["load"] == pytest.approx(host["load"] / 2)


def test_without_times_there_is_no_rate(raw: Path) -> None:
    raw.write_bytes(SERVOS[0].encode() * 2)
    found = stats(raw)
    assert (found["span"], found["silences"]) == (None, [])
    assert found["wire_seconds"] == pytest.approx(26 * 10 / 9600)
    nothing = (None, None, None)
    assert picked(found["messages"], "per_second", "median_gap", "longest_gap") == [nothing]
    page = shown(raw)
    assert "No times in this capture. At 9600 baud, its bytes take 27.1 ms." in page
    assert "per second" not in page
    assert "servo_id 1:500, 7:600" in page


@pytest.mark.parametrize(
    ("missing", "line", "extra"),
    [
        ("numpy", "stats 55", "tables"),
        ("pyarrow", "stats 55", "tables"),
        ("matplotlib", "stats 55 --plot line.svg", "plots"),
        ("pyarrow", "decode 55 --parquet folder", "tables"),
    ],
)
def test_a_missing_extra_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, missing: str, line: str, extra: str
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setitem(sys.modules, missing, None)
    # As it is where nothing has imported them yet.
    modules = [f"command.{name}" for name in ("measuring", "drawing", "arrow_tables")]
    forgotten = tuple(f"framewire.{each}" for each in ("tables", *modules))
    for name in [each for each in sys.modules if each.startswith(forgotten)]:
        monkeypatch.delitem(sys.modules, name)
    status, output, errors = run(*line.split())
    # Nor is what was imported meanwhile left beside that of before.
    for name in [each for each in sys.modules if each.startswith(forgotten)]:
        del sys.modules[name]
    assert (status, output) == (2, "")
    assert errors.startswith(f"busservo: error: {missing} is needed here, and cannot be imported")
    assert errors.endswith(f"pip install 'busservo[{extra}]'\n")
    # What needs none of them still works.
    assert run("decode", "55550207").status == 0


# ------------------------------------------------------------------ excerpts

# 0.1 and 0.2 s are no floats that add up.
TIMES = [0.1 + 0.2 * number for number in range(40)]


def written(file: Path, times: list[float], head: str = BEGAN) -> Path:
    lines = (
        line(ServoPositions([(1, round(100 * at)), (4, 9)]), at)
        + line(BatteryVoltage(7000 + round(10 * at)), at + 0.05)
        + f"55 55 05 08  # {at + 0.1:.6f} s, noise: too short\n"
        for at in times
    )
    file.write_text(head + "".join(lines))
    return file


def figures(*words: object) -> dict[str, Any]:
    """Return the figures; of silences, of which many are equal, only how long they are."""
    found = stats(*words)
    return {**found, "silences": [each["seconds"] for each in found["silences"]]}


def test_the_figures_of_an_excerpt_are_those_of_what_came_in_it(tmp_path: Path) -> None:
    whole = written(tmp_path / "whole.hex", TIMES)
    rows = [
        (["--from", "0.7"], 3, 40),
        (["--from", ".7s", "--to", "5s"], 3, 25),
        (["--to", "0m5s"], 0, 25),
        (["--to", "1h"], 0, 40),
        (["--from", "2026-01-02T09:08:08.26", "--to", "2026-01-02 10:08:10.300 +0100"], 5, 15),
        (["--from", "1.01", "--to", "2026-01-02T09:08:10.3Z"], 5, 15),
    ]
    for words, begin, end in rows:
        part = written(tmp_path / "part.hex", TIMES[begin:end])
        assert figures(whole, *words) == figures(part), words
    # Several recordings behind each other are one line of time.
    two, text = tmp_path / "two.hex", whole.read_text()
    two.write_text(text + text.replace(BEGAN, AGAIN))
    found = figures(two, "--from", "7.95", "--to", "8.5")
    assert (found["span"]["first"], found["span"]["recordings"]) == (7.95, 2)
    assert (found["span"]["seconds"], found["noise"]["reasons"][0]["count"]) == (0.55, 4)
    clock = figures(two, "--from", "2026-01-02T11:00")
    assert (clock["span"]["recordings"], clock["messages"][0]["count"]) == (1, 40)


def test_ids_choose_what_is_listed(tmp_path: Path) -> None:
    words = ("stats", "--json", "--ids", "3-5,8", written(tmp_path / "whole.hex", TIMES))
    assert [each["number"] for each in records(*words)[0]["values"]] == [None, 4]
    assert run(*words).err == "no value is measured of 3, 5, 8\n"
    data = encoded([lxservo.Position(servo_id=each, position=each) for each in range(5)])
    values = stats("--ids", "2,3", data.hex(), main=lxservo.__main__.main)["values"]
    assert picked(values, "number", "highest") == [(2, 2), (3, 3)]


def test_what_has_no_figures_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    written(Path("line.hex"), TIMES)
    written(Path("undated.hex"), TIMES, "")
    Path("empty.hex").write_text(BEGAN)
    Path("line.bin").write_bytes(BatteryVoltage(7000).encode())
    Path("broken.hex").write_text(f"{BEGAN}55 5  # 1.0 s, host: what\n")
    goes = "it goes from 0.100 s to 8.000 s"
    dated = f"{goes}, 2026-01-02 09:08:07 to 2026-01-02 09:08:15 UTC"
    late, later = "2026-01-02T10:08:08", "2027-01-02T10:00"
    rows = [
        ("line.hex --from 5 --to 4", "--from 5 is behind --to 4"),
        (f"line.hex --from {later} --to {late}", f"--from {later} is behind --to {late}"),
        ("line.hex --from 1h", f"line.hex: --from 1h is behind its end: {dated}"),
        ("line.hex --to 0.05", f"line.hex: --to 0.05 is before its first event: {dated}"),
        ("line.hex --from 0.21 --to 0.22", f"line.hex: nothing came from 0.21 to 0.22: {dated}"),
        (f"line.hex --from {late}", f"line.hex: --from {late} is behind its end: {dated}"),
        ("undated.hex --from 10", f"undated.hex: --from 10 is behind its end: {goes}"),
        (
            f"undated.hex --to {late}",
            "undated.hex: it does not say when it began: give seconds since then",
        ),
        ("line.bin --to 9", "line.bin: it holds no times, so it has no part to 9"),
        ("empty.hex --to 9", "empty.hex: it holds no event, so it has no part to 9"),
        ("line.hex --ids 6-1", "argument --ids: 6-1 has its higher number first"),
        ("line.hex --ids 1,x", "argument --ids: 'x' is neither a number nor a range like 1-6"),
        ("line.hex --ids 1-65536", "argument --ids: 1-65536 is outside 0..65535"),
        ("broken.hex", "broken.hex, line 2: no hex: '5' is half a byte; did you mean 05?"),
    ]
    found = []
    for words, _ in rows:
        status, output, errors = run("stats", *words.split())
        assert (status, output) == (2, "")
        found.append((words, errors.splitlines()[0].removeprefix("busservo: error: ")))
    assert found == rows


@pytest.mark.parametrize("word", ["", "s", "-1", "1s2", "1m1h", "2026-02-31T10:00", "9:00", "x"])
def test_what_is_no_time_is_refused(word: str) -> None:
    with pytest.raises(ValueError, match="is no time: write it like 90, 1m30s or 1h, or like"):
        Moment(word)
