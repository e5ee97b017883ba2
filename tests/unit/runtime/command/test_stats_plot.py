"""The drawings of `stats`: their lines, the points of these, and what is said of them."""

import re
from collections.abc import Iterable
from itertools import pairwise
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

import numpy as np
import pytest
from busservo import BatteryVoltage, Message, ServoPositions
from busservo._library import CODEC
from framewire.recording.layout import layouts_of
from framewire.tables.stats import panels, traces
from framewire.tables.stats.quantities import quantities
from framewire.tables.stats.trace import Trace

from tests.commands import run
from tests.in_turn import in_turn
from tests.rows import Rows

ABSENT = 65535
SVG = "{http://www.w3.org/2000/svg}"
NAME = "ServoPositions.positions.position"
NO_ROOM = "not drawn, as there is no room: "


@pytest.fixture
def picture(tmp_path: Path) -> Path:
    return tmp_path / "line.svg"


def groups(picture: Path) -> dict[str, ET.Element]:
    """Return what a drawing has of each line, by its name."""
    root = ET.fromstring(picture.read_text())  # noqa: S314 - our own
    found = {each.get("id", ""): each for each in root.iter(f"{SVG}g")}
    return {name: each for name, each in found.items() if re.match(r"[A-Z].*\.", name)}


def drawn(
    capture: Path, picture: Path, *words: object, said: str = "", **how: Any
) -> tuple[list[str], dict[str, list[tuple[float, float]]]]:
    """Draw a capture; return the texts, and the points of the lines by their names."""
    status, _, errors = run("stats", capture, "--plot", picture, *words, **how)
    assert (status, errors) == (0, said)
    root = ET.fromstring(picture.read_text())  # noqa: S314 - our own
    texts = ["".join(each.itertext()) for each in root.iter(f"{SVG}text")]
    lines: dict[str, list[tuple[float, float]]] = {}
    for name, group in groups(picture).items():
        if (path := group.find(f"{SVG}path")) is not None:
            numbers = [float(each) for each in re.findall(r"-?[\d.]+", path.get("d", ""))]
            lines[name] = [*zip(numbers[::2], numbers[1::2], strict=True)]
    return texts, lines


def recorded(file: Path, said: Iterable[tuple[Message, float]]) -> Path:
    """Write a recording of what a board says at some times."""
    lines = (f"{each.encode().hex(' ')}  # {at:.6f} s, controller: {each}\n" for each, at in said)
    file.write_text("".join(lines))
    return file


def positions(folder: Path, count: int = 40) -> Path:
    """Write a recording of two servos, of which one is absent once, and of the battery."""
    said: list[tuple[Message, float]] = []
    for number in range(count):
        second = ABSENT if number == count // 2 else 400
        said.append((ServoPositions([(1, 500 + number), (2, second)]), number / 4))
        if number % 10 == 0:
            said.append((BatteryVoltage(7400 - number), number / 4 + 0.05))
    return recorded(folder / "line.hex", said)


def test_positions_and_the_battery_are_drawn(tmp_path: Path, picture: Path) -> None:
    texts, lines = drawn(positions(tmp_path), picture)
    assert [*lines] == [f"{NAME}.1", f"{NAME}.2", "BatteryVoltage.voltage_mv.0"]
    first, second, battery = lines.values()
    assert (len(first), len(second), len(battery)) == (40, 39, 4)
    steps = {round(after - before, 3) for (before, _), (after, _) in pairwise(first)}
    assert max(steps) - min(steps) < 0.01
    # Upwards is less in SVG; what is absent is no point, as it would be far above.
    assert [y for _, y in first] == sorted((y for _, y in first), reverse=True)
    assert len({y for _, y in second}) == 1
    assert [y for _, y in battery] == sorted(y for _, y in battery)
    for text in (
        *("Position", "Voltage", "V", "servo_id 1", "servo_id 2"),
        *("time since the recording began (s)", "line.hex: Hiwonder bus servo controller"),
    ):
        assert text in texts


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


