"""Rows of what the command of a library prints, and of what is read of recordings."""

from __future__ import annotations

import os
import re
import shlex
from contextlib import contextmanager
from importlib import import_module
from importlib.util import find_spec
from io import BytesIO
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any
from unittest import mock

from serial.tools.list_ports_common import ListPortInfo
from serial.urlhandler import protocol_loop

from tests.characterised.talks import reply_to
from tests.characterised.texts import lines, outcome, ways
from tests.characterised.values import by_message, frames_of
from tests.commands import called

if TYPE_CHECKING:
    from collections.abc import Iterator
    from types import ModuleType

    from framegen.model.model import Model

    from tests.characterised.texts import Rows

HAS_TABLES = find_spec("pyarrow") is not None
# What is typed behind each verb, one after the other; N is noise between frames.
TYPED = {
    "decode": "N|zz|5|none.bin|line.hex 00|line.hex|line.bin|--json --csv 00|--file x|--strict N",
    "decode --json": "N|line.hex|line.bin",
    "decode --csv": "N|line.hex|line.bin",
    "decode line.hex": "-t delta|-t zero|--format raw|--format hex|--csv-tables tables",
    "decode --direction": "any N|any line.hex|nobody N",
    "docs": "|errata|lookalikes|the|0x01|nosuchword|--json",
    "explain": "|zz|5|00|00 11 --json",
    "encode": "|Nope|--nope",
    "ports": "|--json|x",
    "replay": "line.hex --dry-run|line.bin --dry-run|line.hex|none.hex --dry-run",
}
WITH_TABLES = {
    "stats": "line.hex|line.bin|line.hex --json|N|none.hex",
    "decode line.hex": "--parquet parquet|--arrow line.arrow",
}
ON_LINE = "--port loop:// --baud inf --timeout 1"


@contextmanager
def alone(made: ModuleType, model: Model) -> Iterator[None]:
    """Give the command a folder, a port and a device of its own, and nothing of this machine."""

    def write(looped: Any, data: bytes) -> int:
        for octet in reply_to(made, model, bytes(data)):
            looped.queue.put(bytes([octet]))
        return len(data)

    port = ListPortInfo("/dev/made_up")
    port.description, port.vid, port.pid, port.serial_number = "Made up", 0x1A86, 0x7523, "7"
    before = Path.cwd()
    with TemporaryDirectory() as folder:
        here = {"COLUMNS": "80", "XDG_CONFIG_HOME": folder, "APPDATA": folder, "LANGUAGE": "C"}
        os.chdir(folder)
        try:
            with (
                mock.patch.dict(os.environ, here),
                mock.patch("serial.tools.list_ports.comports", return_value=[port]),
                mock.patch.object(protocol_loop.Serial, "write", write),
            ):
                os.environ.pop(f"{made.__name__.upper()}_PORT", None)
                yield
        finally:
            os.chdir(before)


def command_rows(made: ModuleType, vectors: dict[str, Any]) -> Rows:
    main = import_module(f"{made.__name__}.__main__").main

    def say(*words: str, given: str = "") -> str:
        ended = called(main, *words, given=given)
        return lines([f"$ {shlex.join(words)}", str(ended.status), ended.out, ended.err])

    messages = {name: those[0] for name, those in by_message(made, vectors).items()}
    noisy = b"\x55".join([*(each.encode() for each in messages.values()), b"\xff"]).hex()
    _write_captures([*messages.values()])
    yield "command/version", re.sub(r"\d+\.\d+\.\d+", "VERSION", say("--version"))
    yield "command/none", lines([say(), say("nonsense"), say("limits"), say("--nonsense")])
    usage = say("--help")
    yield "command/help", _help(usage)
    for verb in re.findall(
        r"^  (\S+) ", usage.partition("verbs:")[2].partition("\n\n")[0], re.MULTILINE
    ):
        yield f"command/{verb}-help", _help(say(verb, "--help"))
    for table, area in ((TYPED, "command"), (WITH_TABLES if HAS_TABLES else {}, "tables")):
        for verb, typed in table.items():
            those = [f"{verb} {each}".replace("N", noisy).split() for each in typed.split("|")]
            yield f"{area}/{verb.replace(' ', '-')}", lines(say(*each) for each in those)
    for file in sorted(Path("tables").iterdir()):
        yield f"command/decode-csv-tables-{file.name}", file.read_text("utf-8")
    for way in made.Direction:
        yield f"command/decode-{way.sender}", say("decode", "--direction", way.sender, noisy)
    yield "command/decode-input", lines([say("decode", given=noisy), say("decode", "-", given="x")])
    for name, message in messages.items():
        yield from _message_rows(made, say, name, message)
    yield "command/answer", say("answer", given=lines(_questions(vectors)))


