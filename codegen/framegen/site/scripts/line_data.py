"""What a page needs to talk over a line: its settings, and what answers what."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from framegen.language.values import Range
    from framegen.model.exchanges import Exchange
    from framegen.model.limits import SendingLimits
    from framegen.model.model import Model

# The files of the script that talks over a line, in order.
LINE_SCRIPT = (
    "serial_line",
    "serial_echo",
    "serial_queue",
    "serial_replies",
    "serial_recording",
    "serial_limits",
    "serial_session",
    "serial_words",
    "serial_settings",
    "serial_file",
    "serial_log",
    "serial_panel",
)


def line_data(model: Model) -> dict[str, Any]:
    """Return the link, the directions of the client, and its exchanges by the name of the request.

    `received` is None where nothing is ever sent to the client. `first` is the message that the
    encoder begins with.
    """
    link, roles = model.spec.link, model.roles
    comes = any(message.direction == roles.received for message in model.messages.values())
    return {
        "baud": link.baud,
        "dataBits": link.data_bits,
        "parity": link.parity,
        "stopBits": link.stop_bits,
        "bitsPerByte": link.bits_per_byte,
        "localEcho": link.local_echo,
        "sent": roles.sent.key,
        "received": roles.received.key if comes else None,
        "client": roles.client,
        "device": roles.device,
        "exchanges": {each.request.name: _exchange(each) for each in model.exchanges},
        "limits": None if model.limits is None else _limits(model.limits),
        "first": _first(model),
    }


def _first(model: Model) -> str:
    """Return the query with the fewest arguments, since it changes nothing; without any, the first.

    A message is no such query if its reply only repeats it, which confirms a change, or if what it
    carries has limits.
    """
    queries = [each for each in model.exchanges if _tells(each) and not each.request.limited]
    if not queries:
        return next(iter(model.messages), "")
    return min(queries, key=lambda each: len(each.method.arguments)).request.name


def _tells(exchange: Exchange) -> bool:
    """Return whether there is a reply that says what the request did not."""
    said = {slot.name for slot in exchange.request.arguments}
    said |= set() if exchange.failure is None else {exchange.failure.name}
    answers = () if exchange.reply is None else exchange.reply.arguments
    return any(slot.name not in said for slot in answers)


def _limits(limits: SendingLimits) -> dict[str, Any]:
    """Return limits as pairs of text: numbers in a browser have fewer digits than those of JSON."""
    return {
        "usual": _pair(limits.usual),
        "others": [[name, _pair(each)] for name, each in limits.others.items()],
        "fields": {name: [*paths] for name, paths in limits.fields.items()},
    }


def _pair(bounds: Range) -> list[str]:
    return [str(bounds.low), str(bounds.high)]


def _counted(exchange: Exchange) -> dict[str, Any] | None:
    """Return what compares the length of a reply with what was asked for."""
    if exchange.counted is None:
        return None
    failure = None if exchange.failure is None else exchange.failure.name
    told = {"asked": exchange.asks_for, "held": exchange.counted.name}
    return {**told, "failure": failure, "good": exchange.good}


def _exchange(exchange: Exchange) -> dict[str, Any]:
    """Return what comes back; `largest` is the size of the largest frame that answers."""
    sizes = [each.size_at(each.counts[-1]) for each in exchange.answers]
    return {
        "reply": None if exchange.reply is None else exchange.reply.name,
        "refusal": None if exchange.refusal is None else exchange.refusal.name,
        "reports": list(exchange.reports),
        "echoed": [list(pair) for pair in exchange.echoed],
        "counted": _counted(exchange),
        "address": None if exchange.address is None else exchange.address.name,
        "silent": list(exchange.silent.values()),
        "largest": max(sizes, default=0),
        "most": exchange.most,
    }
