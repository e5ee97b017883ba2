"""What a device refuses or fails to carry out is an error; a reply is as long as was asked for."""

import importlib
import pickle
from collections.abc import Iterator, Sequence
from typing import Any

import pytest
from framegen.model.codec import encode

from tests.bad_specs import BASES
from tests.factories import (
    compiled_file,
    data_of,
    files_of,
    imported,
    library,
    library_of,
    vectors_of,
)
from tests.in_turn import in_turn
from tests.lines.timed_line import Pieces, ScriptedLine, TimedLine, client_of, client_on
from tests.mutations.places import having
from tests.protocols.specs import FILES

NAMES = ("dynamixel1", "modbus")
MEMORY = BASES / "memory.yaml"


@pytest.fixture(scope="module", autouse=True)
def libraries() -> Iterator[None]:
    """Import the libraries under their own names."""
    with imported(*(library_of(FILES[name]) for name in NAMES), library_of(MEMORY)):
        yield


def lib(name: str) -> Any:
    importlib.import_module(f"{name}.device")
    return importlib.import_module(name)


def frame(name: str, message: str, **values: Any) -> bytes:
    """Return a frame by the reference, which the library has no part in."""
    layouts = compiled_file(MEMORY if name == "memory" else FILES[name]).model.messages
    return encode(layouts[message], values)


def status(servo_id: int, error: int, data: Sequence[int] = ()) -> bytes:
    return frame("dynamixel1", "Status", servo_id=servo_id, error=error, data=[*data])


def client(name: str, answer: bytes, **settings: Any) -> Any:
    return client_on(ScriptedLine(lambda _: answer), lib(name).Controller, **settings)


# ------------------------------------------------------------------ refusals
def test_a_refusal_is_an_error_that_carries_it() -> None:
    modbus = lib("modbus")
    with client("modbus", frame("modbus", "HoldingReadRefused", unit=17, reason=2)) as bus:
        with pytest.raises(modbus.RefusedError) as caught:
            bus.read_holding(17, start=107, quantity=3)
        assert caught.value.request == modbus.HoldingRead(17, start=107, quantity=3)
        assert caught.value.refusal == modbus.HoldingReadRefused(17, reason=2)
        assert isinstance(caught.value, modbus.ProtocolError)
        assert not isinstance(caught.value, TimeoutError)
        assert str(caught.value) == (
            "HoldingRead(unit=17, start=107, quantity=3) was refused: "
            "HoldingReadRefused(unit=17, reason=2) (illegal_address)"
        )
        assert str(pickle.loads(pickle.dumps(caught.value))) == str(caught.value)  # noqa: S301
        with pytest.raises(modbus.RefusedError):
            bus.request(modbus.HoldingRead(17, start=107, quantity=3))


def test_a_refusal_of_another_device_or_of_something_else_refuses_nothing() -> None:
    modbus = lib("modbus")
    others = frame("modbus", "HoldingReadRefused", unit=18, reason=2)
    others += frame("modbus", "CoilsReadRefused", unit=17, reason=2)
    with client("modbus", others) as bus:
        with pytest.raises(modbus.NoReplyError):
            bus.read_holding(17, start=107, quantity=3)
        assert bus.counters.unsolicited == 2


def test_a_handler_may_refuse() -> None:
    modbus = lib("modbus")

    class Registers(modbus.Device):  # type: ignore[misc, name-defined]
        def on_holding_read(self, message: Any) -> Any:
            if message.start:
                return modbus.HoldingReadRefused(message.unit, reason=2)
            return modbus.Holding(message.unit, registers=[7] * message.quantity)

    with client_of(Registers(17)) as bus:
        assert bus.read_holding(17, start=0, quantity=2) == (7, 7)
        with pytest.raises(modbus.RefusedError) as caught:
            bus.read_holding(17, start=1, quantity=2)
        assert caught.value.named == ("illegal_address",)


# ------------------------------------------------------------------ failures
def test_a_failure_names_the_bits_that_are_set() -> None:
    dynamixel = lib("dynamixel1")
    reply = status(1, 0x24)
    with client("dynamixel1", reply) as bus:
        with pytest.raises(dynamixel.FailureError) as caught:
            bus.write(1, start=30, data=[0, 2])
        assert caught.value.named == ("overheating", "overload")
        assert caught.value.reply == dynamixel.Status(1, error=0x24, data=[])
        assert caught.value.field == "error"
        assert str(caught.value) == (
            "Write(servo_id=1, start=30, data=(0, 2)) has failed: "
            "error is 36 (overheating, overload)"
        )
        assert str(pickle.loads(pickle.dumps(caught.value))) == str(caught.value)  # noqa: S301
        with pytest.raises(dynamixel.FailureError):
            bus.device(1).ping()


