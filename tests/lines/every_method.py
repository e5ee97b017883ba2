"""A library's client and its own device, connected: every method is called, and answered."""

from types import ModuleType
from typing import Any

from framegen.model.exchanges import Exchange
from framegen.model.layout import MessageLayout
from framegen.model.model import Model
from framegen.model.slots import Items, Number

from tests.lines.timed_line import TimedLine


class Line(TimedLine):
    """A line with a device at its end; bytes take their time on the wire."""

    def __init__(self, device: Any, seconds_per_byte: float) -> None:
        super().__init__()
        self.device = device
        self._per_byte = seconds_per_byte
        self._free = 0.0

    def write(self, data: bytes) -> None:
        self._free = max(self._free, self.now) + len(data) * self._per_byte
        answer = self.device.receive(data)
        # Nothing more is asked before the reply, so that no frame is the beginning of a longer one.
        self.device.quiet()
        answer += b"".join(report.encode() for report in self.device.take())
        if answer:
            self._free += len(answer) * self._per_byte + 0.001
            self.say(answer, self._free - self.now)

    def drain(self, timeout: float) -> None:
        self.now += timeout


def converse(made: ModuleType, model: Model) -> None:
    """Let the client of `made` call each method with each example, and its device answer.

    `model` is in the names of the library.
    """
    _both_ways(made, model)
    converse_alone(made, model)


def converse_alone(made: ModuleType, model: Model) -> None:
    """Do so without a look at the frames of the examples."""
    device = _device(made, model)
    spent = made._library.LINK.bits_per_byte / made._library.LINK.baud
    line = Line(device, spent)
    # However slow the line is, and whatever is sent in front of a reply: it will come.
    settings = {"reply_timeout": 9e9, "clock": line.clock, "background": False}
    settings["local_echo"] = False
    with made.Controller(line, limits=None, **settings) as client:
        for exchange in model.exchanges:
            for example in exchange.request.message.examples[:4]:
                _ask(made, client, device, exchange, example.values)
    assert device.noise == []


def _both_ways(made: ModuleType, model: Model) -> None:
    """Check that every example, of either end, is the frame of its message."""
    for name, layout in model.messages.items():
        kind = getattr(made, name)
        for example in layout.message.examples:
            message = _made(made, layout, example.values)
            assert message.encode() == example.hex
            assert made.decode(example.hex, kind.DIRECTION) == message


def _ask(
    made: ModuleType, client: Any, device: Any, exchange: Exchange, values: dict[str, Any]
) -> None:
    names, request = exchange.arguments, exchange.request
    arguments = [_argument(request, name, values[name]) for name in names]
    address = exchange.address
    silent = address is not None and values[address.name] in exchange.silent.values()
    if silent and exchange.reply is not None:
        result = getattr(client.broadcast(), exchange.method.name)(*arguments[1:], within=0.01)
    elif address is not None and not silent:
        result = getattr(client.device(arguments[0]), exchange.method.name)(*arguments[1:])
    else:
        result = getattr(client, exchange.method.name)(*arguments)
    sent = _made(made, exchange.request, values)
    if exchange.counter is not None:
        number = getattr(device.requests[-1], exchange.counter.name)
        sent = sent.__replace__(**{exchange.counter.name: number})
    assert device.requests[-1] == sent
    if silent and exchange.reply is not None:
        assert result == []
    elif exchange.reply is not None:
        reply = device.said[-1]
        assert result == (
            getattr(reply, exchange.method.result) if exchange.method.result else reply
        )


def _device(made: ModuleType, model: Model) -> Any:
    """Return a device that answers as the spec says."""
    requests: list[Any] = []
    said: list[Any] = []
    noise: list[Any] = []

    def handler(exchange: Exchange) -> Any:
        def handle(device: Any, message: Any) -> Any:
            requests.append(message)
            for name in exchange.reports:
                device.send(_report(made, model.messages[name], message))
            if exchange.reply is None:
                return None
            said.append(_reply(made, exchange, exchange.reply, message))
            return said[-1]

        return handle

    handlers = {f"on_{_snake(made, each)}": handler(each) for each in model.exchanges}
    kind = type("Answering", (made.Device,), handlers)
    for name in handlers:
        assert hasattr(made.Device, name), name
    device = kind()
    device.requests, device.said, device.noise = requests, said, noise
    device.rejected = noise.append
    return device


def _snake(made: ModuleType, exchange: Exchange) -> str:
    handlers = dict(made.Device._handlers)
    name: str = handlers[getattr(made, exchange.request.name)]
    return name.removeprefix("on_")


def _report(made: ModuleType, layout: MessageLayout, request: Any) -> Any:
    """Return a report with the values of the request, for fields that both have."""
    values = dict(layout.message.examples[0].values)
    for slot in layout.arguments:
        if isinstance(slot, Number):
            requested = getattr(request, slot.name, values[slot.name])
            if isinstance(requested, int) and slot.low <= requested <= slot.high:
                values[slot.name] = requested
    return _made(made, layout, values)


def _reply(made: ModuleType, exchange: Exchange, layout: MessageLayout, request: Any) -> Any:
    """Return the reply of an example, with the values that it must repeat."""
    values = dict(layout.message.examples[0].values)
    if exchange.failure is not None:
        values[exchange.failure.name] = exchange.good
    if exchange.counted is not None:
        asked = {exchange.asks_for: getattr(request, exchange.asks_for)}
        values = exchange.with_count(asked, values)
    address = layout.frame.address
    if exchange.address is not None and address is not None:
        asked = getattr(request, exchange.address.name)
        values[address.name] = asked if address.holds(asked) else address.low
    for source, target in exchange.echoed:
        outer, _, inner = target.partition(".")
        value = _at(request, source)
        if not inner and not isinstance(value, tuple):
            values[outer] = value
        elif not inner:
            values[outer] = list(value)
        elif layout.items is not None:
            numbers = (each for each in layout.items.fields if isinstance(each, Number))
            blank = {field.name: field.low for field in numbers}
            items = values[outer] if isinstance(values[outer], list) else []
            elements = value if isinstance(value, tuple) else (value,)
            values[outer] = [
                {**(items[at] if at < len(items) else blank), inner: each}
                for at, each in enumerate(elements)
            ]
    return _made(made, layout, values)


def _at(message: Any, path: str) -> Any:
    outer, _, inner = path.partition(".")
    value = getattr(message, outer)
    return tuple(getattr(each, inner) for each in value) if inner else value


def _made(made: ModuleType, layout: MessageLayout, values: dict[str, Any]) -> Any:
    given = {name: _argument(layout, name, value) for name, value in values.items()}
    return getattr(made, layout.name)(**given)


def _argument(layout: MessageLayout, name: str, value: Any) -> Any:
    """Return a value of an example as users give it: elements as tuples, in frame order."""
    slot = next(each for each in layout.arguments if each.name == name)
    if not isinstance(slot, Items) or slot.element is None:
        return value
    return [tuple(each[field.name] for field in slot.fields) for each in value]
