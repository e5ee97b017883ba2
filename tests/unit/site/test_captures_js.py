"""Captures as people have them, read by the script of the workbench under node."""

import csv
import io
import json
import random
import re
from collections.abc import Sequence
from contextlib import suppress
from typing import Any

import pytest
from busservo import Reason, recordings
from busservo._library import CODEC
from busservo.recordings import Entry
from framegen.site.scripts.codec_scripts import codec_scripts
from framegen.site.scripts.protocol_data import protocol_data
from framewire.codec.event_bytes import bytes_of
from framewire.codec.hextext import HexError, read_hex
from framewire.command.entries import EntryLines
from framewire.recording.form import log_lines

from tests.hex_cases import HEX, LOGS, NO_LOGS, random_texts
from tests.in_turn import in_turn
from tests.unit.site.peers import noisy_lines
from tests.unit.site.reference import NODE, ROOT, reference
from tests.unit.site.scripts import run_script

pytestmark = pytest.mark.skipif(NODE is None, reason="node is not installed")

READERS = ["hex", "capture_place", "code_text", "line_text", "csv_text", "log_text", "capture_text"]
DATA = protocol_data(reference("busservo").model)
SAYS = """
const says = captureWords(asked.protocol, "controller_to_host");
const hex = (bytes) => [...bytes].map((byte) => byte.toString(16).padStart(2, "0")).join("");
"""
READ = f"""{SAYS}
const answers = asked.texts.map((text) => {{
  const pieces = [];
  try {{
    const seen = readCaptureText(text, says, (bytes, said) => pieces.push([hex(bytes), said]));
    return {{ name: seen.name, lines: seen.lines, pieces }};
  }} catch (error) {{
    if (!(error instanceof Unreadable)) throw error;
    const {{ found, line, column, at, size, message, hint }} = error;
    return {{ found, line, column, at, size, message, hint }};
  }}
}});
"""
# The events of a text as the workbench saves them, and the same of pieces cut anywhere.
SAVE = f"""{SAYS}
const codec = makeCodec(asked.protocol), written = makeExport(codec, asked.protocol);
const answers = asked.texts.map(([text, direction, form]) => {{
  const capture = makeCapture(codec, asked.protocol, direction);
  readCaptureText(text, says, capture.add);
  capture.end();
  const {{ head, line }} = written[form];
  const events = Array.from({{ length: capture.size }}, (_, i) => capture.event(i));
  return head + events.map((event) => `${{line(event)}}\\n`).join("");
}});
"""
SAVERS = [*READERS[1:], "columns", "capture", "notation", "event_words", "workbench_export"]

