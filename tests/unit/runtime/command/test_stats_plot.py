"""The drawings of `stats`: their lines, the points of these, and what is said of them."""

from __future__ import annotations

import re
from itertools import pairwise
from typing import TYPE_CHECKING
from xml.etree import ElementTree as ET

import lxservo
import lxservo.__main__
import numpy as np
import pytest
from busservo import BatteryVoltage, ServoMove, ServoPosition, ServoPositions, ServoTarget
from busservo.__main__ import main
from busservo._library import CODEC
from framewire.recording.layout import layouts_of
from framewire.tables.stats import panels, traces
from framewire.tables.stats.quantities import quantities
from framewire.tables.stats.trace import Trace

from tests.in_turn import in_turn
from tests.rows import Rows

if TYPE_CHECKING:
    from pathlib import Path

    from busservo import Message

Capture = pytest.CaptureFixture[str]

ABSENT = 65535

SVG = "{http://www.w3.org/2000/svg}"


def drawn(file: Path) -> tuple[list[str], dict[str, list[tuple[float, float]]]]:
    """Return the texts of a drawing, and the points of its lines by their names."""
    root = ET.fromstring(file.read_text())  # noqa: S314 - our own
    texts = ["".join(each.itertext()) for each in root.iter(f"{SVG}text")]
    lines: dict[str, list[tuple[float, float]]] = {}
    for group in root.iter(f"{SVG}g"):
        path = group.find(f"{SVG}path")
        if "." in group.get("id", "") and path is not None:
            numbers = [float(each) for each in re.findall(r"-?[\d.]+", path.get("d", ""))]
            pairs = [*zip(numbers[::2], numbers[1::2], strict=True)]
            lines[group.attrib["id"]] = pairs
    return texts, lines


def positions(tmp_path: Path, count: int = 40) -> Path:
    file = tmp_path / "line.hex"
    lines = []

    def line(message: Message, at: float) -> str:
        return f"{message.encode().hex(' ')}  # {at:.6f} s, controller: {message}\n"

    for number in range(count):
        second = ABSENT if number == count // 2 else 400
        read = ServoPositions([ServoPosition(1, 500 + number), ServoPosition(2, second)])
        lines.append(line(read, number / 4))
        if number % 10 == 0:
            lines.append(line(BatteryVoltage(7400 - number), number / 4 + 0.05))
    file.write_text("".join(lines))
    return file


def test_positions_and_the_battery_are_drawn(capsys: Capture, tmp_path: Path) -> None:
    picture = tmp_path / "line.svg"
    assert main(["stats", str(positions(tmp_path)), "--plot", str(picture)]) == 0
    texts, lines = drawn(picture)
    assert [*lines] == [
        "ServoPositions.positions.position.1",
        "ServoPositions.positions.position.2",
        "BatteryVoltage.voltage_mv.0",
    ]
    first, second, battery = lines.values()
    assert (len(first), len(second), len(battery)) == (40, 39, 4)
    across = [x for x, _ in first]
    steps = {round(after - before, 3) for before, after in pairwise(across)}
    assert max(steps) - min(steps) < 0.01
    # Upwards is less in SVG; what is absent is no point, as it would be far above.
    assert [y for _, y in first] == sorted((y for _, y in first), reverse=True)
    assert len({y for _, y in second}) == 1
    assert [y for _, y in battery] == sorted(y for _, y in battery)
    for text in ("Position", "Voltage", "V", "servo_id 1", "servo_id 2"):
        assert text in texts
    assert "time since the recording began (s)" in texts
    assert "line.hex: Hiwonder bus servo controller" in texts


def test_only_an_excerpt_is_drawn(capsys: Capture, tmp_path: Path) -> None:
    picture = tmp_path / "line.svg"
    words = ["--from", "2s", "--to", "4", "--ids", "1", "--plot", str(picture)]
    assert main(["stats", str(positions(tmp_path)), *words]) == 0
    texts, lines = drawn(picture)
    # Both ends are included: a reading each 0.25 s.
    assert {name: len(points) for name, points in lines.items()} == {
        "ServoPositions.positions.position.1": 9,
        "BatteryVoltage.voltage_mv.0": 1,
    }
    assert "line.hex from 2s to 4: Hiwonder bus servo controller" in texts
    assert {"2.00", "4.00"} <= {*texts}


