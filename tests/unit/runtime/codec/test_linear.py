"""Work grows linearly: counted in lines that run, so that no clock is needed."""

import sys
from collections.abc import Callable
from functools import cache, partial
from pathlib import Path
from types import FrameType, ModuleType
from typing import Any

import busservo
import framegen
import pytest
from busservo import Direction, ServoPositions, StreamDecoder
from framegen.compile import compile_spec
from framegen.reading.source import Source
from framegen.render import render

from tests.factories import data_in, yaml_of
from tests.in_turn import in_turn
from tests.rows import Rows

# What is listed to an end, such as the first few of something, is so in all of these.
MANY = (20, 30, 40)


MANY_MESSAGES = """
framegen: 2
protocol: {name: many, title: Many, version: 1.0.0, authority: manual, summary: Many messages.}
sources: {manual: {title: A manual, kind: document}}
endpoints: {host: Asks., device: Answers.}
link: {baud: 9600}
byte_order: big
frame:
  header: {is: constant, bytes: AA 55}
  size: {is: length, type: u8, counts: [code, body]}
  code: {is: id, type: u16}
  body: {is: body}
"""
# Behind the body.
BUS_PARTS = data_in("""
station: {is: address, type: u8, values: {all: {value: 255, silent: true}}}
check: {is: checksum, type: u8, method: inverted sum, covers: [size, code, body, station]}
""")


def many(number: int, *, bus: bool = False) -> Source:
    """Return a spec of questions and answers, reports among them; of devices on a `bus`, proven."""
    data = data_in(MANY_MESSAGES)
    data["frame"] |= BUS_PARTS if bus else {}
    messages = data["messages"] = {}
    for at in range(1000, 1000 + number, 2):
        ask, tell, refuse = f"Ask{at:04}", f"Tell{at:04}", f"Not{at:04}"
        level = {"fields": {"level": {"type": "u8", "about": "How bright."}}}
        messages[ask] = _message(at, "host -> device", {}, bus) | {"reply": tell, "reports": [tell]}
        messages[tell] = _message(at, "device -> host", {"level": 7}, bus) | level
        if bus:
            # The stations of a bus answer, or refuse, with frames that prove themselves.
            messages[ask]["refusal"] = refuse
            messages[refuse] = _message(at + 5000, "device -> host", {"level": 7}, bus) | level
    return Source("many.yaml", yaml_of(data))


def _message(code: int, way: str, values: dict[str, int], bus: bool) -> dict[str, Any]:
    frame = bytes([0xAA, 0x55, 2 + len(values)]) + code.to_bytes(2, "big") + bytes(values.values())
    if bus:
        frame, values = frame + b"\x07", values | {"station": 7}
        frame += bytes([~sum(frame[2:]) & 0xFF])
    example = {"title": "One.", "hex": frame.hex(" "), "values": values, "cite": "manual"}
    said = {"id": code, "direction": way, "summary": f"Say level {code:04}.", "cite": "manual"}
    return said | {"length": frame[2], "examples": [example]}


def lines_run(work: Callable[[], object], package: ModuleType) -> int:
    """Return how many lines of a package run, those of its templates among them.

    Others keep what they found until there is too much of it: what `re` has compiled falls out
    while other tests compile patterns of their own, and is compiled again somewhere in here.
    """
    count = 0
    folder = str(Path(str(package.__file__)).parent)

    def enter(frame: FrameType, _event: str, _argument: object) -> Any:
        nonlocal count
        if not frame.f_code.co_filename.startswith(folder):
            return None
        count += 1
        return step

    def step(_frame: FrameType, _event: str, _argument: object) -> Any:
        nonlocal count
        count += 1
        return step

    before = sys.gettrace()
    sys.settrace(enter)
    try:
        work()
    finally:
        sys.settrace(before)
    return count


nobody_traces = pytest.mark.skipif(
    sys.gettrace() is not None, reason="somebody else traces already"
)


# --- From the text to the files ------------------------------------------------------------------
def generated(number: int, *, bus: bool) -> None:
    """Make all files of a spec of so many messages."""
    compiled = compile_spec(many(number, bus=bus))
    assert compiled.findings == []
    assert render(compiled)


@nobody_traces
# What is on no bus goes other ways in few places.
@pytest.mark.parametrize("bus", Rows([True], others=[False]))
def test_work_grows_no_faster_than_the_messages(bus: bool) -> None:
    generated(MANY[0], bus=bus)  # templates are compiled and read once for all
    few, more, most = (lines_run(partial(generated, number, bus=bus), framegen) for number in MANY)
    # A search through all messages for each of them makes it 1.005.
    assert most - more <= 1.0004 * (more - few)


# --- From bytes to messages ----------------------------------------------------------------------

NORMAL = ServoPositions([(servo, 500) for servo in range(1, 7)]).encode()

# What costs a decoder most, again and again.
DEAR = (
    "00",
    "55 00",
    "55 55 00",
    "55 55 55 00",
    "55 55 55 63",
    "55 55 55 55 07",
    "55 55 55 55 FF",
    "55 55 55 15 54",
    "55 55 02 63",
    "55 55 FE 63",
    "55 55 FF 63",
    "55 55 40 63 55 55 3C 64",
    "55 55 FF 15 FC",
    "55 55 FF 15 55",
    "55 55 FE 03 53",
    "55 55 06 15 02",
    "55 55 05 06 55",
    "55 55 55 55 02 07",
    # Claims in claims, and behind all of them what may become a message.
    "".join(f"55 55 {255 - 4 * claim:02X} 63 " for claim in range(60)) + "55 55 FF 15 54",
)
# Runs of the byte that a header consists of, without an end, before a message, and before nothing.
RUNS = ("55", "55 " * 40 + "02 07", "55 " * 80 + "00 00 00")


@cache
def lines_per_byte(pattern: bytes, size: int) -> float:
    """Return how many lines run for a byte of a repeated pattern, in chunks of a size."""
    # More than any frame, and than a chunk.
    least = max(1024, size)
    line = (pattern * 3 * least)[: 3 * least]
    chunks = [line[at : at + size] for at in range(0, len(line), size)]
    decoder = StreamDecoder(Direction.CONTROLLER_TO_HOST)
    # The beginning, when nothing is held yet, is cheaper; and some is looked up once for all.
    begun = least // size
    for chunk in chunks[:begun]:
        decoder.feed(chunk)
    rest = chunks[begun:]
    return lines_run(lambda: [decoder.feed(chunk) for chunk in rest], busservo) / (2 * least)


# A port hands over some bytes at a time, a file many: traffic is then so cheap that noise, of which
# each piece is reported with its reason, is many times as dear.
@nobody_traces
@pytest.mark.parametrize(("size", "times"), [(2048, 55), (64, 25), (1, 14)])
@in_turn("pattern", lambda: DEAR)
def test_no_bytes_cost_many_times_normal_traffic(pattern: str, size: int, times: float) -> None:
    normal = lines_per_byte(NORMAL, size)
    assert lines_per_byte(bytes.fromhex(pattern), size) <= times * normal


@nobody_traces
@pytest.mark.parametrize(("size", "times"), [(2048, 8), (64, 5), (1, 14)])
@in_turn("pattern", lambda: RUNS)
def test_runs_of_one_byte_cost_little_more_than_traffic(
    pattern: str, size: int, times: float
) -> None:
    normal = lines_per_byte(NORMAL, size)
    assert lines_per_byte(bytes.fromhex(pattern), size) <= times * normal
