"""What the command says of a protocol: the verbs of its messages, and examples of its own verbs."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, TypeAlias

from framegen.language.command_verbs import OF_POSES, STOP, VERBS
from framegen.model.exchanges import snake_case
from framegen.model.slots import Items
from framegen.targets.python.escape import Bracketed, Text, literal
from framegen.targets.python.message_view import MessageView

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from framegen.model.exchanges import Exchange
    from framegen.model.model import Model

# Arguments of an example, and what it does.
_Line: TypeAlias = tuple[str, str]


@dataclass(frozen=True)
class CommandView:
    """The command: each property is an argument of `Program`, as code where it is no text."""

    model: Model

    @property
    def summary(self) -> str:
        return f"Send, read and replay frames of: {self.model.spec.protocol.title}."

    @property
    def has(self) -> str:
        """What the command's own verbs need."""
        needs = {
            "poses": self._has_poses,
            "requests": bool(self.model.exchanges),
            "queries": any(each.reply for each in self.model.exchanges),
        }
        found = [literal(what) for what, is_there in needs.items() if is_there]
        return Bracketed("has=(", found, ")", lone=",").fitted(4, last=",")

    @property
    def verbs(self) -> str:
        """The verbs that were chosen for messages, each with what it is for and an example."""
        return self._described("verbs", is_chosen=True)

    @property
    def method_verbs(self) -> str:
        """The verbs that are named after methods."""
        return self._described("method_verbs", is_chosen=False)

    def _described(self, name: str, *, is_chosen: bool) -> str:
        return _dict(
            name,
            [
                _pair(f"{literal(each.verb)}: (", (_summary(each), _arguments(each, self.model)))
                for each in self._sent.values()
                if each is not self._stop and is_chosen == bool(each.request.message.verb)
            ],
        )

    @property
    def methods(self) -> str:
        """The message of each verb but for those about positions."""
        others = {self.stop_message, *self._about_positions}
        sent = {verb: each.request.name for verb, each in self._sent.items()}
        return _words("methods", {verb: it for verb, it in sent.items() if it not in others})

    @property
    def pose_methods(self) -> str:
        """The message of each verb that reads or commands positions."""
        sent = {verb: each.request.name for verb, each in self._sent.items()}
        those = self._about_positions
        return _words("pose_methods", {verb: it for verb, it in sent.items() if it in those})

    @property
    def long(self) -> str:
        """The verbs that are named after methods for which a shorter one was chosen."""
        short = {each.long_verb: verb for verb, each in self._sent.items()}
        taken = {*VERBS, *self._sent}
        return _words("long", {long: verb for long, verb in short.items() if long not in taken})

    @property
    def stop_message(self) -> str:
        """The message that `stop` sends before it holds positions, or empty."""
        return "" if self._stop is None else self._stop.request.name

    @property
    def stop_summary(self) -> str:
        """What `stop` is for where it sends a message, or empty."""
        if self._stop is None:
            return ""
        return f"{_summary(self._stop).rstrip('.')}, then hold everything where it is."

    @property
    def in_examples(self) -> str:
        """What examples of own verbs have of the protocol."""
        message = _messages(self.model)[0]
        layout = message.layout
        found = {
            "frame": message.example.hex.hex(" ").upper(),
            "sender": layout.direction.sender,
            "end": self.model.directions[0].sender,
            "message": message.name,
            "word": snake_case(message.name).split("_")[0],
        }
        if len(layout.ids) == 1:
            (part,), (number,) = layout.frame.ids, layout.ids
            found |= {"number": f"0x{number:0{2 * part.size}X}", "part": part.name}
        return _words("in_examples", found)

    @property
    def examples(self) -> str:
        """The examples of own verbs that hold messages."""
        examples = {
            "encode": _encode_lines(self.model),
            "send": _send_lines(self.model),
            "bench-line": _bench_lines(self.model),
        }
        return _dict(
            "examples",
            [
                Bracketed(
                    f"{literal(verb)}: (", [_pair("(", line) for line in lines], ")", lone=","
                )
                for verb, lines in examples.items()
                if lines
            ],
        )

    @property
    def _has_poses(self) -> bool:
        return self.model.spec.pose is not None

    @property
    def _about_positions(self) -> tuple[str, ...]:
        pose = self.model.spec.pose
        return () if pose is None else (pose.read, pose.move)

    @cached_property
    def _sent(self) -> dict[str, Exchange]:
        """The messages that have a verb of their own; `send` reaches the others."""
        taken = {*VERBS} - ({STOP} if self._has_poses else OF_POSES)
        found: dict[str, Exchange] = {}
        for exchange in sorted(self.model.exchanges, key=lambda it: not it.request.message.verb):
            if exchange.verb not in taken:
                found.setdefault(exchange.verb, exchange)
        return {each.verb: each for each in self.model.exchanges if found.get(each.verb) is each}

    @property
    def _stop(self) -> Exchange | None:
        """What `stop` sends first; where nothing has a pose, it is a message like any."""
        return self._sent.get(STOP) if self._has_poses else None


