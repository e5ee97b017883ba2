"""What must hold for the conversations of any two editions."""

import re
from collections import Counter
from collections.abc import Iterator
from typing import Any

from framegen.comparison.conversation import conversation_effects
from framegen.comparison.conversation.device import Kind
from framegen.comparison.conversation.outcome import OUTCOMES, outcome_of
from framegen.comparison.conversation.play import OTHER, Play, Table
from framegen.comparison.effect import Which
from framegen.comparison.pair import Pair
from framegen.model.codec import encode
from framegen.model.exchanges import Exchange
from hypothesis import strategies as st

from tests.protocols.specs import values_for

SIDES: tuple[Which, Which] = ("old", "new")
# What is said whatever worked between two ends of the old edition.
_TOLD_BOTH_WAYS = ("line", "echo", "not found", "no report")
# Requests of so many exchanges are drawn for each client.
_SOME = 4


def assert_mirrored(pair: Pair) -> None:
    """The way back is the way there, with old and new swapped.

    Each end plays the same exchanges with the same other end, and they end alike. What breaks may
    differ: that is what worked between two ends of the edition that comes first, so that what is
    an addition on the way there is a loss on the way back. Of the line, of ends that both ask and
    of reports that are dropped, which do not depend on what worked, the same is said both ways.
    """
    there, back = Table(pair), Table(pair.turned)
    assert Counter(_played(there, "old")) == Counter(_played(back, "new"))
    assert Counter(_played(there, "new")) == Counter(_played(back, "old"))
    assert _said(pair, swapped=True) == _said(pair.turned)


def _played(table: Table, client: Which) -> Iterator[tuple[Any, ...]]:
    for name, exchange in table.clients[client].exchanges.items():
        for play in table.plays(client, exchange):
            yield name, play.data, play.kind, play.answered, play.ending, play.seen.rest


def _said(pair: Pair, *, swapped: bool = False) -> set[tuple[Any, ...]]:
    """Return what is said of the line, of who asks, and of reports."""
    other = {"old": "new", "new": "old"} if swapped else {}
    return {
        (
            each.outcome,
            frozenset(
                re.sub(r"^(?:old|new)\b", lambda found: other.get(found[0], found[0]), end)
                for end in each.ends.split(", ")
            ),
            (each.new, each.old) if swapped else (each.old, each.new),
        )
        for each in conversation_effects(pair)
        if each.outcome in _TOLD_BOTH_WAYS or each.path == ("endpoints",)
    }


def assert_nothing_ends_worse(pair: Pair, data: st.DataObject) -> None:
    """No request, whatever its values, ends worse than the worst that was tried."""
    table = Table(pair)
    for client in SIDES:
        exchanges = [*table.clients[client].exchanges.values()]
        some = data.draw(st.permutations(exchanges))[:_SOME]
        for exchange in some:
            worst = Counter[Kind]()
            for play in table.plays(client, exchange):
                worst[play.kind] = max(worst[play.kind], _badness(table, play))
            for play in _drawn(table, client, exchange, data):
                assert _badness(table, play) <= worst[play.kind], play


def _badness(table: Table, play: Play) -> int:
    """Rank how a play ends.

    A question is lost whether its answer is refused, or happens to be another or one for another.
    """
    outcome, _ = outcome_of(table, play)
    if not outcome:
        return 0
    return len(OUTCOMES) - max(OUTCOMES.index(outcome), _LOST)


_LOST = OUTCOMES.index("not recognized")


def _drawn(table: Table, client: Which, exchange: Exchange, data: st.DataObject) -> Iterator[Play]:
    values = data.draw(values_for(exchange.request, few=True))
    counter = exchange.request.frame.counter
    numbered = values if counter is None else {**values, counter.name: 0}
    if not table.clients[client].fits(exchange, numbered):
        return
    frame = encode(exchange.request, numbered)
    device = table.devices[OTHER[client]]
    kinds = {kind: None for each in device.reads(frame)[0] for kind in device.kinds(each)}
    for kind in kinds or {"reply": None}:
        yield table.play(client, exchange, numbered, frame, kind)
