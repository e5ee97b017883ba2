"""The client where a frame may be the beginning of another: it waits for silence if it must."""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

import pytest

from tests.factories import Data, data_of, files_of, imported, library_of
from tests.mutations.places import having
from tests.protocols.specs import FILES

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

GAP = 0.05


def refusing() -> Data:
    """Return the gauges of the guide, whose fault is also what comes instead of a pressure."""
    refusal = {"protocol.name": "refusing", "messages.PressureRead.refusal": "Fault"}
    return having(data_of(FILES["gauges"]), refusal)


@pytest.fixture(scope="module")
def libraries() -> Iterator[Callable[[str], Any]]:
    """Return what imports a module of a library: `gauges.messages`."""
    others = (library_of(FILES[name]) for name in ("gauges", "roboclaw"))
    with imported(files_of(refusing()), *others):
        yield importlib.import_module


def asked(libraries: Callable[[str], Any], name: str, question: str) -> tuple[Any, Any, Any]:
    """Return a session whose question has just left, the question, and the messages."""
    kinds = libraries(f"{name}.messages")
    line = libraries("framewire.client.session").Session(
        libraries(f"{name}._library").LIBRARY,
        baud=9600,
        reply_timeout=0.25,
        report_limit=16,
        settle=0,
    )
    request = line.submit(getattr(kinds, question)(), question=True)
    line.outgoing(0.0)
    line.written(request, 0.0)
    return line, request, kinds


def test_a_report_is_there_once_no_longer_frame_comes(libraries: Callable[[str], Any]) -> None:
    line, request, kinds = asked(libraries, "gauges", "PressureRead")
    fault = kinds.Fault(7)
    line.receive(fault.encode(), 0.1)
    assert line.tick_at == pytest.approx(0.1 + GAP)
    assert line.counters.reports == 0
    line.tick(0.1 + GAP)
    assert line.reports.take() == fault
    assert not request.done


def test_a_reply_that_begins_like_a_report_is_a_reply(libraries: Callable[[str], Any]) -> None:
    line, request, kinds = asked(libraries, "gauges", "PressureRead")
    pressure = kinds.Pressure(0x0728)
    assert pressure.encode().startswith(kinds.Fault(7).encode())
    for at, byte in enumerate(pressure.encode()):
        line.receive(bytes([byte]), 0.1 + at / 1000)
        line.tick(0.1 + at / 1000)
    assert request.reply == pressure
    assert (line.counters.reports, line.counters.noise) == (0, 0)


def test_of_two_answers_the_shorter_waits(libraries: Callable[[str], Any]) -> None:
    line, request, kinds = asked(libraries, "refusing", "PressureRead")
    line.receive(kinds.Fault(7).encode(), 0.1)
    line.tick(0.1 + GAP / 2)
    assert not request.done
    line.tick(0.1 + GAP)
    assert request.reply == kinds.Fault(7)


def test_it_waits_no_less_near_the_deadline(libraries: Callable[[str], Any]) -> None:
    line, request, kinds = asked(libraries, "refusing", "PressureRead")
    at = request.deadline - 0.001
    line.receive(kinds.Fault(7).encode(), at)
    line.tick(request.deadline + 0.001)
    assert not request.done
    line.tick(at + GAP)
    assert request.reply == kinds.Fault(7)


def test_an_answer_waits_for_nothing_that_nobody_has_asked_for(
    libraries: Callable[[str], Any],
) -> None:
    line, request, kinds = asked(libraries, "roboclaw", "VoltageRead")
    line.receive(kinds.Voltage(120).encode(), 0.1)
    assert line.tick_at == pytest.approx(0.1)
    line.tick(0.1)
    assert request.reply == kinds.Voltage(120)
    # Nothing is left of it: the next is read as it comes.
    line.receive(b"\0", 0.11)
    assert line.tick_at == pytest.approx(0.11 + GAP)


def test_it_waits_where_a_longer_one_may_come_late(libraries: Callable[[str], Any]) -> None:
    line, late, kinds = asked(libraries, "roboclaw", "VersionRead")
    line.cancel(late)
    request = line.submit(kinds.VoltageRead(), question=True)
    line.outgoing(0.01)
    line.written(request, 0.01)
    line.receive(kinds.Voltage(120).encode(), 0.1)
    line.tick(0.1)
    assert not request.done
    line.tick(0.1 + GAP)
    assert request.reply == kinds.Voltage(120)
