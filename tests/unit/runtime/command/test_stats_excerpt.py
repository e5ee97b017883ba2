"""`stats --from --to`: the figures of an excerpt are those of a recording of nothing else."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import lxservo
import lxservo.__main__
import pytest
from busservo import BatteryVoltage, ServoPosition, ServoPositions
from busservo.__main__ import main
from framewire.recording.excerpt import Moment

if TYPE_CHECKING:
    from pathlib import Path

Capture = pytest.CaptureFixture[str]

BEGAN = "# recorded of 'COM7' from 2026-01-02 10:08:07.250000 +0100 on\n"
AGAIN = "# recorded of 'COM7' from 2026-01-02 12:00:00 +0100 on\n"
NOISE = "55 55 05 08  # {:.6f} s, noise: too short\n"
# 0.1 and 0.2 s are no floats that add up.
TIMES = [0.1 + 0.2 * number for number in range(40)]


def line(at: float) -> str:
    read = ServoPositions([ServoPosition(1, round(100 * at)), ServoPosition(4, 9)])
    voltage = BatteryVoltage(7000 + round(10 * at))
    return (
        f"{read.encode().hex(' ')}  # {at:.6f} s, controller: positions\n"
        f"{voltage.encode().hex(' ')}  # {at + 0.05:.6f} s, controller: voltage\n"
        + NOISE.format(at + 0.1)
    )


def written(file: Path, times: list[float], head: str = BEGAN) -> str:
    file.write_text(head + "".join(map(line, times)))
    return str(file)


def figures(capsys: Capture, *words: str) -> dict[str, Any]:
    """Return the figures; of silences, of which many are equal, only how long they are."""
    assert main(["stats", "--json", *words]) == 0
    found: dict[str, Any] = json.loads(capsys.readouterr().out)
    found["silences"] = [each["seconds"] for each in found["silences"]]
    return found


def test_the_figures_are_those_of_what_came_in_it(capsys: Capture, tmp_path: Path) -> None:
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
        assert figures(capsys, whole, *words) == figures(capsys, part), words
    # Several recordings behind each other are one line of time.
    text = (tmp_path / "whole.hex").read_text()
    (tmp_path / "two.hex").write_text(text + text.replace(BEGAN, AGAIN))
    found = figures(capsys, str(tmp_path / "two.hex"), "--from", "7.95", "--to", "8.5")
    assert (found["span"]["first"], found["span"]["recordings"]) == (7.95, 2)
    assert (found["span"]["seconds"], found["noise"]["reasons"][0]["count"]) == (0.55, 4)
    clock = figures(capsys, str(tmp_path / "two.hex"), "--from", "2026-01-02T11:00")
    assert (clock["span"]["recordings"], clock["messages"][0]["count"]) == (1, 40)


def test_ids_choose_what_is_listed(capsys: Capture, tmp_path: Path) -> None:
    whole = written(tmp_path / "whole.hex", TIMES)
    assert main(["stats", "--json", "--ids", "3-5,8", whole]) == 0
    output, errors = capsys.readouterr()
    assert [each["number"] for each in json.loads(output)["values"]] == [None, 4]
    assert errors == "no value is measured of 3, 5, 8\n"
    data = b"".join(lxservo.Position(servo_id=each, position=each).encode() for each in range(5))
    assert lxservo.__main__.main(["stats", "--json", "--ids", "2,3", data.hex()]) == 0
    values = json.loads(capsys.readouterr().out)["values"]
    assert [(each["number"], each["highest"]) for each in values] == [(2, 2), (3, 3)]


def test_an_excerpt_that_cannot_be_is_refused_with_the_bounds(
    capsys: Capture, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    written(tmp_path / "line.hex", TIMES)
    written(tmp_path / "undated.hex", TIMES, "")
    (tmp_path / "empty.hex").write_text(BEGAN)
    (tmp_path / "line.bin").write_bytes(BatteryVoltage(7000).encode())
    day = "2026-01-02 09:08:07 to 2026-01-02 09:08:15 UTC"
    goes = f"it goes from 0.100 s to 8.000 s, {day}"
    rows = [
        ("line.hex --from 5 --to 4", "--from 5 is behind --to 4"),
        (
            "line.hex --from 2027-01-02T10:00 --to 2026-01-02T10:00",
            "--from 2027-01-02T10:00 is behind --to 2026-01-02T10:00",
        ),
        ("line.hex --from 1h", f"line.hex: --from 1h is behind its end: {goes}"),
        ("line.hex --to 0.05", f"line.hex: --to 0.05 is before its first event: {goes}"),
        ("line.hex --from 0.21 --to 0.22", f"line.hex: nothing came from 0.21 to 0.22: {goes}"),
        (
            "line.hex --from 2026-01-02T10:08:08",
            f"line.hex: --from 2026-01-02T10:08:08 is behind its end: {goes}",
        ),
        (
            "undated.hex --from 10",
            "undated.hex: --from 10 is behind its end: it goes from 0.100 s to 8.000 s",
        ),
        (
            "undated.hex --to 2026-01-02T10:08:08",
            "undated.hex: it does not say when it began: give seconds since then",
        ),
        ("line.bin --to 9", "line.bin: it holds no times, so it has no part to 9"),
        ("empty.hex --to 9", "empty.hex: it holds no event, so it has no part to 9"),
        ("line.hex --ids 6-1", "argument --ids: 6-1 has its higher number first"),
        ("line.hex --ids 1,x", "argument --ids: 'x' is neither a number nor a range like 1-6"),
        ("line.hex --ids 1-65536", "argument --ids: 1-65536 is outside 0..65535"),
    ]
    for words, expected in rows:
        assert main(["stats", *words.split()]) == 2
        output, errors = capsys.readouterr()
        assert (output, errors.splitlines()[0]) == ("", f"busservo: error: {expected}"), words


@pytest.mark.parametrize("word", ["", "s", "-1", "1s2", "1m1h", "2026-02-31T10:00", "9:00", "x"])
def test_what_is_no_time_is_refused(word: str) -> None:
    with pytest.raises(ValueError, match="is no time: write it like 90, 1m30s or 1h, or like"):
        Moment(word)
