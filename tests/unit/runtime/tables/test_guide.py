"""What the guide to tables prints is what `busservo decode` says of the same captures."""

from __future__ import annotations

import ast
import contextlib
import io
import json
import re
from collections import Counter
from typing import TYPE_CHECKING, Any

import pytest
from busservo.__main__ import main

from tests.documents import ROOT, copy_project, played

if TYPE_CHECKING:
    from pathlib import Path

GUIDE = (ROOT / "docs" / "captures.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"^```(\w+)[ \w]*\n(.*?)^```$", GUIDE, re.MULTILINE | re.DOTALL)


def printed(program: str) -> str:
    """Return what the guide says that the program with these words prints."""
    (at,) = [number for number, (_, text) in enumerate(BLOCKS) if program in text]
    kind, text = BLOCKS[at + 1]
    assert kind == "output"
    return str(text)


def decoded(capture: Path, *words: str) -> list[dict[str, Any]]:
    """Return the events of a capture, as the command prints them."""
    output = io.StringIO()
    with contextlib.redirect_stdout(output), contextlib.redirect_stderr(io.StringIO()):
        assert main(["decode", str(capture), "--json", *words]) == 0
    return [json.loads(line) for line in output.getvalue().splitlines()]


@pytest.fixture(scope="module")
def arm(tmp_path_factory: pytest.TempPathFactory) -> list[dict[str, Any]]:
    """Return the events of the capture that the guide begins with."""
    folder = tmp_path_factory.mktemp("guide")
    (recorded,) = [text for kind, text in BLOCKS if kind == "python" and "# arm.py" in text]
    page = f"```python\n{recorded}```\n"
    played(page, copy_project(folder, page))
    return decoded(folder / "arm.hex")


def positions(events: list[dict[str, Any]]) -> dict[int, list[int]]:
    """Return the positions of each servo."""
    found: dict[int, list[int]] = {}
    for event in events:
        if event.get("message") == "ServoPositions":
            for each in event["fields"]["positions"]:
                found.setdefault(each["servo_id"], []).append(each["position"])
    return found


def test_pandas_counts_what_decode_prints(arm: list[dict[str, Any]]) -> None:
    head, *lines = [line.split() for line in printed("import pandas as pd").splitlines()]
    shown = {name: [*map(int, numbers)] for name, *numbers in lines}
    servos = positions(arm)
    assert [*map(int, head[1:])] == sorted(servos)
    every = [numbers for _, numbers in sorted(servos.items())]
    assert shown == {
        "count": [len(numbers) for numbers in every],
        "min": [min(numbers) for numbers in every],
        "max": [max(numbers) for numbers in every],
    }


@pytest.mark.parametrize("program", ['replies.explode("positions").unnest', "FROM rows GROUP BY"])
def test_the_other_libraries_count_the_same(program: str, arm: list[dict[str, Any]]) -> None:
    shown = ast.literal_eval(printed(program))
    expected = [(name, len(found), max(found)) for name, found in sorted(positions(arm).items())]
    assert shown == expected


def test_the_tables_have_as_many_rows_as_there_are_messages(arm: list[dict[str, Any]]) -> None:
    (shown,) = re.findall(r"^Tables\((.*)\)$", GUIDE, re.MULTILINE)
    counts = Counter(event["message"] for event in arm)
    rows = dict(each.split(": ") for each in shown.split(", "))
    assert {name: int(number) for name, number in rows.items()} == counts


def test_noise_adds_up_to_what_decode_calls_noise() -> None:
    reasons, head, *unknown = printed('noise["unknown"]').splitlines()
    sizes: dict[str, int] = {}
    frames = []
    for event in decoded(ROOT / "tests" / "captures" / "noisy_line.bin", "--direction", "any"):
        if "reason" in event:
            size = len(bytes.fromhex(event["noise"]))
            sizes[event["reason"]] = sizes.get(event["reason"], 0) + size
            if "command" in event:
                frames.append([event["offset"], size, event["command"]])
    assert ast.literal_eval(reasons) == sizes
    assert head.split() == ["offset", "size", "command"]
    assert [[int(float(word)) for word in line.split()] for line in unknown] == frames


def test_the_parts_of_an_archive_have_the_messages_of_its_captures(tmp_path: Path) -> None:
    (made,) = [text for kind, text in BLOCKS if kind == "python" and "folder.mkdir()" in text]
    page = f"```python\n{made}```\n"
    played(page, copy_project(tmp_path, page))
    rows: dict[str, Counter[str]] = {}
    for line in printed('tables.archive(piece, "dataset")').splitlines():
        piece, _, said = line.partition(" ")
        if said != "is broken":
            rows.setdefault(piece.partition("[")[0], Counter()).update(ast.literal_eval(said))
    assert rows == {
        capture.name: Counter(event["message"] for event in decoded(capture))
        for capture in sorted((tmp_path / "captures").glob("*.bin"))
    }
