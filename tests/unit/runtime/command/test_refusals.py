"""What no verb can do: it is refused in visible words before a port is opened or a file written."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from busservo.__main__ import main

from tests.commands import called
from tests.in_turn import in_turn

POSES = '{"format": "busservo poses", "version": 1, "poses": [{"positions": {"1": 500}}]}'
NO_SECONDS = "is no number of seconds"
NO_NUMBER = "the capture holds no message with a number in it"
ENDS = "its name has to end with one of .svg, .png, .pdf"
# By how a command line begins: how it goes on, and what is said of it.
REFUSED: dict[str, list[tuple[str | list[str], str]]] = {
    "doctor --port no-such-port": [
        ("--move 254 --yes", "--move 254: servos have numbers from 1 to 253"),
        ("--move x", "argument --move: 'x' is no whole number"),
        ("--move 1", "--move asks first, and standard input is no terminal: use --yes"),
        ("--baud 0", "argument --baud: 0 is below 1"),
        ("--timeout -1", "argument --timeout: -1 is "),
        ("--report /no/such/folder/x", "/no/such/folder/x cannot be written: No such file"),
    ],
    "bench-line --port no-such-port": [
        ("ServoMove time_ms=1 targets=1:2", "nothing answers ServoMove, so it cannot be"),
        ("ActionGroupStarted", "ActionGroupStarted is never sent from here"),
        ("ServoPositionsRead", "ServoPositionsRead needs servo_ids"),
        (
            f"ServoPositionsRead servo_ids={','.join(map(str, range(85)))}",
            "servo_ids: 85 items are requested at once, and a reply has room for 84",
        ),
        ("-n 0", "argument -n: 0 is below 1"),
        ("--timeout 4000", "argument --timeout: 4000 is not above 0 and up to 3600 seconds"),
    ],
    "decode": [
        ("--file line.bin 55", "give either --file or bytes, not both"),
        ("--file absent.bin", "absent.bin cannot be read: No such file or directory"),
        ("absent.bin", "no hex: 's' in 'absent.bin' is no hex digit; write two"),
        ("absent.bin", "and there is no file 'absent.bin'"),
        (".", ". is a folder: name a file in it"),
        ("--file .", ". cannot be read: "),
        ([__file__, __file__], "these are 2 files: give one at a time"),
        (["55 5"], "no hex: '5' is half a byte; did you mean 05?"),
        (["a\0b"], "there is no file 'a\\x00b'"),
        (["x" * 5000], "no hex: 'x' in 'xxx"),
        ("55 zz", "no hex: 'z' in 'zz' is no hex digit"),
    ],
    "encode": [
        ("ServoMove 1000", "'1000' is no field: write it as NAME=VALUE"),
        ("ServoMove tme=1", "ServoMove has no field 'tme'; it is written ServoMove time_ms="),
        ("ServoMove time_ms=1 time_ms=2", "time_ms is given twice"),
        ("ServoMove time_ms=1 targets=1", "targets[0]: '1' is not servo_id:position"),
        ("ServoMove time_ms=soon targets=1:2", "time_ms: 'soon' is no number: write it"),
        ("ServoMove time_ms=1_0 targets=1:2", "time_ms: '1_0' is no number: write it"),
        ("ServoMove time_ms=010 targets=1:2", "time_ms: '010' is no number: write it"),
        ("ServoMove time_ms=٣ targets=1:2", "time_ms: '٣' is no number: write it"),
        (["ServoMove", "time_ms=" + "9" * 5000, "targets=1:2"], "is no number: write it"),
        ("ServoMove time_ms=70000 targets=1:2", "70000 is outside 0..65535"),
        ("ServoMove time_ms=1 targets=", "targets: "),
        ("ServoUnload servo_ids=1,x", "servo_ids[1]: 'x' is no number"),
        ("ServoUnload", "ServoUnload needs servo_ids"),
        ("Zzz", "there is no message 'Zzz'; there are "),
    ],
    "explain": [
        ("5", "no hex: '5' is half a byte; did you mean 05?"),
        ([""], "there are no bytes to explain: give them in hex"),
        ("55 --direction nobody", "invalid choice: 'nobody'"),
    ],
    "monitor --port loop://": [
        ("-n 0", "argument -n: 0 is below 1, the least there can be"),
        ("-n some", "argument -n: 'some' is no whole number"),
        ("--only Batery", "there is no message 'Batery'; did you mean"),
        ("--hide nois", "besides messages, there are host, controller, either, noise, unknown"),
        ("-t sidereal", "argument -t: invalid choice: 'sidereal'"),
        ("--direction both", "argument --direction: invalid choice: 'both'"),
        ("--log no/such/folder", "folder cannot be written: No such file"),
    ],
    "send ActionGroupStop": [
        ("--port no-such-port", "there is no such port"),
        ("--port gopher://x", "that begins with gopher://"),
    ],
    "send --port loop://": [
        ("ActionGroupStopped", "is never sent from here"),
        ("ServoMov", "did you mean ServoMove?"),
        ("ServoMove time_ms=1", "ServoMove needs targets"),
        (f"ServoPositionsRead servo_ids={100 * '1,'}300", "servo_ids[100]: 300 is outside 0..255"),
    ],
    "send --port loop:// BatteryVoltageRead": [
        ("--retries -1", "argument --retries: -1 is below 0, the least there can be"),
        ("--timeout 0", "argument --timeout: 0 is not above 0 and up to 3600 seconds"),
        ("--timeout inf", "argument --timeout: inf is not above 0 and up to 3600 seconds"),
        ("--timeout nan", f"argument --timeout: 'nan' {NO_SECONDS}: write it like 12 or 0.5"),
        ("--timeout soon", f"argument --timeout: 'soon' {NO_SECONDS}"),
        ("--timeout 1_0", f"argument --timeout: '1_0' {NO_SECONDS}"),
        ("--retries ٣", "argument --retries: '٣' is no whole number"),
        ("--baud 0", "argument --baud: 0 is below 1"),
        (["--baud", str(2**31)], "baud is 2147483648, and must be from 1 to 2147483647"),
    ],
    "stats": [
        ("--plot line.gif", f"line.gif cannot be drawn: {ENDS}"),
        ("--plot absent/line.svg", "absent/line.svg cannot be written: there is no folder"),
        ("--baud 0", "argument --baud: 0 is below 1, the least there can be"),
        ("--file absent.bin", "absent.bin cannot be read: No such file or directory"),
        ("55 --plot line.svg", f"line.svg is not drawn: {NO_NUMBER}"),
    ],
    "teach . --port loop://": [
        ("--ids 1-", "'1-' is neither a number nor a range like 1-6"),
        ("--ids \u0661", "is neither a number nor a range like 1-6"),
        ("--ids 3-1", "3-1 has its higher number first"),
        ("--ids 256", "256 is outside 0..255"),
        ("--append --force", "not allowed with"),
        ("", "is not a regular file, as poses need one: name another"),
        ("--force", "is not a regular file, as poses need one: name another"),
    ],
    "play good.json": [
        ("--dry-run --repeat 0", "0 is below 1"),
        ("--dry-run --time-ms 70000", "70000 is outside 0..65535 milliseconds"),
        ("--dry-run --time-ms soon", "'soon' is no whole number"),
        ("--dry-run --pause nan", "'nan' is no number of seconds: write it like"),
        ("--dry-run --pause 3601", "3601 is not in 0..3600 seconds"),
        ("--dry-run --pause 1_0", "'1_0' is no number of seconds"),
        ("--dry-run --limits 9..1", "'9..1' is no LOW..HIGH: write it like 0..1000, or no"),
        ("--dry-run --limits 500", "'500' is no LOW..HIGH"),
        ("--dry-run --limits 1_0..2_0", "is no LOW..HIGH"),
    ],
}
# Whose errors have a line and no more.
SHORT = {"decode", "encode"}


def refused() -> Iterator[tuple[list[str], str]]:
    """Yield each command line, and what is said of it."""
    for begun, rows in REFUSED.items():
        for words, expected in rows:
            yield [*begun.split(), *(words.split() if isinstance(words, str) else words)], expected


@in_turn("words, expected", refused)
def test_what_cannot_be_done_is_refused_in_a_line(
    words: list[str], expected: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "good.json").write_text(POSES)
    # Nobody who is asked answers yes: it is no terminal.
    status, output, errors = called(main, *words, given="y\n")
    assert status == 2
    assert output == "" or words[:2] == ["stats", "55"]
    assert errors.startswith("busservo: error: ")
    assert expected in errors.splitlines()[0]
    assert "Traceback" not in errors
    assert errors.count("\n") == 1 or words[0] not in SHORT
    assert [each.name for each in tmp_path.iterdir()] == ["good.json"]