def test_readings_between_absent_ones_are_seen(capsys: Capture, tmp_path: Path) -> None:
    file, lines = tmp_path / "line.hex", []
    for number in range(140):
        second = 400 if number % 2 else ABSENT
        read = ServoPositions([ServoPosition(1, 500 + number), ServoPosition(2, second)])
        lines.append(f"{read.encode().hex(' ')}  # {number / 4:.6f} s, controller: {read}\n")
    file.write_text("".join(lines))
    assert main(["stats", str(file), "--plot", str(tmp_path / "line.svg")]) == 0
    capsys.readouterr()
    root = ET.fromstring((tmp_path / "line.svg").read_text())  # noqa: S314 - our own
    points = {
        group.attrib["id"]: len([*group.iter(f"{SVG}use")])
        for group in root.iter(f"{SVG}g")
        if group.get("id", "").startswith("ServoPositions.")
    }
    name = "ServoPositions.positions.position"
    # A line shows the first servo, and nothing but points the second.
    assert points == {f"{name}.1": 0, f"{name}.2": 70}


@pytest.mark.parametrize(("count", "is_dense"), [(2_000, False), (40_000, True)])
def test_dense_readings_have_a_band_around_their_mean(count: int, is_dense: bool) -> None:
    trace = Trace()
    values = np.where(np.arange(count) % 4 == 0, 900.0, 100.0)
    values[count // 2] = np.nan
    trace.add(np.arange(count) / 10, values)
    assert trace.is_dense == is_dense
    at, low, mean, high = trace.band()
    torn = np.isnan(mean)
    assert torn.sum() == 1
    assert (np.diff(at) >= 0).all()
    assert (low[~torn] <= mean[~torn]).all()
    assert (mean[~torn] <= high[~torn]).all()
    assert (float(np.nanmin(low)), float(np.nanmax(high))) == (100.0, 900.0)
    if is_dense:
        # A bucket of 40 values may hold one high value more or less than its quarter, and a gap.
        assert abs(mean[~torn] - 300).max() < 2 * 800 / 40


def test_equal_readings_are_a_band_without_height() -> None:
    trace = Trace()
    trace.add(np.arange(50_000) / 10, np.full(50_000, 0.1))
    _, low, mean, high = trace.band()
    assert {*low, *mean, *high} == {0.1}


def test_the_same_capture_gives_the_same_drawing(capsys: Capture, tmp_path: Path) -> None:
    file, pictures = positions(tmp_path), [tmp_path / "a.svg", tmp_path / "b.svg"]
    for picture in pictures:
        assert main(["stats", str(file), "--plot", str(picture)]) == 0
    first, second = (picture.read_bytes() for picture in pictures)
    assert first == second
    assert b"<dc:date>" not in first
    assert {each.name for each in tmp_path.iterdir()} == {"a.svg", "b.svg", "line.hex"}


@pytest.mark.parametrize(
    ("suffix", "begins"), Rows([(".PNG", b"\x89PNG")], others=[(".pdf", b"%PDF")])
)
def test_other_forms_of_pictures(tmp_path: Path, suffix: str, begins: bytes) -> None:
    file, pictures = positions(tmp_path, 3), [tmp_path / f"{name}{suffix}" for name in "ab"]
    for picture in pictures:
        assert main(["stats", str(file), "--plot", str(picture)]) == 0
    first, second = (picture.read_bytes() for picture in pictures)
    assert first.startswith(begins)
    assert first == second


def test_without_times_it_is_drawn_over_the_time_on_the_wire(
    capsys: Capture, tmp_path: Path
) -> None:
    file, picture = tmp_path / "line.bin", tmp_path / "line.svg"
    file.write_bytes(b"".join(BatteryVoltage(7000 + each).encode() for each in range(30)))
    assert main(["stats", str(file), "--plot", str(picture), "--baud", "19200"]) == 0
    texts, lines = drawn(picture)
    assert "time on the wire at 19200 baud (s); the capture holds no times" in texts
    assert len(lines["BatteryVoltage.voltage_mv.0"]) == 30


def test_what_was_commanded_is_drawn_where_nothing_was_measured(
    capsys: Capture, tmp_path: Path
) -> None:
    file, picture = tmp_path / "line.bin", tmp_path / "line.svg"
    file.write_bytes(ServoMove(800, [ServoTarget(1, 500), ServoTarget(7, 600)]).encode() * 3)
    assert main(["stats", str(file), "--plot", str(picture)]) == 0
    _, lines = drawn(picture)
    assert [*lines] == [
        "ServoMove.targets.position.1",
        "ServoMove.targets.position.7",
        "ServoMove.time_ms.0",
    ]


def test_a_bus_has_a_line_for_each_address(capsys: Capture, tmp_path: Path) -> None:
    file, picture = tmp_path / "line.bin", tmp_path / "line.svg"
    read = [
        lxservo.Move(servo_id=1, position=200, time_ms=100),
        lxservo.Position(servo_id=1, position=-5),
        lxservo.Position(servo_id=1, position=1004),
        lxservo.Position(servo_id=9, position=77),
        lxservo.Voltage(servo_id=9, voltage_mv=6900),
    ]
    file.write_bytes(b"".join(each.encode() for each in read))
    assert lxservo.__main__.main(["stats", str(file), "--plot", str(picture)]) == 0
    texts, lines = drawn(picture)
    assert [*lines] == ["Position.position.1", "Position.position.9", "Voltage.voltage_mv.9"]
    assert "°" in texts


def many(tmp_path: Path, count: int) -> Path:
    """Write a recording of many servos, each of which stands at its own number."""
    file = tmp_path / "many.hex"
    read = ServoPositions([ServoPosition(each, each) for each in range(1, count + 1)])
    data = read.encode().hex(" ")
    file.write_text("".join(f"{data}  # {at} s, controller: positions\n" for at in (3.0, 4.0)))
    return file


def test_each_servo_has_a_panel_and_all_share_the_axes(
    capsys: Capture, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(panels, "PANELS", 9)
    name = "ServoPositions.positions.position"
    more = f"not drawn, as there is no room: {name} of 12 more servo_id (--ids chooses)\n"
    # How many servos there are, the words, those that are drawn, and the panels in the first row.
    rows: list[tuple[int, list[str], list[int], int]] = [
        (1, [], [1], 1),
        (6, ["--ids", "5,2-3"], [2, 3, 5], 1),
        (9, [], [*range(1, 10)], 2),
        (21, [], [*range(1, 10)], 4),
    ]
    for count, words, servos, across in rows:
        picture = tmp_path / "many.svg"
        assert main(["stats", str(many(tmp_path, count)), "--plot", str(picture), *words]) == 0
        texts, lines = drawn(picture)
        assert [*lines] == [f"{name}.{each}" for each in servos]
        assert [text for text in texts if text.startswith("servo_id")] == [
            f"servo_id {each}" for each in servos
        ]
        begins = [points[0][0] for points in lines.values()]
        assert len({*begins}) == across
        assert begins == [begins[at % across] for at in range(len(servos))]
        lengths = {round(points[-1][0] - points[0][0], 3) for points in lines.values()}
        assert len(lengths) == 1
        assert capsys.readouterr().err == (more if count == 21 else "")


@in_turn("count, columns, rows", lambda: [(8, 1, 8), (20, 2, 10), (32, 4, 8), (70, 4, 16)])
def test_panels_stand_in_as_many_columns_as_there_is_room_for(
    count: int, columns: int, rows: int
) -> None:
    layouts = layouts_of(CODEC).every
    (quantity,) = (
        each for of in layouts if of.kind is ServoPositions for each in quantities(of) if each.key
    )
    page, left_out = panels.page_of([(quantity, {each: Trace() for each in range(count)})])
    assert (page.columns, [block.rows for block in page.blocks]) == (columns, [rows])
    name = "ServoPositions.positions.position"
    assert left_out == ([f"{name} of 6 more servo_id (--ids chooses)"] if count == 70 else [])


def test_more_panels_than_there_is_room_for_are_named(
    capsys: Capture, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    name = "ServoPositions.positions.position"
    battery = "BatteryVoltage.voltage_mv"
    more = f"{name} of 1 more servo_id (--ids chooses)"
    rows = [
        (panels, "QUANTITIES", 1, battery),
        (panels, "PANELS", 2, battery),
        (panels, "PANELS", 1, f"{more}, {battery}"),
        (traces, "_MOST_LINES", 1, more),
    ]
    for module, limit, value, expected in rows:
        with monkeypatch.context() as patch:
            patch.setattr(module, limit, value)
            assert main(["stats", str(positions(tmp_path)), "--plot", str(tmp_path / "a.svg")]) == 0
        assert capsys.readouterr().err == f"not drawn, as there is no room: {expected}\n"
