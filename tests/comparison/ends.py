"""The ends of a line as they are generated: the client of one edition, the device of another."""

from __future__ import annotations

import importlib
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from framegen.comparison.conversation.play import OTHER, Table
from framegen.comparison.edges import values_to_try
from framegen.compile import Compiled
from framegen.language.spec import Example
from framegen.model.codec import encode
from framegen.model.model import derive
from framegen.render import render_target
from framegen.targets import python

from tests.device_line import DeviceLine
from tests.factories import library
from tests.protocols.libraries import made_of

if TYPE_CHECKING:
    from collections.abc import Iterator
    from types import ModuleType

    from framegen.comparison.conversation.play import Play
    from framegen.comparison.edition import Edition
    from framegen.comparison.effect import Which
    from framegen.comparison.pair import Pair

# Virtual seconds in which all comes that may come.
LONG = 5.0


@dataclass(frozen=True)
class Seen:
    """What a program has really seen of a request, in the words of the comparison."""

    ending: str
    rest: frozenset[str]


class Ends:
    """The libraries of two editions, each under a name of its own."""

    def __init__(self, until: ExitStack, pair: Pair) -> None:
        self._until = until
        self.pair = pair
        self._made: dict[Which, ModuleType] = {}

    def library(self, which: Which) -> ModuleType:
        """Return the library of an edition, made when it is first asked for."""
        if which not in self._made:
            files = _library_files(self.pair.edition(which), which)
            self._made[which] = self._until.enter_context(library(files))
        return self._made[which]

    def part(self, which: Which, name: str) -> Any:
        """Return a module of the library of an edition."""
        return importlib.import_module(f"{self.library(which).__name__}.{name}")

    def exchange(self, which: Which, kind: type) -> Any:
        """Return the exchange of a request, as the library of an edition has it."""
        return self.part(which, "_client.exchanges").EXCHANGES[kind]

    @contextmanager
    def client(self, which: Which, device: Any, **settings: Any) -> Iterator[Any]:
        """Return a client of an edition on a line to a device; nothing in it sleeps."""
        line = settings.pop("line", DeviceLine(device))
        given = {"background": False, "clock": line.clock, "settle": 0, "limits": None, **settings}
        with self.library(which).Controller(line, **given) as client:
            yield client

    def seen(self, play: Play, device: Which) -> Seen:
        """Play it with the libraries: the device answers as its own library says that it does."""
        made, client = self.library(device), play.client
        there = made.Device()
        answers = iter(play.answers)

        def answer(request: Any) -> Any:
            exchange = self.exchange(device, type(request))
            wanted = next(answers)
            kind = exchange.failures.refusal if play.kind == "refusal" else exchange.reply
            silent = exchange.address.silence(request)
            answering = "" if kind is None or silent else kind.__name__
            assert wanted.message in (answering, ""), "the device answers otherwise"
            if wanted.values is None:
                assert not answering or "cannot repeat" in wanted.why
                return None
            layout = self.pair.edition(device).model.messages[wanted.message]
            said = made_of(made, layout, wanted.values)
            assert exchange.answers(request, said), "it is not what the device was asked"
            failed = exchange.failures.error(request, said) is not None
            assert failed is (play.kind != "reply") or exchange.failures.refusal is not kind
            return said

        handlers = self.part(device, "device")._HANDLERS
        for name in handlers.values():
            setattr(there, name, answer if name in self._asked(device) else _nothing)
        with self.client(client, there) as controller:
            request = made_of(self.library(client), play.exchange.request, play.values)
            return self._ends(client, controller, request)

    def acknowledged(self, client: Which, device: Which, values: dict[str, Any]) -> bool:
        """Tell whether an ActionGroupRun is acknowledged by what the device promises."""
        there = self.library(device).Device()

        def run(request: Any) -> None:
            kind = self.exchange(device, type(request)).acknowledged
            if kind is not None:
                there.send(kind(*(getattr(request, name) for name in kind.__match_args__)))

        there.on_action_group_run = run
        with self.client(client, there) as controller:
            sent = controller.send(self.library(client).ActionGroupRun(**values))
            for _ in controller.reports(timeout=LONG):
                pass
            return sent.started is True

    def reported(self, client: Which, device: Which, message: str) -> bool:
        """Tell whether a client gives its program a message that the device sends by itself."""
        there = self.library(device).Device()
        layout = self.pair.edition(device).model.messages[message]
        values = next(iter(values_to_try(layout, None, {}, pairs=False)))
        with self.client(client, there) as controller:
            there.send(made_of(self.library(device), layout, values))
            return bool([*controller.reports(timeout=LONG)])

    def _asked(self, which: Which) -> set[str]:
        handlers = self.part(which, "device")._HANDLERS
        exchanges = self.part(which, "_client.exchanges").EXCHANGES
        return {handlers[kind] for kind in exchanges}

    def _ends(self, which: Which, controller: Any, request: Any) -> Seen:
        made = self.library(which)
        exchange = self.exchange(which, type(request))
        if exchange.reply is None:
            controller.send(request)
            ending = "sent"
        elif exchange.address.silence(request):
            try:
                controller.request(request)
            except made.EncodeError:
                ending = "unasked"
            controller.send(request)
        else:
            ending = _ending(made, controller, exchange, request)
        reports = [*controller.reports(timeout=LONG)]
        counters = controller.counters
        rest = {"report": bool(reports), "dropped": counters.unsolicited, "noise": counters.noise}
        return Seen(ending, frozenset(name for name, came in rest.items() if came))