STOP = "55550207"
MONITORED = """
07:24:55.603930  noise       bad header: a frame begins 55 55 | 00 FF
07:24:55.614843  controller  BatteryVoltage voltage_mv=7321 mV | 55 55 04 0F 99 1C
07:24:55.615374  host        BatteryVoltageRead | 55 55 02 0F
07:24:56.322913  either      ActionGroupRun or ActionGroupStarted group=3 | 55 55 05 06 03 01 00
^C
19 bytes: 3 messages, 2 bytes of noise
"""
NEW_TABLE = """name,type,start_time,duration,data
"Async Serial","data",0.0001,8.6e-05,0x55
"Async Serial","data",0.0002,8.6e-05,0x55
"Async Serial","frame",0.0002,8.6e-05,
"Async Serial","data",0.0003,8.6e-05,0x02
"""
NOTES, TABLE = "annotations of a logic analyser", "a table of a logic analyser"
# A text, what it is read as, and all of its bytes.
FORMS = [
    ("55 55 02 07", "hex", STOP),
    ("55h 55h 02h 07h", "hex", STOP),
    ("55H,055h,2h,0FFh", "hex", "555502ff"),
    ("55 // stop\n55 /* over\nlines */ 02 07", "hex", STOP),
    ("{0x55, 0x55, 2, 7}", "a list in hex", STOP),
    ("const uint8_t stop[4] = {0x55, 0x55, 0x02u, 7}; // it", "a list in hex", STOP),
    ("{55, 55, 02, 0F}", "a list in hex", "5555020f"),
    ("[85, 85, 2, 7]", "a list of decimal numbers", STOP),
    ("(85, 85, 2, 7)", "a list of decimal numbers", STOP),
    ("stop = bytes([0x55, 85, 2, 7])  # 4 bytes", "a list in hex", STOP),
    ("[[85, 85], [2, 7]]", "a list of decimal numbers", STOP),
    (r"b'\x55U\x02\x07'", "a bytes literal", STOP),
    (r"""b"U'\x55\n" b'#'""", "a bytes literal", "5527550a23"),
    (r'"\x55\x55" "\2\7"', "a string with escapes", STOP),
    ("bytes.fromhex('55 55 02 07')", "hex in quotes", STOP),
    ('["5555", "02 07"]', "hex in quotes", STOP),
    (MONITORED, "lines of monitor or decode", "00ff5555040f991c5555020f55550506030100"),
    ("     0  host        ActionGroupStop | 55 55 02 07", "lines of monitor or decode", STOP),
    ("55 55 # 0.5 s, host: x\n02 07 # 1 s, either: y", "lines of a recording", STOP),
    ('{"offset": 0, "from": "host", "hex": "55 55 02 07"}', "lines of JSON", STOP),
    ("(1436509052.249713) vcan0 044#55550207", "lines of candump", STOP),
    ("  can0  123   [4]  55 55 02 07", "lines of candump", STOP),
    ("00000000  55 55 02 07   |UU..|\n00000004", "a hex dump", STOP),
    ("00000000: 5555 0207                 UU..", "a hex dump", STOP),
    ("00000000: 55550207    UU..", "a hex dump", STOP),
    ("000000f0: 5555 0207    UU..", "a hex dump", STOP),
    (f"00000000  {'00 ' * 15}00\n*\n00000030  55 02\n00000032", "a hex dump", 48 * "00" + "5502"),
    (f"00000000: {'5500 ' * 8} U.U.\n*\n00000020: 0207  ..", "a hex dump", 16 * "5500" + "0207"),
    ("\ufeff00000000  55 55 02 07", "a hex dump", STOP),
    ("unsigned char stop[] = {\n  0x55, 0x07\n};\nunsigned int len = 2;", "a list in hex", "5507"),
    ("TX: 55\nTX: 55\nTX: 02\nTX: 07", NOTES, STOP),
    ("RX: 55\nRX: Stop bit\nRX: 07", NOTES, "5507"),
    ("uart-1: 55\nuart-1: 55\nuart-1: 02\nuart-1: 07", NOTES, STOP),
    ("8-16 UART: RX: 55\n16-17 UART: Stop bit\n17-25 UART: RX: 07", NOTES, "5507"),
    ("Time [s],Value,Parity Error,Framing Error\n0.1,0x55,,\n0.2,0x07,,\n", TABLE, "5507"),
    ("Time [s],Value,Parity Error\r\n0.1,85,\r\n0.2,7,\r\n", f"{TABLE} in decimal", "5507"),
    ("Time [s],Value\n0.1,U (0x55)\n0.2,'7' (0x07)\n", TABLE, "5507"),
    ("\ufeffTime [s],Value\n0.1,0x55\n", TABLE, "55"),
    ("time;data\n0.1;55\n0.2;0F\n", TABLE, "550f"),
    (NEW_TABLE, TABLE, "555502"),
    ("\ufeff55 55 02 07\r\n", "hex", STOP),
    ("", "hex", ""),
]
# A text, the line and column of what is wrong with it, and what stands there.
REFUSED = [
    *(("5", 1, 1, "5"), ("55 555", 1, 4, "555"), ("55 55\n02 5G", 2, 5, "G")),
    *(("# a comment\n  0x", 2, 3, "0x"), ("hello (world)", 1, 1, "h"), ("[85, 85", 1, 1, "[")),
    *(("85, 85]", 1, 7, "]"), ("[85,\n 300]", 2, 2, "300"), ("[85, 1.5]", 1, 6, "1.5")),
    *(("{85};\nx = 2, 7;", 2, 5, "2"), ("*\n00000010  55\n00000011", 1, 1, "*")),
    *(("\ufeff55 55\n0G", 2, 2, "G"), ("{0x55, 010}", 1, 8, "010"), ("{0x55, size}", 1, 8, "size")),
    *(("bytes(4)", 1, 7, "4"), ("55 (stop)", 1, 1, "55"), ("AA BB (stop)", 1, 1, "AA")),
    *((r"b'\x55\q'", 1, 7, r"\q"), ("b'\u00e9'", 1, 3, "\u00e9")),
    *(("bytes.fromhex('55 5x')", 1, 20, "x"), ("b'\\x55", 1, 2, "'")),
    (f"{MONITORED}what is this", 8, 1, "what is this"),
    ("55 # 0.5 s, host: x\n02 07\n", 2, 1, "02 07"),
    *(("55 # 0.5 s, nobody: x\n", 1, 13, "nobody"), ("5 # 0.5 s, host: x\n", 1, 1, "5")),
    ("Time [s],Value\n0.1,0x55\n0.2,U\n", 3, 5, "U"),
    ("name,start_time,kind\na,0.1,b\n", 1, 1, "name,start_time,kind"),
    (NEW_TABLE.replace("0x02", "0x102"), 5, 38, "0x102"),
]


