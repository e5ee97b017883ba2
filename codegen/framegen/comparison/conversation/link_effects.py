"""Effects of the line itself: its rate and characters, its echo, and boards that are no port."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.conversation.exchange_effects import ends_of
from framegen.comparison.conversation.line import arrival
from framegen.comparison.conversation.play import OTHER
from framegen.comparison.effect import Effect

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.conversation.play import Table
    from framegen.comparison.effect import Which

# Receivers look at the middle of each bit, so that the last of a character may be read at a rate
# that is this much off, with as much again for the clocks of both ends.
TOLERANCE = 0.02
_CHARACTER = ("data_bits", "parity", "stop_bits")


def link_effects(table: Table, client: Which) -> Iterator[Effect]:
    """Yield what becomes of all that a client says, whose line is as the other edition has it."""
    ours, theirs = table.pair.edition(client).spec.link, table.pair.edition(OTHER[client]).spec.link
    if abs(ours.baud - theirs.baud) > TOLERANCE * min(ours.baud, theirs.baud):
        text = f"one end is at {ours.baud} baud, and the other at {theirs.baud}"
        yield _of_line(table, client, "baud", "line", f"nothing is understood: {text}")
    for key in _CHARACTER:
        if getattr(ours, key) != getattr(theirs, key):
            name = key.replace("_", " ")
            text = (
                f"{name} {getattr(ours, key)} at one end, and {getattr(theirs, key)} at the other"
            )
            yield _of_line(table, client, key, "line", f"not all is understood: {text}")
    if ours.local_echo != theirs.local_echo:
        yield _of_echo(table, client, expected=ours.local_echo)
    yield from _of_boards(table, client)


def _of_line(
    table: Table, client: Which, key: str, outcome: str, text: str, *, breaks: bool = True
) -> Effect:
    path = ("link", key)
    ends = ends_of(table, client)
    return Effect("conversation", outcome, path, path, text, ends, breaks)


def _of_echo(table: Table, client: Which, *, expected: bool) -> Effect:
    """Return the effect of an echo that does not come, or that nobody expects.

    What comes back is mostly noise, which harms nothing; but it may look like a message.
    """
    if expected:
        text = "every request fails: what was sent is expected to come back, and does not"
        return _of_line(table, client, "local_echo", "echo", text)
    model = table.clients[client].model
    for exchange in table.clients[client].exchanges.values():
        for _, data in table.requests(client, exchange):
            came = arrival(model, model.roles.received, data).messages
            if came:
                name = exchange.request.name
                text = f"{name} comes back, and is taken for {came[0].message.name}"
                return _of_line(table, client, "local_echo", "echo", text)
    text = "what was sent comes back, and is dropped as noise"
    return _of_line(table, client, "local_echo", "echo", text, breaks=False)


def _of_boards(table: Table, client: Which) -> Iterator[Effect]:
    """Yield what becomes of boards without a port: they are found by their ids."""
    known = {each.ids: each for each in table.pair.edition(client).spec.link.usb_hid}
    for board in table.pair.edition(OTHER[client]).spec.link.usb_hid:
        ours = known.get(board.ids)
        if ours is None:
            text = f"the board {board.ids} is not found, as no port is one of these"
            yield _of_line(table, client, "usb_hid", "not found", text, breaks=client == "new")
        elif ours.report_size != board.report_size:
            text = (
                f"the board {board.ids} has reports of {board.report_size} bytes, "
                f"and the host sends {ours.report_size}"
            )
            yield _of_line(table, client, "usb_hid", "line", text)