def _summary(exchange: Exchange) -> str:
    return exchange.request.message.summary


def _arguments(exchange: Exchange, model: Model) -> str:
    """Return an example of a message by its verb: values in the order of its method."""
    message = MessageView(exchange.request, model)
    fields = message.command_words(exchange.request.message.examples[0].values)
    given = dict(field.split("=", 1) for field in fields)
    lasts = exchange.lasts
    words: list[str] = []
    for name in exchange.arguments:
        if name in given and (lasts is None or name != lasts.name):
            field = next(each for each in exchange.request.arguments if each.name == name)
            words += given[name].split(",") if isinstance(field, Items) else [given[name]]
    if lasts is not None and lasts.name in given:
        whole = given[lasts.name].removesuffix("000") if lasts.field.unit == "ms" else ""
        is_whole = whole != given[lasts.name] and whole
        words += ["--in", f"{whole}s" if is_whole else f"{given[lasts.name]}{lasts.field.unit}"]
    return " ".join(words)


def _encode_lines(model: Model) -> list[_Line]:
    """Return an example of each shape of message."""
    shapes: dict[tuple[bool, bool], _Line] = {}
    for message in _messages(model):
        shape = bool(message.numbers), message.items is not None
        line = _named(message), message.layout.message.summary
        shapes.setdefault(shape, line)
    return [*shapes.values()]


def _send_lines(model: Model) -> list[_Line]:
    """Return an example of each query, behind those of a few other requests."""
    commands = [message for message, reply in _requests(model) if not reply]
    queries = [message for message, reply in _requests(model) if reply]
    return [
        (f"--port COM7 {_named(message)}", message.layout.message.summary)
        for message in [*commands[:4], *queries]
    ]


def _bench_lines(model: Model) -> list[_Line]:
    """Return an example of each query, all but the first with a number of times."""
    queries = [(message, reply) for message, reply in _requests(model) if reply]
    return [
        (
            f"--port COM7 {_named(message)}{' -n 20' if at else ''}",
            f"how long {reply} takes to arrive",
        )
        for at, (message, reply) in enumerate(queries)
    ]


def _requests(model: Model) -> list[tuple[MessageView, str]]:
    """Return the messages of the client, each with the name of its reply, or empty."""
    return [
        (MessageView(each.request, model), each.reply.name if each.reply else "")
        for each in model.exchanges
    ]


def _named(message: MessageView) -> str:
    """Return a message as the command accepts it, with the values of its example."""
    return " ".join([message.name, *message.command_words(message.example.values)])


def _messages(model: Model) -> list[MessageView]:
    return [MessageView(message, model) for message in model.messages.values()]


def _dict(name: str, entries: Iterable[Bracketed | Text]) -> str:
    """Return an argument that is a dict."""
    return Bracketed(f"{name}={{", [*entries], "}").fitted(4, last=",")


def _words(name: str, words: Mapping[str, str]) -> str:
    """Return an argument that is a dict of words."""
    return _dict(
        name, [Text(it, before=f"{literal(key)}: ", item=True) for key, it in words.items()]
    )


def _pair(before: str, texts: tuple[str, str]) -> Bracketed:
    return Bracketed(before, [Text(text, item=True) for text in texts], ")")
