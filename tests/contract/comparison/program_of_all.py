"""A program that uses all of a library, written by looking at the library alone.

Each statement is an expression by itself, so that one that fails or gives another result says what
is broken. What a statement gives is told in values and names, never in bytes.
"""

import enum
import importlib
import inspect
import math
from collections.abc import Callable, Iterator, Mapping
from itertools import cycle, islice
from types import ModuleType
from typing import Any

from framegen.model.exchanges import snake_case

from tests.handed import handed_by
from tests.lines.timed_line import ScriptedLine, client_on

# What goes with any change, and what is there for the library itself.
_PASSING = {"VENDOR_NAME", "DEPRECATED", "LENGTHS", "FRAME", "IDS", "DEFAULTS", "CONSTANTS"}
_PASSING |= {"SHAPE", "FIELDS"}
_MOST_VALUES = 24


def namespace(made: ModuleType) -> dict[str, Any]:
    """Return the names that a program has of a library, which may stay imported no longer."""
    names: dict[str, Any] = {name: getattr(made, name) for name in vars(made)["__all__"]}
    for module in ("messages", "device", "strategies", "recordings"):
        names[module] = importlib.import_module(f"{made.__name__}.{module}")
    # Some are imported when they are first used.
    client_class = handed_by(made.__name__).client

    def asked(call: Callable[[Any], object], *replies: Any) -> object:
        """Return what a call of the client gives; each frame that it sends gets a reply."""
        frames = (reply.encode() for reply in replies)
        line = ScriptedLine(lambda _: next(frames, b""))
        options = {"baud": math.inf, "local_echo": False}
        with client_on(line, client_class, **options) as client:
            return call(client)

    def handled(handler: str, message: Any, reply: Any) -> object:
        """Return what a handler of the device is given, and what the device then sends."""
        seen: list[Any] = []

        def handle(_device: object, received: Any) -> Any:
            seen.append(received)
            return reply

        device = type("Own", (names["Device"],), {handler: handle})()
        device.accept(message.encode())
        return seen, device.take()

    return {**names, "asked": asked, "handled": handled, "accepted": accepted, "matched": matched}


def accepted(method: Callable[..., object], names: list[str]) -> None:
    """Tell whether a method takes arguments by these names: it raises an error if not."""
    inspect.signature(method).bind(None, **dict.fromkeys(names))


def matched(message: Any, *names: str) -> list[Any]:
    return [getattr(message, name) for name in type(message).__match_args__[: len(names)]]


def run(statement: str, names: dict[str, Any]) -> object:
    try:
        return plain(eval(statement, names))  # noqa: S307 - it is our own
    except Exception as error:  # noqa: BLE001 - whatever a broken program runs into
        return f"raises {type(error).__name__}"


def fails(result: object) -> bool:
    return isinstance(result, str) and result.startswith("raises ")


def plain(value: Any) -> object:
    """Return a value so that it can be compared with one of another library."""
    kind = type(value)
    if isinstance(value, enum.Enum):
        return kind.__name__, value.name
    if hasattr(kind, "SHAPE"):
        return kind.__name__
    if isinstance(value, (float, str)):
        return kind.__name__, repr(value)
    if isinstance(value, (tuple, list)):
        name = "" if kind in (tuple, list) else kind.__name__
        return (name, *map(plain, value))
    return (kind.__name__, value if isinstance(value, int) else None)


def program(made: ModuleType) -> Iterator[str]:
    for kind in made.MESSAGES:
        yield from _of_message(made, kind)
    yield from _of_ends(made)
    for name in vars(made)["__all__"]:
        yield f"isinstance({name}, object)"
        # All messages of an end may be one.
        if inspect.isclass(getattr(made, name)) and getattr(made, name).__name__ == name:
            for each in vars(getattr(made, name)):
                if each[0] != "_" and each not in _PASSING:
                    yield f"isinstance({name}.{each}, object)"
    for name, value in vars(importlib.import_module(f"{made.__name__}.strategies")).items():
        own = getattr(value, "__module__", "") == f"{made.__name__}.strategies"
        if own and inspect.isfunction(value) and not name.startswith("_"):
            yield f"callable(strategies.{name})"


