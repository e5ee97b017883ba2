"""Effects on conversation: what the ends of a line wait for, and what they get.

A client of one edition and a device of the other are played against each other, both ways round:
the client asks and awaits what its own spec says, and the device answers as its own promises.
What worked between two ends of the old edition must work when one of them is new.

- `no reply`: a question is answered by nothing that is understood; the program gets a timeout.
- `other reply`: something comes that the client awaits for another question, or for none.
- `not recognized`: the reply comes, and repeats something else than was asked; it is ignored.
- `error`: a reply is taken for a failure. `no error`: a refusal or a failure is not noticed.
- `in part`: the reply has no room for all that is asked.
- `not asked`: the client puts no question to an address where nobody answers any more.
- `unawaited`: a command is answered; it breaks where that may be taken for another reply.
- `not acknowledged`, `no report`: a command is not followed by what is awaited.
- `line`, `echo`, `not found`: the ends do not agree about the line itself.

Times need no play of their own. How long a client waits follows from the line and from the largest
reply that it knows, and a larger one is refused already; how long a motion lasts is a value of the
request, in its unit.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.conversation.exchange_effects import ends_of, exchange_effects
from framegen.comparison.conversation.link_effects import link_effects
from framegen.comparison.conversation.play import OTHER, Table
from framegen.comparison.conversation.report_effects import report_effects
from framegen.comparison.effect import Effect

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.effect import Which
    from framegen.comparison.pair import Pair


def conversation_effects(pair: Pair) -> Iterator[Effect]:
    """Yield the effects on conversation: the old host with a new device, then the other way."""
    table = Table(pair)
    clients: tuple[Which, Which] = ("old", "new")
    for client in clients:
        yield from link_effects(table, client)
        if not _are_client_and_device(table, client):
            yield _of_turned_ends(table, client)
        elif not _alike(pair):
            yield from exchange_effects(table, client)
            yield from report_effects(table, client)


def _of_turned_ends(table: Table, client: Which) -> Effect:
    """Return the effect of ends that have changed their parts: two clients, or two devices."""
    path = ("endpoints",)
    if client == "old":
        text, ends = "nobody answers: both ends ask", ends_of(table, "old")
    else:
        was, names = table.clients["old"].model.roles, table.pair.ends
        text = "nobody asks: both ends answer"
        ends = f"new {names.get(was.client, was.client)}, old {was.device}"
    return Effect("conversation", "no reply", path, path, text, ends)


def _are_client_and_device(table: Table, client: Which) -> bool:
    """Tell whether the end that the client talks to is the device of the other edition."""
    ours, theirs = table.clients[client].model.roles, table.devices[OTHER[client]].model.roles
    turn = table.pair.way_in_new if client == "old" else table.pair.way_in_old
    return turn(ours.sent) == theirs.sent


def _alike(pair: Pair) -> bool:
    """Tell whether both editions say the same of all messages, so that nothing need be played."""
    old, new = pair.old.spec, pair.new.spec
    return (old.byte_order, old.envelopes, old.messages) == (
        new.byte_order,
        new.envelopes,
        new.messages,
    )
