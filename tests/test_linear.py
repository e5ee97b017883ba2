"""Twice the messages cost twice the work: counted in lines that run, so that no clock is needed."""

import sys
from types import FrameType
from typing import Any

import pytest
from framegen.compile import compile_spec
from framegen.reading.source import Source
from framegen.render import render

from tests.specimens import yaml_of

FEW = 32


def many(number: int) -> Source:
    """A spec of questions and answers, reports among them."""
    messages: dict[str, Any] = {}
    for at in range(1000, 1000 + number, 2):
        messages[f"Ask{at:04}"] = {
            "id": at,
            "direction": "host -> device",
            "summary": f"Ask for level {at:04}.",
            "cite": "manual",
            "reply": f"Tell{at:04}",
            "reports": [f"Tell{at:04}"],
            "length": 2,
            "examples": [_example(f"AA 55 02 {at:04X}", {})],
        }
        messages[f"Tell{at:04}"] = {
            "id": at,
            "direction": "device -> host",
            "summary": f"Tell level {at:04}.",
            "cite": "manual",
            "length": 3,
            "fields": {"level": {"type": "u8", "about": "How bright."}},
            "examples": [_example(f"AA 55 03 {at:04X} 07", {"level": 7})],
        }
    data = {
        "framegen": 2,
        "protocol": {
            "name": "many",
            "title": "Many",
            "version": "1.0.0",
            "authority": "manual",
            "summary": "Many messages.",
        },
        "sources": {"manual": {"title": "A manual", "kind": "document"}},
        "endpoints": {"host": "Asks.", "device": "Answers."},
        "link": {"baud": 9600},
        "byte_order": "big",
        "frame": {
            "header": {"is": "constant", "bytes": "AA 55"},
            "size": {"is": "length", "type": "u8", "counts": ["code", "body"]},
            "code": {"is": "id", "type": "u16"},
            "body": {"is": "body"},
        },
        "messages": messages,
    }
    return Source("many.yaml", yaml_of(data))


def _example(digits: str, values: dict[str, int]) -> dict[str, Any]:
    spaced = bytes.fromhex(digits).hex(" ")
    return {"title": "One.", "hex": spaced, "values": values, "cite": "manual"}


def lines_run(number: int) -> int:
    """How many lines run, those of templates among them, from the text to the files."""
    source = many(number)
    count = 0

    def trace(frame: FrameType, _event: str, _argument: object) -> Any:
        nonlocal count
        if "pydantic" in frame.f_code.co_filename:
            return None
        count += 1
        return trace

    before = sys.gettrace()
    sys.settrace(trace)
    try:
        compiled = compile_spec(source)
        files = render(compiled)
    finally:
        sys.settrace(before)
    assert compiled.findings == []
    assert files
    return count


@pytest.mark.skipif(sys.gettrace() is not None, reason="somebody else traces already")
def test_work_grows_no_faster_than_the_messages() -> None:
    render(compile_spec(many(2)))  # templates are compiled and read once for all
    few, twice, four_times = (lines_run(FEW * factor) for factor in (1, 2, 4))
    first, second = twice - few, four_times - twice
    # A search through all messages for each of them makes it 2.06.
    assert second <= 2.003 * first