def answers_to(texts: Sequence[str]) -> Any:
    return run_script(READERS, READ, {"protocol": DATA, "texts": texts})


def said(answer: dict[str, Any]) -> tuple[str, str]:
    assert "pieces" in answer, answer
    return answer["name"], "".join(piece for piece, _ in answer["pieces"])


def test_every_form_is_recognised_and_read() -> None:
    texts = [text for text, _, _ in FORMS]
    read = [(text, *said(each)) for text, each in zip(texts, answers_to(texts), strict=True)]
    assert read == FORMS


def test_what_no_form_has_is_refused_at_its_place() -> None:
    answers = answers_to([text for text, *_ in REFUSED])
    for (text, line, column, found), answer in zip(REFUSED, answers, strict=True):
        assert "found" in answer, (text, answer)
        assert (answer["line"], answer["column"], answer["found"]) == (line, column, found), text
        assert text[answer["at"] :].startswith(found)
        assert answer["size"] == len(found)
        assert answer["hint"]


@in_turn("behind", lambda: ["", "00000011  55\n", "00000008  55\n", "fffffff0  55\n"])
def test_lines_that_a_hex_dump_leaves_out_are_never_lost(behind: str) -> None:
    (answer,) = answers_to([f"00000000  {'00 ' * 15}00\n*\n{behind}"])
    assert (answer["line"], answer["column"], answer["found"]) == (3, 1, "*")


def test_hex_is_read_as_the_library_reads_it() -> None:
    texts = [text for text, _ in HEX] + [text for text in random_texts(300) if is_hex(text)]
    assert len(texts) > 60
    for text, answer in zip(texts, answers_to(texts), strict=True):
        assert said(answer) == ("hex", read_hex(text).hex()), text


def test_logs_are_read_as_the_library_reads_them() -> None:
    ways = {"tx": "host_to_controller", "rx": "controller_to_host"}
    for (text, pieces), answer in zip(LOGS, answers_to([text for text, _ in LOGS]), strict=True):
        assert answer.get("name") == "a log of a line", (text, answer)
        found = [(piece, it.get("direction")) for piece, it in answer["pieces"]]
        assert found == [(data, ways.get(way)) for way, data in pieces], text
        log = log_lines(text)
        assert log is not None
        times = [time for line in text.split("\n") for _, time, _ in log.read(line)]
        assert [it["time"] for _, it in answer["pieces"]] == times, text
    texts = [text for text, *_ in NO_LOGS]
    for (text, line, _), answer in zip(NO_LOGS, answers_to(texts), strict=True):
        assert answer.get("line") == line, (text, answer)
        assert text[answer["at"] :].startswith(answer["found"]), text


def is_hex(text: str) -> bool:
    with suppress(HexError):
        read_hex(text)
        return True
    return False


def test_what_programs_print_is_read_back() -> None:
    chance = random.Random(8)  # noqa: S311 - the same bytes in every run
    texts, written = [], []
    for _ in range(40):
        data = chance.randbytes(chance.randrange(1, 40))
        numbers = [f"0x{byte:02x}" for byte in data]
        rows = "".join(f"{at}.5,0x{byte:02X},,\n" for at, byte in enumerate(data))
        texts += [
            repr(data),
            repr(list(data)),
            repr(tuple(data)) if len(data) > 1 else f"[{data[0]}]",
            f"x = bytes.fromhex({data.hex()!r})",
            f"uint8_t frame[{len(data)}] = {{ {', '.join(numbers)} }};",
            f"Time [s],Value,Parity Error,Framing Error\n{rows}",
            "".join(f"\\x{byte:02X}" for byte in data),
            " ".join(f"{byte:03X}h" for byte in data),
            data.hex("-"),
        ]
        written += [data.hex()] * 9
    assert [said(answer)[1] for answer in answers_to(texts)] == written