def _message_rows(made: ModuleType, say: Any, name: str, message: Any) -> Rows:
    data, way = message.encode(), message.DIRECTION.sender
    spoilt = [data, data[:-1], data[:-1] + bytes([data[-1] ^ 1])]
    texts = [say("explain", "--direction", way, each.hex()) for each in spoilt]
    yield f"command/explain-{name}", lines([*texts, say("explain", data.hex(), "--json")])
    docs = say("docs", name)
    yield f"command/docs-{name}", docs
    texts = [
        say(*shlex.split(each)) for each in re.findall(r"^ +\w+ (encode .*)$", docs, re.MULTILINE)
    ]
    given = ["nope=1", *(f"{each}=x" for each in message.to_dict())]
    texts += [say("encode", name), *(say("encode", name, each) for each in given)]
    yield f"command/encode-{name}", lines(texts)


def _questions(vectors: dict[str, Any]) -> Iterator[str]:
    yield from ("encode Nope", "encode", "nonsense", "stream x 1 00", "decode x 00")
    for each in vectors["valid"][:60] + vectors["invalid"][:60]:
        yield f"decode {each['direction']} {each['hex']}"
    for each in vectors["streams"][:80]:
        yield f"stream {each['direction']} {each['max_frame'] or 1000} {' '.join(each['parts'])}"


def line_rows(made: ModuleType) -> Rows:
    """Yield what verbs say of a line: in real time, so that what was measured is left out."""
    main = import_module(f"{made.__name__}.__main__").main
    for name, typed in {
        "doctor": f"doctor {ON_LINE}|doctor --port no-such-port|doctor {ON_LINE} --json",
        "send": f"send {ON_LINE} Nope|send --port no-such-port Nope|send",
    }.items():
        ended = [called(main, *each.split()) for each in typed.split("|")]
        text = lines(f"$ {each.status}\n{each.out}\n{each.err}" for each in ended)
        text = re.sub(
            r'^(?:\w+ +hid |\{"check": "hid").*\n(?: .*\n)*', "", text, flags=re.MULTILINE
        )
        yield f"line/{name}", re.sub(r"[0-9.]+ m?s\b", "TIME", text)


def _help(text: str) -> str:
    """Return a help in which what argparse breaks into lines is in one, as from Python 3.13 on."""
    wrapped = re.compile(r"(?:\$ .*\n.*\n)?(?:usage|options|positional arguments):")
    parts = (" ".join(it.split()) if wrapped.match(it) else it for it in text.split("\n\n"))
    return re.sub(r"(-\w) ([^\s,]+), (--\S+ \2)", r"\1, \3", "\n\n".join(parts))


def _write_captures(messages: list[Any]) -> None:
    frames = [each.encode() for each in messages]
    Path("line.bin").write_bytes(b"\xff\x00" + b"".join(frames) + frames[0][:-1])
    rows = ["# recorded of 'line' from 2026-01-02 09:08:07.250000 +0000 on"]
    for number, (frame, each) in enumerate(zip(frames, messages, strict=True)):
        rows.append(f"{frame.hex(' ')}  # {number / 8:.6f} s, {each.DIRECTION.sender}: it")
    rows += [f"FF 00  # {len(rows) / 8:.6f} s, noise: bad header", "# quiet", ""]
    Path("line.hex").write_text(lines(rows), "utf-8")


def recording_rows(made: ModuleType, vectors: dict[str, Any]) -> Rows:
    recordings = import_module(f"{made.__name__}.recordings")

    def read(source: Any, **more: Any) -> str:
        return outcome(lambda: list(recordings.read(source, **more)))

    for way in ways(made):
        for name in ("line.hex", "line.bin", "none"):
            texts = (read(name, form=form, direction=way) for form in recordings.FORMS)
            yield f"recordings/{name}-{'any' if way is None else way.value}", lines(texts)
    frames = [each.hex(" ") for each in frames_of(vectors)[:20]]
    marks = ["->", "<-", "TX:", "RX:", f"{next(iter(made.Direction)).sender}:"]
    logs = [lines(f"12:01:02.123 {mark} {each}" for each in frames) for mark in marks]
    logs += [lines(f"{mark} {each}" for each in frames) for mark in ("TX:", "RX:", "#", "0x")]
    logs += ["zz", "5", "00 # quiet\n", "# nothing\n", "", "12:00:00 -> zz", "time,tx,rx\n1,00,\n"]
    for number, log in enumerate(logs):
        yield f"recordings/log-{number}", read(BytesIO(log.encode()))
    if HAS_TABLES:
        tables = import_module(f"{made.__name__}.tables")
        for name, schema in tables.schemas().items():
            yield f"tables/schema-{name}", str(schema)
        for name in ("line.hex", "line.bin"):
            filled = tables.read(name).filled.items()
            yield f"tables/{name}", lines(f"{each} {it.to_pylist()}" for each, it in filled)
            blocks = [
                {table: batch.to_pylist() for table, batch in each.items()}
                for each in tables.read_batches(name, block=16)
            ]
            yield f"tables/{name}-blocks", lines(map(repr, blocks))
