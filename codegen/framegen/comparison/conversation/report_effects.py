"""Effects on reports: what a command is acknowledged by, what follows it, what comes by itself."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.conversation.device import Device
from framegen.comparison.conversation.exchange_effects import effect_on
from framegen.comparison.conversation.line import arrival
from framegen.comparison.conversation.play import OTHER
from framegen.comparison.edges import values_to_try
from framegen.model.codec import Unencodable, encode

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.conversation.client import Client
    from framegen.comparison.conversation.line import Received
    from framegen.comparison.conversation.play import Table
    from framegen.comparison.effect import Effect, Which
    from framegen.comparison.pairing import Pairing
    from framegen.model.exchanges import Exchange
    from framegen.model.layout import MessageLayout


def report_effects(table: Table, client: Which) -> Iterator[Effect]:
    """Yield what becomes of the reports that a client awaits, or receives unasked."""
    for exchange in table.clients[client].exchanges.values():
        other = table.other(client, exchange)
        if other is None:
            continue
        yield from _acknowledged(table, client, exchange, other)
        yield from _following(table, client, exchange, other)
    yield from _dropped(table, client)


def acknowledges(table: Table, client: Which, device: Which, data: bytes) -> bool:
    """Tell whether a client takes what a device promises to report on a request for its receipt."""
    here, there = table.clients[client], table.devices[device]
    # What the request says is what its own edition reads in it.
    (sent,) = Device(here.model).reads(data)[0]
    exchange = here.exchanges[sent.message.name]
    for request in there.reads(data)[0]:
        name = there.exchanges[request.message.name].acknowledged
        report = None if name is None else report_of(there.model.messages[name], request)
        came = arrival(here.model, here.model.roles.received, report or b"").messages
        if any(each.message.name == exchange.acknowledged and _agrees(sent, each) for each in came):
            return True
    return False


def report_of(report: MessageLayout, request: Received) -> bytes | None:
    """Return the frame of a report with the values that a request has in fields of its names."""
    given = next(iter(values_to_try(report, None, {}, pairs=False)))
    shared = {name: request.values[name] for name in given if name in request.values}
    try:
        return encode(report, {**given, **shared})
    except (Unencodable, OverflowError):
        return None


def _agrees(request: Received, report: Received) -> bool:
    """Tell whether a report has the values of a request in all fields of the same name."""
    shared = [name for name in request.values if name in report.values]
    return all(report.values[name] == request.values[name] for name in shared)


def _acknowledged(
    table: Table, client: Which, exchange: Exchange, other: Exchange
) -> Iterator[Effect]:
    """Yield an effect where a client awaits an acknowledgement in vain: one that breaks, if any."""
    if exchange.acknowledged is None:
        return
    lost = [
        table.before(client, exchange, values)
        for values, data in table.requests(client, exchange)
        if not acknowledges(table, client, OTHER[client], data)
    ]
    if lost:
        breaks = any(each is not None and acknowledges(table, "old", "old", each) for each in lost)
        text = f"is not acknowledged by {exchange.acknowledged}: {_why(client, other)}"
        yield effect_on(table, client, exchange.request, "not acknowledged", text, breaks=breaks)


def _why(client: Which, other: Exchange) -> str:
    device = OTHER[client]
    if other.acknowledged is None:
        return f"nothing acknowledges it in the {device} edition"
    return f"{other.acknowledged} of the {device} edition is not taken for it"


def _following(
    table: Table, client: Which, exchange: Exchange, other: Exchange
) -> Iterator[Effect]:
    """Yield an effect for each report that no longer follows a command, or does not yet."""
    pairing = _messages(table, client)
    there = {*other.reports, *(each.name for each in other.answers)}
    for name in exchange.reports:
        if pairing.to_new.get(name) not in there:
            text = f"is not followed by {name} in the {OTHER[client]} edition"
            yield effect_on(
                table, client, exchange.request, "no report", text, breaks=client == "old"
            )


def _dropped(table: Table, client: Which) -> Iterator[Effect]:
    """Yield an effect for each report that a client takes for an unsolicited reply, and drops."""
    here, theirs = table.clients[client], table.clients[OTHER[client]]
    names = _messages(table, client).to_old
    for message in theirs.model.sent(theirs.model.roles.received):
        ours = here.model.messages.get(names.get(message.name, ""))
        if theirs.becomes(message.name) != "report" or ours is None:
            continue
        if here.becomes(ours.name) == "dropped":
            text = _taken(client, here, ours)
            yield effect_on(table, client, ours, "no report", text, breaks=client == "new")


def _taken(client: Which, here: Client, message: MessageLayout) -> str:
    """Return what becomes of a report that a client takes for an answer.

    Where the edition that links them is the new one, programs that were given it as a report are
    given it no longer, even if devices only do what they always did.
    """
    asks = ", ".join(here.answers[message.name])
    end = f"the {client} {here.model.roles.client}"
    if client == "new":
        return (
            f"is reported no longer: {end} takes it for the answer to {asks}, "
            "returns it to a program that asks, and drops it where none does"
        )
    return f"is not reported: {end} takes it for the answer to {asks}, and drops it where none asks"


def _messages(table: Table, client: Which) -> Pairing:
    """Return the messages of the client's edition, each with its name in the device's."""
    return table.pair.messages if client == "old" else table.pair.messages.flipped