def test_who_answers_all_is_gathered_whatever_has_failed() -> None:
    dynamixel = lib("dynamixel1")
    with client("dynamixel1", status(1, 1) + status(2, 2)) as bus:
        assert bus.broadcast().ping(within=0.1) == [
            dynamixel.Status(1, error=1, data=[]),
            dynamixel.Status(2, error=2, data=[]),
        ]


# ------------------------------------------------------------------ a frame that may be both
def test_a_status_with_another_good_value_fails_with_all_others() -> None:
    """A sensor whose status is 1 after a success raised on every success."""
    one = {"protocol.name": "well", "messages.Status.failure": "error unless 1"}
    spec = having(data_of(FILES["dynamixel1"]), one)
    answers = [status(1, each) for each in (0, 2, 1)]
    line = ScriptedLine(lambda _: answers.pop(0))
    with library(files_of(spec)) as well, client_on(line, well.Controller) as bus:
        for error in (0, 2):
            with pytest.raises(well.FailureError, match=f"error is {error}"):
                bus.ping(1)
        assert bus.ping(1).error == 1


# ------------------------------------------------------------------ as many items as were asked for
def memory_client(*answers: Pieces) -> Any:
    """Return a client; each of its frames is answered by bytes, each so many seconds later."""
    script = [*answers]
    line = TimedLine(lambda _: script.pop(0) if script else [], in_order=False)
    return client_on(line, lib("memory").Controller, reply_timeout=0.25)


@in_turn(
    "status, found, error",
    lambda: [
        (1, [75, 76], None),
        (1, [75], "NoReplyError"),
        (1, [75, 76, 77], "NoReplyError"),
        (0, [], "FailureError"),
        (2, [1, 2], "FailureError"),
    ],
)
def test_a_list_is_as_long_as_the_one_that_was_sent_unless_it_says_why_not(
    status: int, found: list[int], error: str | None
) -> None:
    with memory_client([(0.03, frame("memory", "Some", status=status, found=found))]) as host:
        if error is None:
            assert host.read_some([1, 5]) == (75, 76)
            return
        with pytest.raises(getattr(lib("memory"), error)):
            host.read_some([1, 5])


def eeprom(held: int) -> Any:
    memory = lib("memory")

    class Eeprom(memory.device.Device):  # type: ignore[name-defined, misc]
        def on_bytes_read(self, _message: Any) -> Any:
            return memory.Bytes([9] * held)

        def on_some_read(self, _message: Any) -> Any:
            return memory.Some(status=0, found=[])

    return Eeprom()


def test_a_device_sends_no_answer_of_another_size_unless_it_refuses() -> None:
    question = frame("memory", "BytesRead", start=16, count=2)
    assert eeprom(2).receive(question) == frame("memory", "Bytes", stored=[9, 9])
    for held in (0, 1, 3):
        device = eeprom(held)
        asked = f"count of BytesRead asks for 2 items, and the reply holds {held}"
        with pytest.raises(lib("memory").EncodeError, match=asked):
            device.receive(question)
        assert device.take() == []
    answer = eeprom(0).receive(frame("memory", "SomeRead", addresses=[1, 2]))
    assert answer == frame("memory", "Some", status=0, found=[])


def test_the_model_knows_the_size_as_well() -> None:
    """Conformance, the audit and the comparison of editions ask it."""
    some = compiled_file(MEMORY).model.exchanges_by_request["SomeRead"]
    asked = {"addresses": [1, 2]}
    assert not some.miscounts(asked, {"status": 1, "found": [1, 2]})
    assert some.miscounts(asked, {"status": 1, "found": [1]})
    assert not some.miscounts(asked, {"status": 0, "found": [1]})


@in_turn("name", lambda: ["memory", "modbus"])
def test_the_vectors_say_which_replies_answer(name: str) -> None:
    compiled, made = compiled_file(MEMORY if name == "memory" else FILES[name]), lib(name)
    roles, vectors = compiled.model.roles, vectors_of(compiled)["replies"]
    exchanges = importlib.import_module(f"{name}._exchanges").EXCHANGES
    for vector in vectors:
        request, reply = (
            made.decode(bytes.fromhex(vector[key]), made.Direction(way.key))
            for key, way in (("request", roles.sent), ("reply", roles.received))
        )
        fits = exchanges[type(request)].counted.fits(request, reply)
        assert fits is vector["answers"], vector["title"]
    assert {vector["answers"] for vector in vectors} == {True, False}