def entries_of(text: str) -> list[Entry]:
    return list(recordings.read(io.BytesIO(text.encode())))


def test_recordings_keep_their_directions_times_and_noise() -> None:
    text = (ROOT / "tests" / "captures" / "cut_off.hex").read_text("utf-8")
    (answer,) = answers_to([text])
    found = [(hex_, it["time"], it["direction"]) for hex_, it in answer["pieces"]]
    assert found == [
        (bytes_of(each.event).hex(), each.time, each.direction.value if each.direction else None)
        for each in entries_of(text)
    ]
    assert answer["lines"] == len(text.splitlines())


def printed(text: str, form: str) -> str:
    """Return what `decode` prints of a recording."""
    screen = io.StringIO()
    lines = EntryLines(screen, form, CODEC)
    for entry in entries_of(text):
        lines.show(entry)
    return screen.getvalue()


def joined(text: str, form: str) -> list[list[str]]:
    """Return each line as it is, but noise of one line and one reason in one piece."""
    found: list[list[str]] = []
    for line in text.splitlines():
        cells = noise_in(line, form)
        if cells and found and found[-1][:-1] == cells[:-1]:
            found[-1][-1] += f" {cells[-1]}"
        else:
            found.append(cells or [line])
    return found


def noise_in(line: str, form: str) -> list[str]:
    """Return the time, the sender, the reason and the bytes of noise; nothing for what is none."""
    if form == "json":
        said = json.loads(line)
        is_noise = "noise" in said and "parameters" not in said
        return [str(said.get(key)) for key in ("time", "from", "reason", "noise") if is_noise]
    _, time, sender, _, message, _, _, data, reason = next(csv.reader([line]))
    # A frame of an unknown command has the size that it says.
    frame = bytes.fromhex(data) if reason == "unknown command" else b""
    is_frame = len(frame) > 3 and frame[2] + 2 == len(frame)
    return [] if message or is_frame else [time, sender, reason, data]


def noisy_recording(seed: int) -> str:
    """Return a recording of both ends, with damaged frames and noise."""
    chance = random.Random(seed)  # noqa: S311 - the same noise in every run
    senders = ["host", "controller", "either", "noise", "host noise", "controller noise"]
    reasons = [*(reason.value for reason in Reason), "something else"]
    lines = [
        f"{data.hex(' ')}  # {at}.25 s, {chance.choice(senders)}: {chance.choice(reasons)}"
        for at, data in enumerate(noisy_lines(reference("busservo").model, seed, 150))
        if data
    ]
    return "\n".join(lines) + "\n"


def saved(texts: Sequence[tuple[str, str | None, str]]) -> Any:
    scripts = [*codec_scripts(reference("busservo").model), *SAVERS]
    return run_script(scripts, SAVE, {"protocol": DATA, "texts": texts})


@in_turn("form", lambda: ["csv", "json"])
def test_a_capture_is_saved_as_the_command_prints_it(form: str) -> None:
    cut_off = (ROOT / "tests" / "captures" / "cut_off.hex").read_text("utf-8")
    plain = "\n".join(line.hex(" ") for line in noisy_lines(reference("busservo").model, 5, 60))
    texts = [cut_off, plain, *(noisy_recording(seed) for seed in range(3))]
    for text, found in zip(texts, saved([(text, None, form) for text in texts]), strict=True):
        assert joined(found, form) == joined(printed(text, form), form)


def test_what_the_command_prints_is_read_with_its_directions() -> None:
    text = noisy_recording(9)
    forms = [printed(text, form) for form in ("csv", "json")]
    again = saved([(each, None, "csv") for each in forms])
    expected = joined(printed(text, "csv"), "csv")
    assert [joined(each, "csv") for each in again] == [expected] * 2


def test_a_saved_recording_is_the_same_capture() -> None:
    text = noisy_recording(3)
    (kept,) = saved([(text, None, "recording")])
    senders = re.compile(r"s, [^:]*:")
    assert len(senders.findall(kept)) == len(kept.splitlines())
    assert printed(kept, "csv").count("\n") > len(text.splitlines()) > 9
    assert joined(printed(kept, "csv"), "csv") == joined(printed(text, "csv"), "csv")
