"""`framegen audit` from a shell: what it takes, how it ends, and what it prints."""

import io
import json
import sys
from pathlib import Path

import pytest
from framegen.audit.recording import read_recording
from framegen.cli import main
from framewire.recording.form import FORMS

from tests.factories import BUSSERVO, compiled_file
from tests.in_turn import in_turn
from tests.lines.tallied_line import audited

GOOD = "55 55 04 0F 4C 1D"
BAD = f"{GOOD} 55 55 03 2A 07"
Capture = pytest.CaptureFixture[str]


@pytest.fixture
def good(tmp_path: Path) -> Path:
    file = tmp_path / "line.hex"
    file.write_text(GOOD)
    return file


CONTENTS: list[tuple[bytes, list[str], int]] = [
    (GOOD.encode(), [], 0),
    (bytes.fromhex(GOOD), [], 0),
    (b"\xef\xbb\xbf" + GOOD.encode(), [], 0),
    (GOOD.replace(" ", ", 0x").encode(), [], 0),
    (f"{GOOD}  # 0.5 s, controller: a\r\n".encode(), [], 0),
    (f"# of an \xe9\n{GOOD}\n".encode("latin-1"), [], 0),
    (BAD.encode(), [], 1),
    (BAD.encode(), ["--tolerate", "100%"], 1),
    (f"00 {GOOD}".encode(), [], 1),
    (f"00 {GOOD}".encode(), ["--tolerate", "1"], 0),
    (f"00 {GOOD}".encode(), ["--tolerate", "14%"], 1),
    (f"00 {GOOD}".encode(), ["--tolerate", "15%"], 0),
    (GOOD.encode(), ["--direction", "controller"], 0),
    (GOOD.encode(), ["--direction", "host"], 1),
    (b"UU", ["--input", "raw"], 1),
]


@in_turn(
    "content, words, code, form",
    lambda: [
        *((*each, "json") for each in CONTENTS),
        *((*CONTENTS[at], form) for at in (0, 6, 9) for form in ("text", "markdown")),
    ],
)
def test_exit_code(
    tmp_path: Path, content: bytes, words: list[str], code: int, form: str, capsys: Capture
) -> None:
    file = tmp_path / "line"
    file.write_bytes(content)
    assert main(["audit", "busservo", str(file), "--format", form, *words]) == code
    printed = capsys.readouterr()
    assert printed.err == ""
    if form == "json":
        assert json.loads(printed.out)["fits"] is (code == 0)
    else:
        said = "all of it fits" if code == 0 else "not all of it fits"
        assert said in printed.out.lower()


UNUSABLE = [
    (b"", [], "holds no bytes of a line", "record the line"),
    (b"# recorded of 'x' from 2026\n# quiet\n", [], "holds no bytes of a line", "record"),
    (b"55 hello", [], "line 1: no hex: 'h' in 'hello'", "raw bytes need --input raw"),
    (b"55 55\n55 5\n", [], "line 2: no hex: '5' is half a byte", "raw bytes need --input raw"),
    (b"5 # 1 s, host: a\n", [], "line 1: no hex: '5' is half a byte", "--input raw"),
    (b"55 # 1 s, kiln: a\n", [], "line 1: 'kiln' is none of those who send", "host, controller"),
    (b"55 # 1 s, host: a\n55\n", [], "line 2: it has no time and sender", "--input raw"),
    (GOOD.encode(), ["--tolerate", "some"], "'some' is no amount of noise", "--tolerate 1%"),
    (GOOD.encode(), ["--tolerate", "101%"], "'101%' is no amount of noise", "--tolerate 1%"),
    (GOOD.encode(), ["--direction", "hosst"], "no endpoint 'hosst' sends", "did you mean `host`?"),
    (GOOD.encode(), ["--evidence"], "--evidence looks at no recording", "leave it out"),
]


@in_turn("content, words, problem, hint", lambda: UNUSABLE)
def test_what_is_of_no_use_is_refused_with_a_way_out(
    tmp_path: Path, content: bytes, words: list[str], problem: str, hint: str, capsys: Capture
) -> None:
    file = tmp_path / "line"
    file.write_bytes(content)
    assert main(["audit", "busservo", str(file), *words]) == 2
    printed = capsys.readouterr()
    assert printed.out == ""
    assert problem in printed.err
    assert hint in printed.err.split("hint: ")[1]


