"""What a device refuses, or fails to carry out, is an error that carries what it said."""

from __future__ import annotations

import asyncio
import importlib
import pickle
from typing import TYPE_CHECKING, Any

import pytest
from framegen.model.codec import encode

from tests.factories import data_of, files_of, imported, library, library_of
from tests.lines.timed_line import ScriptedLine, client_on
from tests.mutations.places import having
from tests.protocols.specs import FILES, messages_of

if TYPE_CHECKING:
    from collections.abc import Iterator

NAMES = ("dynamixel1", "modbus")


@pytest.fixture(scope="module", autouse=True)
def libraries() -> Iterator[None]:
    """Return the libraries, imported under their own names."""
    with imported(*(library_of(FILES[name]) for name in NAMES)):
        yield


def lib(name: str) -> Any:
    return importlib.import_module(name)


def frame(name: str, message: str, **values: Any) -> bytes:
    """Return a frame by the reference, which the library has no part in."""
    return encode(messages_of(name)[message], values)


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


def test_what_is_not_refused_is_answered() -> None:
    reply = frame("modbus", "Holding", unit=17, registers=[1, 2, 3])
    with client("modbus", reply) as bus:
        assert bus.read_holding(17, start=107, quantity=3) == (1, 2, 3)
        assert bus.device(17).read_holding(107, 3) == (1, 2, 3)


# ------------------------------------------------------------------ failures


def test_a_failure_names_the_bits_that_are_set() -> None:
    dynamixel = lib("dynamixel1")
    status = frame("dynamixel1", "Status", servo_id=1, error=0x24, data=[])
    with client("dynamixel1", status) as bus:
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


def test_a_reply_without_a_failure_is_returned() -> None:
    status = frame("dynamixel1", "Status", servo_id=1, error=0, data=[0x20])
    with client("dynamixel1", status) as bus:
        assert bus.read(1, start=43, size=1) == (0x20,)


def test_failures_are_raised_with_asyncio_as_well() -> None:
    dynamixel = lib("dynamixel1")
    status = frame("dynamixel1", "Status", servo_id=1, error=1, data=[])
    line = ScriptedLine(lambda _: status)

    async def ask() -> None:
        async with dynamixel.AsyncController(line, settle=0) as bus:
            with pytest.raises(dynamixel.FailureError, match="input_voltage"):
                await bus.ping(servo_id=1)

    asyncio.run(ask())


def test_who_answers_all_is_gathered_whatever_has_failed() -> None:
    dynamixel = lib("dynamixel1")
    answers = b"".join(
        frame("dynamixel1", "Status", servo_id=each, error=each, data=[]) for each in (1, 2)
    )
    with client("dynamixel1", answers) as bus:
        assert bus.broadcast().ping(within=0.1) == [
            dynamixel.Status(1, error=1, data=[]),
            dynamixel.Status(2, error=2, data=[]),
        ]


# ------------------------------------------------------------------ a frame that may be both


def test_an_echo_is_never_taken_for_the_reply_that_it_looks_like() -> None:
    """The ping of servo 1 is, to the byte, a status of servo 1 whose supply is out of bounds."""
    dynamixel = lib("dynamixel1")
    ping = frame("dynamixel1", "Ping", servo_id=1)
    assert ping == frame("dynamixel1", "Status", servo_id=1, error=1, data=[])
    status = frame("dynamixel1", "Status", servo_id=1, error=0, data=[])
    with client("dynamixel1", ping + status, local_echo=True) as bus:
        assert bus.ping(1) == dynamixel.Status(1, error=0, data=[])
        assert bus.counters.echoes == 1
    with (
        client("dynamixel1", ping + ping, local_echo=True) as bus,
        pytest.raises(dynamixel.FailureError),
    ):
        bus.ping(1)
    with (
        client("dynamixel1", ping, local_echo=True) as bus,
        pytest.raises(dynamixel.NoReplyError),
    ):
        bus.ping(1)
    with client("dynamixel1", ping + status) as bus:  # nobody spoke of an echo, and it is dropped
        assert bus.ping(1) == dynamixel.Status(1, error=0, data=[])
        assert bus.counters.unsolicited == 1


def test_a_status_with_another_good_value_fails_with_all_others() -> None:
    """A sensor whose status is 1 after a success raised on every success."""
    one = {"protocol.name": "well", "messages.Status.failure": "error unless 1"}
    spec = having(data_of(FILES["dynamixel1"]), one)
    answers = [frame("dynamixel1", "Status", servo_id=1, error=each, data=[]) for each in (0, 2, 1)]
    line = ScriptedLine(lambda _: answers.pop(0))
    with library(files_of(spec)) as well, client_on(line, well.Controller) as bus:
        for status in (0, 2):
            with pytest.raises(well.FailureError, match=f"error is {status}"):
                bus.ping(1)
        assert bus.ping(1).error == 1
