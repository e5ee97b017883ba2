"""The verbs without a port, `decode` and `encode`: where bytes come from, and what is refused."""

from __future__ import annotations

import io
import sys
from typing import TYPE_CHECKING

import pytest
from busservo import ServoUnload
from busservo.__main__ import main

if TYPE_CHECKING:
    from pathlib import Path

Capture = pytest.CaptureFixture[str]

STOP = "55 55 02 07"
SHOWN = f"     0  host        ActionGroupStop | {STOP}\n"


def test_the_bytes_may_be_words_or_a_file_or_standard_input(
    capsys: Capture, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    hexed, raw = tmp_path / "stop.log", tmp_path / "stop.bin"
    hexed.write_text(STOP)
    raw.write_bytes(bytes.fromhex(STOP))
    for words in (
        STOP.split(),
        [STOP],
        [str(hexed)],
        [str(raw)],
        ["--file", str(hexed)],
        ["--file", str(raw), "--format", "raw"],
        [],
        ["-"],
        ["--file", "-"],
    ):
        monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(raw.read_bytes())))
        assert main(["decode", "--direction", "host", *words]) == 0
        assert capsys.readouterr().out == SHOWN, words


def test_long_raw_input_is_read_in_pieces(capsys: Capture, tmp_path: Path) -> None:
    recording = tmp_path / "long.bin"
    frame = ServoUnload(range(200)).encode()
    recording.write_bytes(frame * 1000)
    assert main(["decode", str(recording)]) == 0
    output, errors = capsys.readouterr()
    assert output.count("ServoUnload servo_ids=0,1,2,") == 1000
    assert "1000 messages, 0 bytes of noise" in errors


def test_a_folder_is_refused_as_input(capsys: Capture, tmp_path: Path) -> None:
    assert main(["decode", "--file", str(tmp_path)]) == 2
    assert "cannot be read: " in capsys.readouterr().err


def test_a_frame_can_be_hex_or_the_bytes_themselves(
    capfdbinary: pytest.CaptureFixture[bytes],
) -> None:
    assert main(["encode", "action_group-stop"]) == 0
    assert capfdbinary.readouterr().out == f"{STOP}\n".encode()
    assert main(["encode", "--raw", "ActionGroupStop"]) == 0
    assert capfdbinary.readouterr().out == bytes.fromhex(STOP)


def test_numbers_may_have_any_base_and_values_their_names(capsys: Capture) -> None:
    assert main(["encode", "ServoMove", "time_ms=0x3E8", "targets=1:0b11,9:0o17"]) == 0
    assert capsys.readouterr().out == "55 55 0B 03 02 E8 03 01 03 00 09 0F 00\n"
    assert main(["encode", "ServoPositions", "positions=1:absent"]) == 0
    assert capsys.readouterr().out.endswith("01 FF FF\n")


def test_without_a_verb_the_verbs_are_listed(capsys: Capture) -> None:
    assert main([]) == 2
    output, errors = capsys.readouterr()
    assert output == ""
    assert "\nverbs:\n" in errors
    assert main(["dcode"]) == 2
    assert "there is no verb 'dcode'; there are " in capsys.readouterr().err
