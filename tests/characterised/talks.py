"""Rows of what a client does on a line in virtual time, and of the other end: the Device."""

from __future__ import annotations

import re
from functools import partial
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

from framewire.simulator.virtual_loop import run_virtual

from tests.characterised.texts import lines, outcome, told
from tests.characterised.values import by_message, frames_of
from tests.lines.every_method import _argument, _made, _reply
from tests.lines.timed_line import TimedLine

if TYPE_CHECKING:
    from collections.abc import Callable
    from types import ModuleType

    from framegen.model.exchanges import Exchange
    from framegen.model.model import Model

    from tests.characterised.texts import Rows

BAUD = 9600
# How the client is made, where a case needs it in another way than usual.
ECHO = {"local_echo": True}
SETTINGS: dict[str, dict[str, Any]] = {"silent": {"retries": 1}, "echo": ECHO, "no echo": ECHO}


def reply_to(made: ModuleType, model: Model, data: bytes) -> bytes:
    """Return what the documents say that a device replies to requests."""
    by_kind = {getattr(made, each.request.name): each for each in model.exchanges}
    decoder = made.StreamDecoder(next((kind.DIRECTION for kind in by_kind), None))
    asked = [(by_kind.get(type(it)), it) for it in decoder.feed(data) + decoder.flush()]
    replies = [_reply(made, way, way.reply, it) for way, it in asked if way and way.reply]
    return b"".join(each.encode() for each in replies)


def _replies(made: ModuleType, model: Model, exchange: Exchange, data: bytes) -> dict[str, bytes]:
    """Return the bytes that come for a request, in each case."""
    usual = reply_to(made, model, data)
    others = [each.reply.message.examples[-1].hex for each in model.exchanges if each.reply]
    refused = exchange.refusal.message.examples[0].hex if exchange.refusal else usual
    if exchange.failure is not None and exchange.reply is not None:
        values = {**exchange.reply.message.examples[0].values}
        values[exchange.failure.name] = exchange.good + 1
        refused = _made(made, exchange.reply, values).encode()
    return {
        **dict.fromkeys(["answered", "no echo", "odd", "limited"], usual),
        **dict.fromkeys(["echo", "unsaid echo"], data + usual),
        "silent": b"",
        "garbled": usual[:-1] + bytes([usual[-1] ^ 0xFF]) if usual else b"\xff",
        "cut": usual[:-1],
        "noisy": b"\x00\x55\xff" + usual,
        "twice": usual * 2,
        "refused": refused,
        "other": others[0] if others else b"",
    }


def client_rows(made: ModuleType, model: Model) -> Rows:
    for exchange in model.exchanges:
        cases = _replies(made, model, exchange, b"")
        for kind, way in ((made.Controller, ""), (made.AsyncController, "async-")):
            texts = (_talk(made, model, exchange, case, kind) for case in cases)
            yield f"client/{way}{exchange.method.name}", lines(texts)


def _talk(made: ModuleType, model: Model, exchange: Exchange, case: str, kind: Any) -> str:
    line = _line(lambda data: _replies(made, model, exchange, data)[case])
    values = exchange.request.message.examples[0].values
    given = [_argument(exchange.request, each, values[each]) for each in exchange.arguments]
    if case in {"odd", "limited"}:
        given = [_with(each, "x" if case == "odd" else 2000) for each in given]
    client = _client(kind, line, **SETTINGS.get(case, {}))
    call = partial(_call, client, exchange, given, values)
    result = outcome(_called, client, call, None if kind is made.Controller else line.timer)
    return f"{case}: {result} {_state(client, line)}"


def _line(answer: Callable[[bytes], bytes]) -> TimedLine:
    """Return a line on which an answer takes its time on the wire, and a moment."""

    def timed(data: bytes) -> list[tuple[float, bytes]]:
        reply = answer(data)
        return [((len(data) + len(reply)) * 10 / BAUD + 0.001, reply)] if reply else []

    return TimedLine(timed)


