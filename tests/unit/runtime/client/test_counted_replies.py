"""A reply holds as many items as were asked for: one of another size answers something else."""

from __future__ import annotations

import importlib
import math
from typing import TYPE_CHECKING, Any

import pytest
from framegen.model.codec import encode

from tests.bad_specs import BASES
from tests.contract.independent.memory import MemoryPort
from tests.factories import compiled_file, library, library_of, vectors_of
from tests.in_turn import in_turn
from tests.lines.timed_line import Pieces, TimedLine, client_on
from tests.protocols.specs import FILES

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path
    from types import ModuleType

MODEL = compiled_file(BASES / "memory.yaml").model
REPLY_TIMEOUT = 0.25


@pytest.fixture(scope="module")
def memory() -> Iterator[ModuleType]:
    """Return the library of a memory."""
    files = library_of(BASES / "memory.yaml")
    with library(files) as made:
        importlib.import_module("memory.device")
        yield made


def frame(message: str, **values: Any) -> bytes:
    """Return a frame by the reference, which the library has no part in."""
    assert MODEL is not None
    return encode(MODEL.messages[message], values)


def client(memory: ModuleType, *answers: Pieces) -> Any:
    """Return a client; each of its frames is answered by bytes, each so many seconds later."""
    script = [*answers]
    line = TimedLine(lambda _: script.pop(0) if script else [], in_order=False)
    return client_on(line, memory.Controller, reply_timeout=REPLY_TIMEOUT)


TWO, ONE = frame("Bytes", stored=[1, 2]), frame("Bytes", stored=[7])


def test_the_late_answer_to_a_question_for_more_is_not_that_to_one_for_fewer(
    memory: ModuleType,
) -> None:
    """A question for 1 byte, after one for 2 that had timed out, returned the 2 of the first."""
    with client(memory, [(0.6, TWO)], []) as host:
        with pytest.raises(memory.NoReplyError):
            host.read_bytes(16, count=2)
        with pytest.raises(memory.NoReplyError, match="1 reply came that cannot be the answer"):
            host.read_bytes(16, count=1)


def test_the_right_size_is_taken_among_others(memory: ModuleType) -> None:
    with client(memory, [(0.02, TWO), (0.03, ONE), (0.04, TWO)]) as host:
        assert host.read_bytes(16, count=1) == (7,)
        assert host.counters.unsolicited == 1


@pytest.mark.parametrize(
    ("values", "ends"),
    [
        ({"status": 1, "found": [75, 76]}, "two"),
        ({"status": 1, "found": [75]}, "no reply"),
        ({"status": 1, "found": [75, 76, 77]}, "no reply"),
        ({"status": 0, "found": []}, "failure"),
        ({"status": 2, "found": [1, 2]}, "failure"),
    ],
)
def test_a_list_is_as_long_as_the_one_that_was_sent_unless_it_says_why_not(
    memory: ModuleType, values: dict[str, Any], ends: str
) -> None:
    with client(memory, [(0.03, frame("Some", **values))]) as host:
        if ends == "two":
            assert host.read_some([1, 5]) == (75, 76)
            return
        error = memory.FailureError if ends == "failure" else memory.NoReplyError
        with pytest.raises(error):
            host.read_some([1, 5])


@pytest.mark.parametrize(("held", "fits"), [(2, True), (1, False), (3, False), (0, False)])
def test_a_device_sends_no_answer_of_another_size(
    memory: ModuleType, held: int, fits: bool
) -> None:
    class Eeprom(memory.device.Device):  # type: ignore[name-defined, misc]
        def on_bytes_read(self, _message: Any) -> Any:
            return memory.Bytes([9] * held)

    device, question = Eeprom(), frame("BytesRead", start=16, count=2)
    if fits:
        assert device.receive(question) == frame("Bytes", stored=[9, 9])
        return
    asked = f"count of BytesRead asks for 2 items, and the reply holds {held}"
    with pytest.raises(memory.EncodeError, match=asked):
        device.receive(question)
    assert device.take() == []


def test_a_device_that_refuses_need_not_hold_anything(memory: ModuleType) -> None:
    class Eeprom(memory.device.Device):  # type: ignore[name-defined, misc]
        def on_some_read(self, _message: Any) -> Any:
            return memory.Some(status=0, found=[])

    answer = Eeprom().receive(frame("SomeRead", addresses=[1, 2]))
    assert answer == frame("Some", status=0, found=[])


def test_the_model_knows_the_size_as_well() -> None:
    """Conformance, the audit and the comparison of editions ask it."""
    assert MODEL is not None
    some = MODEL.exchanges_by_request["SomeRead"]
    asked = {"addresses": [1, 2]}
    assert not some.miscounts(asked, {"status": 1, "found": [1, 2]})
    assert some.miscounts(asked, {"status": 1, "found": [1]})
    assert not some.miscounts(asked, {"status": 0, "found": [1]})


@in_turn("spec", lambda: [BASES / "memory.yaml", FILES["modbus"]])
def test_the_vectors_say_which_replies_answer(spec: Path) -> None:
    compiled = compiled_file(spec)
    model, vectors = compiled.model, vectors_of(compiled)
    sent, received = model.roles.sent, model.roles.received
    with library(library_of(spec)) as made:
        exchanges = importlib.import_module(f"{made.__name__}._exchanges").EXCHANGES
        for vector in vectors["replies"]:
            request, reply = (
                made.decode(bytes.fromhex(vector[key]), made.Direction(way.key))
                for key, way in (("request", sent), ("reply", received))
            )
            fits = exchanges[type(request)].counted.fits(request, reply)
            assert fits is vector["answers"], vector["title"]
    said = {vector["answers"] for vector in vectors["replies"]}
    assert said == {True, False}


def test_a_memory_written_by_hand_answers_as_the_vectors_say() -> None:
    for vector in vectors_of(compiled_file(BASES / "memory.yaml"))["replies"]:
        if vector["title"].startswith("BytesRead"):
            port = MemoryPort(late={})
            port.write(bytes.fromhex(vector["request"]))
            answer = port.read(math.inf)
            same_size = len(answer) == len(bytes.fromhex(vector["reply"]))
            assert same_size is vector["answers"], vector["title"]