def differing(ends: Ends, messages: set[str] | None = None) -> list[Play]:
    """Return the plays of requests, of all or of those named, that really end otherwise.

    Of those that end alike for the same reason, the first is played.
    """
    table = Table(ends.pair)
    found: list[Play] = []
    sides: tuple[Which, Which] = ("old", "new")
    for client in sides:
        for name, exchange in table.clients[client].exchanges.items():
            if messages is not None and name not in messages:
                continue
            plays: dict[Any, Play] = {}
            for play in table.plays(client, exchange):
                answers = tuple(each.message for each in play.answers)
                way = (play.kind, play.ending, play.seen.rest, play.read_as, answers)
                plays.setdefault(way, play)
            found += [
                play
                for play in plays.values()
                if ends.seen(play, OTHER[client]) != Seen(play.ending, frozenset(play.seen.rest))
            ]
    return found


def _ending(made: Any, controller: Any, exchange: Any, request: Any) -> str:
    """Return how a question ends."""
    errors = [getattr(made, name, None) for name in ("RefusedError", "FailureError")]
    try:
        reply = controller.request(request)
    except made.NoReplyError:
        return "timeout"
    except made.ProtocolError as error:
        for kind, ending in zip(errors, ("refusal", "failure"), strict=True):
            if kind is not None and isinstance(error, kind):
                return ending
        raise
    return "partial" if [*exchange.missing(request, reply)] else "reply"


class EchoLine(DeviceLine):
    """A line that also gives back what is sent."""

    def __init__(self, device: Any) -> None:
        super().__init__(device)
        self._back = b""

    def read(self, timeout: float) -> bytes:
        back, self._back = self._back, b""
        return back + super().read(0.0 if back else timeout)

    def write(self, data: bytes) -> None:
        self._back += data
        super().write(data)


def _nothing(_message: Any) -> None:
    return None


def _library_files(edition: Edition, which: Which) -> dict[str, str]:
    """Return the library of an edition under a name of its own: its modules name no package."""
    name = edition.spec.protocol.name
    made = render_target(python.TARGET, _with_examples(edition))
    return {path.replace(f"/{name}/", f"/{name}_{which}/"): text for path, text in made.items()}


def _with_examples(edition: Edition) -> Compiled:
    """Return an edition with an example of every message, which a library shows."""
    messages = {}
    for name, layout in edition.model.messages.items():
        values = next(iter(values_to_try(layout, None, {}, pairs=False)))
        frame = encode(layout, values).hex(" ")
        made = {"title": "Made up", "hex": frame, "values": values, "constructed": "made up"}
        example = Example.model_validate(made)
        messages[name] = layout.message.model_copy(update={"examples": [example]})
    spec = edition.spec.model_copy(update={"messages": messages})
    before = edition.compiled
    return Compiled(before.source, before.tree, [], spec, derive(spec))


@contextmanager
def ends_of(pair: Pair) -> Iterator[Ends]:
    """Return the generated ends of two editions, and forget them again."""
    with ExitStack() as until:
        yield Ends(until, pair)