@pytest.mark.parametrize("words", [[], ["missing.bin"], ["spec"], ["-", "-"], ["a\0b"]])
def test_no_recording_at_all_is_an_error(words: list[str], capsys: Capture) -> None:
    assert main(["audit", "busservo", *words]) == 2
    assert capsys.readouterr().err.startswith("framegen: error: ")


def test_standard_input_is_one_recording_among_others(
    good: Path, monkeypatch: pytest.MonkeyPatch, capsys: Capture
) -> None:
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(bytes.fromhex(GOOD))))
    assert main(["audit", "busservo", "-", str(good), "--format", "json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert [each["bytes"] for each in found["recordings"]] == [6, 6]
    assert found["coverage"]["BatteryVoltage"]["seen"] == 2


def test_json_says_what_the_text_says(capsys: Capture) -> None:
    file = "tests/captures/noisy_line.bin"
    assert main(["audit", "busservo", file, "--format", "json"]) == 1
    found = json.loads(capsys.readouterr().out)
    assert (found["bytes"], found["messages"], found["either_end"]) == (764, 64, 17)
    kinds = [each["kind"] for each in found["misfits"]]
    assert kinds == sorted(kinds, key=["unknown command", "undocumented value", "noise"].index)
    assert found["noise"] == sum(x["bytes"] for x in found["misfits"] if x["kind"] == "noise")
    # As the sheet of the recording counts them: 130 bytes, 20 of them in two unknown frames.
    unknown = (each["bytes"] for each in found["misfits"] if each["kind"] == "unknown command")
    assert found["noise"] + sum(unknown) == 130
    assert main(["audit", "busservo", file]) == 1
    text = capsys.readouterr().out
    for name, each in found["coverage"].items():
        assert (f" {each['seen']}  {name} " in text) is (each["seen"] > 0)


def test_markdown_is_not_controlled_by_what_was_recorded(tmp_path: Path, capsys: Capture) -> None:
    text = f"# device: <b>|`x`\x07\n{GOOD}  # 1 s, controller: a\n".replace("\x07", "")
    file = tmp_path / "a|b<i>.hex"
    file.write_text(f"{text}55  # 2 s, noise: <script>| x\n")
    assert main(["audit", "busservo", str(file), "--format", "markdown"]) == 1
    printed = capsys.readouterr().out
    assert "<script>" not in printed.replace("\\<script\\>", "")
    rows = [line for line in printed.splitlines() if line.startswith("|")]
    cells = {len(row.replace("\\|", "").split("|")) for row in rows if "script" in row}
    assert cells == {7}


def test_a_report_names_its_board(tmp_path: Path, capsys: Capture) -> None:
    started = "55 55 05 06 08 01 00"
    for device, cite in (
        ("LSC-32, arm", "cite: hardware, report of LSC-32, arm\n"),
        ("an: odd #one", 'cite: "hardware, report of an: odd #one"\n'),
        ("not stated", "cite: hardware, report of NAME THE BOARD\n"),
    ):
        file = tmp_path / "report.hex"
        file.write_text(f"# device: {device}\n{started}  # 1 s, controller: a\n")
        assert main(["audit", "busservo", str(file)]) == 0
        assert cite in capsys.readouterr().out


@pytest.mark.parametrize("form", FORMS)
def test_every_form_of_a_file_holds_the_same(form: str) -> None:
    model = compiled_file(BUSSERVO).model
    contents = {"raw": bytes.fromhex(BAD), "hex": BAD.encode(), "auto": BAD.encode()}
    recording = read_recording("line", contents[form], [*model.spec.endpoints], model.roles, form)
    assert b"".join(each.data for each in recording.stretches) == bytes.fromhex(BAD)
    assert audited(model, contents[form]).size == recording.size


def test_the_evidence_of_a_spec_needs_no_recording(capsys: Capture) -> None:
    assert main(["audit", "busservo", "--evidence", "--format", "json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert sum(found["by_kind"].values()) == found["facts"]
    assert 0 < found["seen_on_hardware"] < found["facts"]
    assert main(["audit", "busservo", "--evidence"]) == 0
    assert f"{found['seen_on_hardware']} of {found['facts']} facts" in capsys.readouterr().out