def _of_message(made: ModuleType, kind: Any) -> Iterator[str]:
    name = kind.__name__
    usual = usual_values(kind)
    call = made_by_name(name, usual)
    yield call
    # A field between may only be absent with those behind it.
    given_ = inspect.signature(kind).parameters.values()
    by_place = [each.name for each in given_ if each.kind is each.POSITIONAL_OR_KEYWORD]
    yield f"{name}({', '.join(repr(usual[each]) for each in by_place)}) == {call}"
    yield f"{call} != {call} or hash({call}) == hash({call})"
    yield f"repr({call}) == repr({call})"
    yield f"matched({call}, *{kind.__match_args__!r})"
    yield f"decode({call}.encode(), {name}.DIRECTION)"
    yield f"decode({call}.encode(), None)"
    for each in _attributes(kind):
        yield f"{call}.{each}"
    for each in _constants(kind):
        yield f"{name}.{each}"
    yield from [f"{call}.columns()"] * hasattr(kind, "columns")
    for field, values in {each: _values(kind, each) for each in usual}.items():
        for value in islice(values, _MOST_VALUES):
            changed = made_by_name(name, {**usual, field: value})
            yield f"{changed}.{field}"
            if isinstance(value, list) and value and value != value[:1] * len(value):
                continue
            yield f"decode({changed}.encode(), None)"
            for each in _properties(kind):
                yield f"{changed}.{each}"
    for field in usual:
        yield from _of_elements(getattr(kind, field), f"{call}.{field}")
    given = dict(usual)
    for each in reversed([*usual]):
        if inspect.signature(kind).parameters[each].default is not inspect.Parameter.empty:
            del given[each]
            yield made_by_name(name, given)


def _of_elements(field: Any, listed: str) -> Iterator[str]:
    element = getattr(field, "element", None)
    if element is None:
        return
    yield f"[type(each).__name__ for each in {listed}]"
    for each in element.__match_args__:
        yield f"[each.{each} for each in {listed}]"
    row = tuple(next(_of_number(inner)) for inner in element.FIELDS)
    named = dict(zip(element.__match_args__, row, strict=True))
    yield f"tuple({made_by_name(element.__name__, named)})"
    yield f"tuple({element.__name__}{row!r})"
    for each in _constants(element):
        yield f"{element.__name__}.{each}"
    for inner in element.FIELDS:
        for value in _of_number(inner):
            made = made_by_name(element.__name__, {**named, inner.name: value})
            for each in _properties(element):
                yield f"{made}.{each}"


def _of_ends(made: ModuleType) -> Iterator[str]:
    for way in made.Direction:
        yield f"Direction.{way.name}"
        yield f"StreamDecoder(Direction.{way.name}).feed(b'')"
    exchanges = importlib.import_module(f"{made.__name__}._exchanges")
    handed = handed_by(made.__name__)
    clients = [handed.client.__name__, handed.async_client.__name__]
    for kind, exchange in exchanges.EXCHANGES.items():
        usual = usual_values(kind)
        reply = _reply(exchange, usual)
        replies = "" if reply is None else f", {reply}"
        given = {each: usual[each] for each in exchange.arguments}
        address = getattr(exchange.address, "field", "")
        given = {**({address: usual[address]} if address else {}), **given}
        named = ", ".join(f"{each}={value!r}" for each, value in given.items())
        placed = ", ".join(map(repr, given.values()))
        for arguments in (named, placed):
            yield from _of_result(exchange, f"client.{exchange.method}({arguments}){replies}")
        for limited in _limited(exchanges.LIMITS, kind, usual):
            named = ", ".join(f"{each}={limited[each]!r}" for each in given)
            yield f"isinstance(asked(lambda client: client.{exchange.method}({named})), Sent)"
        handler = f"on_{snake_case(kind.__name__)}"
        call = made_by_name(kind.__name__, usual)
        yield f"callable({clients[1]}.{exchange.method})"
        yield f"handled({handler!r}, {call}, {reply})"
        yield f"callable(Device.{handler})"
    methods = {exchange.method for exchange in exchanges.EXCHANGES.values()}
    for client in (*clients, "OneDevice", "AllDevices"):
        for each, value in vars(getattr(made, client, object)).items():
            if not each.startswith("_"):
                yield f"callable({client}.{each})"
                # What others of a client take is seen where they are called.
                called = client in clients and each in methods
                if inspect.isfunction(value) and not called:
                    yield f"accepted({client}.{each}, {_needed(value)})"


def _needed(function: Any) -> list[str]:
    """Return the names of what a method must be given."""
    empty, (_, *given) = inspect.Parameter.empty, inspect.signature(function).parameters.values()
    named = (inspect.Parameter.POSITIONAL_OR_KEYWORD, inspect.Parameter.KEYWORD_ONLY)
    return [each.name for each in given if each.default is empty and each.kind in named]


def _limited(limits: Any, kind: Any, usual: Mapping[str, Any]) -> Iterator[dict[str, Any]]:
    """Yield values at the limits of what a client sends by default."""
    for path in limits.fields.get(kind, ()):
        name, _, inner = path.partition(".")
        for edge in limits.usual:
            if inner:
                at = getattr(kind, name).element.__match_args__.index(inner)
                row = usual[name][0]
                yield {**usual, name: [(*row[:at], edge, *row[at + 1 :])]}
            else:
                yield {**usual, name: edge}


