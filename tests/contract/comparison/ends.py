"""The ends of a line as they are generated: the client of one edition, the device of another."""

import importlib
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from itertools import chain
from types import ModuleType
from typing import Any

from framegen.comparison.conversation.exchange_effects import Verdict, verdicts
from framegen.comparison.conversation.play import OTHER, Play, Table
from framegen.comparison.edges import values_to_try
from framegen.comparison.edition import Edition
from framegen.comparison.effect import Which
from framegen.comparison.pair import Pair
from framegen.compile import Compiled
from framegen.language.spec import Example
from framegen.model.codec import encode
from framegen.model.exchanges import Exchange
from framegen.model.model import derive
from framegen.render import render_target
from framegen.targets import python

from tests.factories import library
from tests.handed import handed_by
from tests.lines.timed_line import DeviceLine, client_on
from tests.protocols.libraries import made_of

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
        if which not in self._made:
            files = _library_files(self.pair.edition(which), which)
            self._made[which] = self._until.enter_context(library(files))
        return self._made[which]

    def part(self, which: Which, name: str) -> Any:
        return importlib.import_module(f"{self.library(which).__name__}.{name}")

    def exchange(self, which: Which, kind: type) -> Any:
        return self.part(which, "_exchanges").EXCHANGES[kind]

    @contextmanager
    def client(self, which: Which, device: Any, *, echo: bool = False) -> Iterator[Any]:
        line = DeviceLine(device, echo=echo)
        with client_on(line, handed_by(self.library(which).__name__).client, limits=None) as client:
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

        handlers = dict(self.part(device, "device").Device._handlers)
        for name in handlers.values():
            setattr(there, name, answer if name in self._asked(device) else _nothing)
        # Who expects an echo is on a line that has one: what becomes of it is no matter of plays.
        echoes = self.pair.edition(client).spec.link.local_echo
        with self.client(client, there, echo=echoes) as controller:
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
        handlers = dict(self.part(which, "device").Device._handlers)
        exchanges = self.part(which, "_exchanges").EXCHANGES
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


@dataclass(frozen=True)
class Scene:
    """A play of the comparison, and how it really ends: now, and between two old ends.

    What two old ends cannot say has no `was`.
    """

    play: Play
    now: Seen
    was: Seen | None

    @property
    def is_as_said(self) -> bool:
        """Tell whether it ends as the comparison says, and ended so before."""
        before = self.play.before
        return self.now == _said(self.play) and self.was == (before and _said(before))

    @property
    def is_lost(self) -> bool:
        """Tell whether a program got what it should, and gets it no longer."""
        good = _GOOD[self.play.kind]
        return self.was is not None and self.was.ending in good and self.now.ending not in good


# How a request may end for which a device gives an answer of each kind.
_GOOD = {
    "reply": {"reply", "sent"},
    "refusal": {"refusal", "sent", "unasked"},
    "failure": {"failure", "sent", "unasked"},
}


def scenes(ends: Ends, table: Table, client: Which, exchange: Exchange) -> list[Scene]:
    """Play an exchange; of what ends alike for the same reason, the first is played."""
    plays: dict[Any, Play] = {}
    for play in table.plays(client, exchange):
        before = play.before
        was = None if before is None else (before.ending, before.seen.rest, before.read_as)
        answers = tuple(each.message for each in play.answers)
        way = (play.kind, play.ending, play.seen.rest, play.read_as, answers, was)
        plays.setdefault(way, play)
    found: list[Scene] = []
    for play in plays.values():
        old = None if play.before is None else ends.seen(play.before, "old")
        found.append(Scene(play, ends.seen(play, OTHER[client]), old))
    return found


def differing(ends: Ends, messages: set[str] | None = None) -> list[Scene | Exchange]:
    """Return what is really otherwise of requests, of all or of those named.

    These are plays that end otherwise, and exchanges that break without being said to, or that are
    said to break and do not.
    """
    table = Table(ends.pair)
    found: list[Scene | Exchange] = []
    sides: tuple[Which, Which] = ("old", "new")
    for client in sides:
        for name, exchange in table.clients[client].exchanges.items():
            if messages is None or name in messages:
                played = scenes(ends, table, client, exchange)
                found += [each for each in played if not each.is_as_said]
                said = (each.breaks for each in verdicts(table, client, exchange) if _is_lost(each))
                if any(said) is not _breaks(table, client, exchange, played):
                    found.append(exchange)
    return found


def _breaks(table: Table, client: Which, exchange: Exchange, played: list[Scene]) -> bool:
    """Tell whether a program loses something, or all that both editions know of an exchange."""
    answered = [scene for scene in played if scene.play.kind == "reply"]
    endings = [scene.now.ending for scene in answered if scene.now.ending != "unasked"]
    is_dead = bool(endings) and set(endings) == {"timeout"}
    if client == "new" and _is_told_first(table.pair, exchange):
        # What answers it may have come unasked before: it is lost where the request is not read.
        return any(scene.is_lost for scene in played if not scene.play.read_as)
    known = table.other(client, exchange) is not None
    return any(scene.is_lost for scene in played) or (known and is_dead)


def _is_told_first(pair: Pair, exchange: Exchange) -> bool:
    """Tell whether the old edition has the answer to a command, and says nowhere when it comes."""
    messages = pair.old.spec.messages
    request, reply = exchange.request.name, exchange.reply
    before = messages.get(pair.messages.to_old.get(request, ""))
    name = None if reply is None else pair.messages.to_old.get(reply.name)
    if before is None or before.reply is not None or name is None:
        return False
    linked = ((each.reply, each.refusal, each.acknowledged) for each in messages.values())
    reports = {report for each in messages.values() for report in each.reports}
    return name not in {*chain.from_iterable(linked), *reports}


def _is_lost(verdict: Verdict) -> bool:
    """Tell whether a verdict is about what is lost, and not about what comes besides."""
    return verdict.outcome != "unawaited"


def _said(play: Play) -> Seen:
    return Seen(play.ending, frozenset(play.seen.rest))


def _ending(made: Any, controller: Any, exchange: Any, request: Any) -> str:
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


def _nothing(_message: Any) -> None:
    return None


def _library_files(edition: Edition, which: Which) -> dict[str, str]:
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
    with ExitStack() as until:
        yield Ends(until, pair)
