"""A library at work, whatever its names are: its messages, its strategies, its client."""

import importlib
import re
from types import ModuleType
from typing import Any

from framegen.compile import Compiled
from framegen.explain import explain
from framegen.model.exchanges import snake_case
from framegen.model.layout import MessageLayout
from framegen.model.model import Model
from framegen.targets.python.names import names_of, strategy_name
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st

from tests.factories import library, library_files
from tests.lines.timed_line import client_of


def at_work(compiled: Compiled) -> None:
    """Import a library, and have all of it work."""
    with library(library_files(compiled)) as made:
        examples_work(made, compiled.model)
        if any(not _NUMBERED.fullmatch(name) for name in compiled.model.messages):
            strategies_work(made)
        methods_work(made, compiled.model)
        reports_work(made, compiled.model)


def plain(value: Any) -> Any:
    """Return a value of an example as the library takes it."""
    if isinstance(value, list):
        return [tuple(each.values()) if isinstance(each, dict) else each for each in value]
    return value


def made_of(lib: ModuleType, model: Model, message: MessageLayout) -> Any:
    names = names_of(model)
    values = names.values(message.name, message.message.examples[0].values)
    kind = getattr(lib, names.of("message", message.name))
    return kind(**{name: plain(value) for name, value in values.items()})


def examples_work(lib: ModuleType, model: Model) -> None:
    """Make the first example of every message, and read it in every way that there is."""
    every = [made_of(lib, model, message) for message in model.messages.values()]
    # All in one expression, since each costs as much to compile.
    assert eval(repr(every), vars(lib.messages)) == every  # noqa: S307 - it is our own
    for message, made in zip(model.messages.values(), every, strict=True):
        assert made.encode() == message.message.examples[0].hex
        read = lib.decode(made.encode(), made.DIRECTION)
        assert read == made
        assert {name: getattr(read, name) for name in read.__match_args__} == {
            name: getattr(made, name) for name in made.__match_args__
        }
        assert type(made).from_dict(made.to_dict()) == made
        data, names = _cells(made)
        assert bytes.fromhex("".join(data)) == made.encode()
        rows = explain(model, made.encode(), [message.direction]).readings[0].rows
        head, tail = len(message.frame.head), len(message.frame.tail)
        given = [slot.name for slot in message.frame.given]
        around = [row.path for row in (*rows[:head], *rows[len(rows) - tail :])]
        shown = [*names[:head], *names[len(names) - tail :]]
        assert [one for one, name in zip(shown, around, strict=True) if name not in given] == [
            name for name in around if name not in given
        ]


def _cells(message: Any) -> tuple[list[str], list[str]]:
    rows = re.findall(r"<tr>(.*?)</tr>", message._repr_html_())
    names, data, *_ = (re.findall(r"<t[hd][^>]*>(.*?)</t[hd]>", row) for row in rows)
    return data, names


def methods_work(lib: ModuleType, model: Model) -> None:
    """Call every method of the client with an example, which the device answers."""
    names = names_of(model)
    device = lib.Device()
    received: list[Any] = []
    device.accepted = received.append
    pairs = [*zip(names.library.exchanges, model.exchanges, strict=True)]
    replied = ((exchange.request.name, author.reply) for exchange, author in pairs)
    replies = {name: made_of(lib, model, each) for name, each in replied if each is not None}
    for request, reply in replies.items():
        setattr(device, f"on_{snake_case(request)}", lambda _message, reply=reply: reply)
    with client_of(device) as controller:
        for exchange, author in pairs:
            message = made_of(lib, model, author.request)
            given = {name: getattr(message, name) for name in message.__match_args__}
            returned = getattr(controller, exchange.method.name)(**given)
            assert received.pop() == message
            if exchange.method.result:
                reply = replies[exchange.request.name]
                assert returned == getattr(reply, exchange.method.result)


def reports_work(lib: ModuleType, model: Model) -> None:
    """Wait for every report of the device, by all of its numbers."""
    device = lib.Device()
    with client_of(device) as controller:
        for message in model.sent(model.roles.received):
            if model.kind(message.name) == "reply":
                continue
            report = made_of(lib, model, message)
            values = {name: getattr(report, name) for name in report.__match_args__}
            wanted = {name: each for name, each in values.items() if isinstance(each, int)}
            device.send(report)
            assert controller.wait_for(type(report), timeout=1, **wanted) == report


def strategies_work(lib: ModuleType) -> None:
    """Generate one of every message."""
    strategies = importlib.import_module(f"{lib.__name__}.strategies")
    each = [getattr(strategies, strategy_name(kind.__name__))() for kind in lib.MESSAGES]
    drawn = [
        one for at in range(0, len(each), _AT_ONCE) for one in _drawn(each[at : at + _AT_ONCE])
    ]
    assert [*map(type, drawn)] == [*lib.MESSAGES]
    assert {"messages", "noise", "noisy_streams"} <= {*vars(strategies)}


def _drawn(strategies: list[st.SearchStrategy[Any]]) -> list[Any]:
    """Return what each of them makes: any will do, so that none needs to be made smaller."""
    found: list[Any] = []

    @settings(max_examples=1, phases=[Phase.generate], suppress_health_check=[*HealthCheck])
    @given(st.tuples(*strategies))
    def draw(some: tuple[Any, ...]) -> None:
        found[:] = some

    draw()
    return found


# Messages of which nothing but their fields has a name of its own.
_NUMBERED = re.compile(r"(?:Call|Valued|Flagged|Said)\d+")
# Hypothesis has an opinion on examples that are larger.
_AT_ONCE = 400