@pytest.mark.parametrize(
    ("suffix", "begins"),
    Rows([(".svg", b"<?xml"), (".PNG", b"\x89PNG")], others=[(".pdf", b"%PDF")]),
)
def test_the_same_capture_is_the_same_drawing(tmp_path: Path, suffix: str, begins: bytes) -> None:
    file, pictures = positions(tmp_path, 3), [tmp_path / f"{name}{suffix}" for name in "ab"]
    for picture in pictures:
        assert run("stats", file, "--plot", picture).status == 0
    first, second = (picture.read_bytes() for picture in pictures)
    assert first.startswith(begins)
    assert first == second
    assert b"<dc:date>" not in first
    assert {*tmp_path.iterdir()} == {file, *pictures}


def test_without_times_it_is_drawn_over_the_time_on_the_wire(tmp_path: Path, picture: Path) -> None:
    file = tmp_path / "line.bin"
    file.write_bytes(b"".join(BatteryVoltage(7000 + each).encode() for each in range(30)))
    texts, lines = drawn(file, picture, "--baud", "19200")
    assert "time on the wire at 19200 baud (s); the capture holds no times" in texts
    assert len(lines["BatteryVoltage.voltage_mv.0"]) == 30


# How many servos there are, the words, those that are drawn, and the panels in the first row.
@in_turn(
    "count, words, servos, across",
    lambda: [
        (1, [], [1], 1),
        (6, ["--ids", "5,2-3"], [2, 3, 5], 1),
        (9, [], [*range(1, 10)], 2),
        (21, [], [*range(1, 10)], 4),
    ],
)
def test_each_servo_has_a_panel_and_all_share_the_axes(
    count: int,
    words: list[str],
    servos: list[int],
    across: int,
    tmp_path: Path,
    picture: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(panels, "PANELS", 9)
    # Each of them stands at its own number.
    read = ServoPositions([(each, each) for each in range(1, count + 1)])
    file = recorded(tmp_path / "many.hex", [(read, 3.0), (read, 4.0)])
    said = f"{NO_ROOM}{NAME} of 12 more servo_id (--ids chooses)\n" if count == 21 else ""
    texts, lines = drawn(file, picture, *words, said=said)
    assert [*lines] == [f"{NAME}.{each}" for each in servos]
    named = [text for text in texts if text.startswith("servo_id")]
    assert named == [f"servo_id {each}" for each in servos]
    begins = [points[0][0] for points in lines.values()]
    assert len({*begins}) == across
    assert begins == [begins[at % across] for at in range(len(servos))]
    assert len({round(points[-1][0] - points[0][0], 3) for points in lines.values()}) == 1


@in_turn("count, columns, rows", lambda: [(8, 1, 8), (20, 2, 10), (32, 4, 8), (70, 4, 16)])
def test_panels_stand_in_as_many_columns_as_have_room(count: int, columns: int, rows: int) -> None:
    (layout,) = (each for each in layouts_of(CODEC).every if each.kind is ServoPositions)
    (quantity,) = (each for each in quantities(layout) if each.key)
    page, left_out = panels.page_of([(quantity, {each: Trace() for each in range(count)})])
    assert (page.columns, [block.rows for block in page.blocks]) == (columns, [rows])
    assert left_out == ([f"{NAME} of 6 more servo_id (--ids chooses)"] if count == 70 else [])


BATTERY = "BatteryVoltage.voltage_mv"
MORE = f"{NAME} of 1 more servo_id (--ids chooses)"


@in_turn(
    "module, limit, value, expected",
    lambda: [
        (panels, "QUANTITIES", 1, BATTERY),
        (panels, "PANELS", 2, BATTERY),
        (panels, "PANELS", 1, f"{MORE}, {BATTERY}"),
        (traces, "_MOST_LINES", 1, MORE),
    ],
)
def test_more_panels_than_there_is_room_for_are_named(
    module: Any, limit: str, value: int, expected: str, tmp_path: Path, picture: Path
) -> None:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(module, limit, value)
        drawn(positions(tmp_path), picture, said=f"{NO_ROOM}{expected}\n")