def _client(kind: Any, line: TimedLine, **more: Any) -> Any:
    settings = {"baud": BAUD, "reply_timeout": 0.2, "local_echo": False, **more}
    return kind(line, clock=line.clock, background=False, **settings)


def _state(client: Any, line: TimedLine) -> str:
    return f"{b'|'.join(line.written).hex(' ')} {client.counters!r} {line.now:.4f} s, {client!r}"


def _called(client: Any, call: Callable[[], Any], timer: Any) -> Any:
    async def talk() -> Any:
        async with client:
            return await call()

    if timer is not None:
        return run_virtual(talk(), timer)
    with client:
        return call()


def _call(client: Any, exchange: Exchange, given: list[Any], values: dict[str, Any]) -> Any:
    """Call the method of an exchange, of one device or all where devices have addresses."""
    name, address = exchange.method.name, exchange.address
    if address is not None and values[address.name] not in exchange.silent.values():
        return getattr(client.device(given[0]), name)(*given[1:])
    if address is not None and exchange.reply is not None:
        return getattr(client.broadcast(), name)(*given[1:], within=0.1)
    return getattr(client, name)(*given)


def _with(value: Any, other: Any) -> Any:
    """Return a value with another in the place of each number."""
    is_list = isinstance(value, (list, tuple))
    return type(value)(_with(each, other) for each in value) if is_list else other


def session_rows(made: ModuleType, model: Model, vectors: dict[str, Any]) -> Rows:
    for name, (message, *_) in by_message(made, vectors).items():
        yield f"session/{name}", _session(made, model, message)
    line = _line(partial(reply_to, made, model))
    names = [each for each in dir(made.Controller) if each.startswith(("hold_", "present_"))]
    with _client(made.Controller, line) as client:
        texts = [f"{each}: {outcome(getattr(client, each), [1, 2])}" for each in names]
    yield "session/pose", lines([*texts, _state(client, line)])
    with _client(made.Controller, line, trace="trace.hex") as client:
        line.say(b"\xff\xff", 0.05)
        for message, *_ in by_message(made, vectors).values():
            outcome(client.request, message)
    yield "session/trace", re.sub(r" from .* on\n", "\n", Path("trace.hex").read_text("utf-8"))
    entries = import_module(f"{made.__name__}.recordings").read("trace.hex")
    yield "session/trace-read", lines(told(each.event) for each in entries)


def _session(made: ModuleType, model: Model, message: Any) -> str:
    """Return what a client makes of reports, and of a message that it is to send."""
    line = _line(partial(reply_to, made, model))
    heard: list[str] = []
    with _client(made.Controller, line) as client:
        stop = client.on_report(lambda report: heard.append(f"heard {report!r}"))
        for data, delay in ((message, 0.05), (b"\xff\x00", 0.06), (message, 0.1)):
            line.say(data, delay)
        heard.append(outcome(client.wait_for, type(message), timeout=0.2))
        heard.append(outcome(lambda: list(client.reports(timeout=0.2))))
        heard += [outcome(it, message) for it in (client.send_latest, client.send, client.request)]
        heard += [outcome(client.request, message, retries=1), outcome(stop)]
    return lines([*heard, outcome(client.send, message), _state(client, line)])


def device_rows(made: ModuleType, vectors: dict[str, Any]) -> Rows:
    noted: list[str] = []

    def note(_self: Any, what: Any) -> None:
        noted.append(told(what))

    device = type("Noted", (made.Device,), {"accepted": note, "rejected": note})()
    for frame in frames_of(vectors):
        noted += [told(device.receive(each)) for each in (frame, frame[:-1], b"\x00" + frame)]
        noted += [outcome(device.quiet), told(device.rejects)]
    for messages in by_message(made, vectors).values():
        noted += [outcome(device.send, each) for each in messages]
    yield "device/whatever-comes", lines([*noted, told(device.take())])