def _of_result(exchange: Any, call: str) -> Iterator[str]:
    asked = f"asked(lambda client: {call})"
    if exchange.reply is not None:
        yield asked
        return
    yield f"isinstance({asked}, Sent)"
    if exchange.acknowledged is not None:
        yield f"{asked}.started"
    if exchange.lasts is not None:
        yield f"{asked}.lasts"


def _reply(exchange: Any, asked: Mapping[str, Any]) -> str | None:
    """Return an expression for a reply that repeats what it must, and tells of no failure."""
    if exchange.reply is None:
        return None
    usual = usual_values(exchange.reply)
    if exchange.failures.field:
        usual[exchange.failures.field] = exchange.failures.good
    address = getattr(exchange.address, "field", "")
    if address in usual and address in asked:
        usual[address] = asked[address]
    for own, echo in exchange.echoed:
        name, _, inner = echo.partition(".")
        value = asked[own.partition(".")[0]]
        if inner:
            at = getattr(exchange.reply, name).element.__match_args__.index(inner)
            row = usual[name][0] if usual[name] else ()
            usual[name] = [(*row[:at], each, *row[at + 1 :]) for each in value]
        else:
            usual[name] = value
    counted = getattr(exchange.counted, "_asked", "")
    if counted:
        listed = exchange.reply.SHAPE.items.name
        count = asked[counted] if isinstance(asked[counted], int) else len(asked[counted])
        usual[listed] = [*islice(cycle(usual[listed] or (0,)), count)]
    return made_by_name(exchange.reply.__name__, usual)


def made_by_name(name: str, values: Mapping[str, Any]) -> str:
    return f"{name}({', '.join(f'{each}={value!r}' for each, value in values.items())})"


def usual_values(kind: Any) -> dict[str, Any]:
    """Return a value for each argument of a message; None for what no frame of it has room for.

    No two are the same where their fields allow it, so that each is known wherever it stands.
    """
    given = inspect.signature(kind).parameters
    values: dict[str, Any] = {}
    for at, each in enumerate(given):
        usual = [next(_values(kind, each, at + more)) for more in range(len(given))]
        values[each] = next((one for one in usual if one not in values.values()), usual[0])
    for each in reversed(given):
        if not fails(run("kind(**values)", {"kind": kind, "values": values})):
            break
        if given[each].default is None:
            values[each] = None
    return values


def _attributes(kind: Any) -> list[str]:
    found = vars(kind).items()
    return [name for name, each in found if isinstance(each, property) and name[0] != "_"]


def _properties(kind: Any) -> list[str]:
    return [name for name in _attributes(kind) if type(vars(kind)[name]) is property]


def _constants(kind: Any) -> list[str]:
    return [name for name in vars(kind) if name.isupper() and name not in _PASSING]


def _values(kind: Any, name: str, at: int = 0) -> Iterator[Any]:
    """Yield values at the edges of a field, first the usual one, which is not that of another."""
    field = getattr(kind, name)
    if hasattr(field, "number"):
        yield from _of_number(field.number, at)
    elif hasattr(field, "element"):
        yield from _of_list(field)
    elif hasattr(field, "bits_each"):
        for each in (min(field.low + 1, field.high), field.low, field.high):
            yield [each] * field.length
    else:
        yield from _of_number(field, at)


def _of_list(field: Any) -> Iterator[Any]:
    def rows() -> Iterator[Any]:
        edges = [[*_of_number(each, at)] for at, each in enumerate(field.fields)]
        usual = tuple(each[0] for each in edges)
        yield usual
        for at, values in enumerate(edges):
            for value in values:
                yield (*usual[:at], value, *usual[at + 1 :])

    def element(row: Any) -> Any:
        return row[0] if field.element is None else row

    every = [element(row) for row in rows()]
    least, most = field.least, field.most
    usual = max(least, min(2, most))
    yield [every[0]] * usual
    for count in dict.fromkeys((least, most, *range(least + 1, least + 5))):
        if count <= most:
            yield [every[0]] * count
    for one in every[1:]:
        if usual:
            yield [*[every[0]] * (usual - 1), one]


def _of_number(field: Any, at: int = 0) -> Iterator[Any]:
    if type(field).__name__.endswith(("F32", "F64")):
        yield from (1.5 + at, 0.0, -0.25)
    elif hasattr(field, "least"):
        least, most = field.least or 0, field.most
        yield "Ab"[:most].ljust(least, "x")
        yield "x" * least
        yield "~" * most
    else:
        low, high = field.low, field.high
        others = [*field.names.values(), *field.bits.values()]
        found = [min(low + 1 + at, high), low, high, *others]
        yield from dict.fromkeys(
            each for each in found if low <= each <= high or each in field.others
        )
