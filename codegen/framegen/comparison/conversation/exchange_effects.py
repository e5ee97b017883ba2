"""Effects on exchanges: a request that worked between two old ends, and no longer works.

What worked between two ends of the old edition must work when one of them is new. What the old
edition could not say, or never did, is an addition where it fails: unless nothing of a request that
both know works any more.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from framegen.comparison.conversation.outcome import OUTCOMES, WANTED, outcome_of
from framegen.comparison.conversation.play import OTHER
from framegen.comparison.effect import Effect, Witness

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from framegen.comparison.conversation.device import Kind
    from framegen.comparison.conversation.play import Play, Table
    from framegen.comparison.effect import Outcome, Which
    from framegen.model.exchanges import Exchange
    from framegen.model.layout import MessageLayout


@dataclass(frozen=True, slots=True)
class Verdict:
    """What is wrong with a play: the outcome, why, and whether it breaks anything."""

    outcome: str
    why: str
    breaks: bool
    play: Play


def exchange_effects(table: Table, client: Which) -> Iterator[Effect]:
    """Yield what becomes of the requests of a client, whose device has the other edition."""
    for exchange in table.clients[client].exchanges.values():
        for verdict in verdicts(table, client, exchange):
            yield effect_on(
                table,
                client,
                exchange.request,
                verdict.outcome,
                verdict.why,
                breaks=verdict.breaks,
                witness=_witness(verdict),
            )


def verdicts(table: Table, client: Which, exchange: Exchange) -> Iterator[Verdict]:
    """Yield the worst of each kind of answer; no more where the request itself is lost."""
    plays = [*table.plays(client, exchange)]
    found: dict[Kind, list[Verdict]] = {"reply": [], "refusal": [], "failure": []}
    for play in plays:
        verdict = _judged(table, play)
        if verdict is not None:
            found[play.kind].append(verdict)
    worst = _worst(found["reply"])
    is_known = table.other(client, exchange) is not None and not table.is_linked_first(exchange)
    if worst is not None and not worst.breaks and is_known and _is_dead(plays):
        worst = replace(worst, breaks=True)
    if worst is not None:
        yield worst
    if worst is not None and not worst.play.read_as:
        return
    for kind in ("refusal", "failure"):
        other = _worst(found[kind])
        if other is not None and (worst is None or worst.outcome != other.outcome):
            yield other


def _is_dead(plays: Sequence[Play]) -> bool:
    """Tell whether nothing of a question works any more."""
    tried = [play for play in plays if play.kind == "reply" and play.ending != "unasked"]
    return bool(tried) and all(play.ending == "timeout" for play in tried)


def _worst(found: Sequence[Verdict]) -> Verdict | None:
    """Return the worst verdict, one that breaks before all others; of equals the shortest."""

    def rank(each: Verdict) -> tuple[bool, int, int]:
        size = len(each.play.data) + len(each.play.answered)
        return not each.breaks, OUTCOMES.index(each.outcome), size

    return min(found, key=rank, default=None)


def _judged(table: Table, play: Play) -> Verdict | None:
    """Return what is wrong with a play; None where it ends as it should, or as it did before."""
    outcome, why = outcome_of(table, play)
    if not outcome:
        return None
    before = play.before
    if outcome == "unawaited":
        if before is not None and before.seen.rest == play.seen.rest:
            return None
        mistaken = _mistaken(table, play)
        said = f"{why}, and may be taken for the reply to {mistaken}" if mistaken else why
        return Verdict(outcome, said, bool(mistaken), play)
    if before is not None and before.ending == play.ending:
        return None
    worked = before is not None and before.ending in WANTED[play.kind]
    if play.read_as and not play.answered and table.is_linked_first(play.exchange):
        return Verdict(outcome, _linked_first(play.exchange), False, play)
    return Verdict(outcome, why, worked, play)


def _linked_first(exchange: Exchange) -> str:
    """Return what a question gets whose answer was known, and was said to answer nothing."""
    answer = "" if exchange.reply is None else exchange.reply.name
    return (
        f"gets no reply unless {answer} has always followed it, which the old edition does not say"
    )


def _mistaken(table: Table, play: Play) -> str:
    """Return the requests for whose reply something may be taken that nobody awaits."""
    awaited = table.clients[play.client].answers
    found = [name for came in play.seen.came for name in awaited.get(came, ())]
    return ", ".join(dict.fromkeys(found))


def effect_on(
    table: Table,
    client: Which,
    message: MessageLayout,
    outcome: str,
    text: str,
    *,
    breaks: bool,
    witness: Witness | None = None,
) -> Effect:
    """Return an effect on a message of the client's edition; `text` goes on after its name."""
    pairing = table.pair.messages if client == "old" else table.pair.messages.flipped
    name = pairing.to_new.get(message.name)
    here, there = ("messages", message.name), None if name is None else ("messages", name)
    old, new = (here, there) if client == "old" else (there, here)
    return Effect(
        "conversation",
        outcome,
        old,
        new,
        f"{message.name} {text}",
        ends_of(table, client),
        breaks,
        certain=message.name not in pairing.guessed,
        witness=witness,
    )


def ends_of(table: Table, client: Which) -> str:
    """Return who speaks with whom: `old host, new controller`.

    The other end is the same one, whichever of them asks by its own edition.
    """
    roles = table.clients[client].model.roles
    ends = (
        table.pair.ends if client == "old" else {new: old for old, new in table.pair.ends.items()}
    )
    device = OTHER[client]
    there = ends.get(roles.device, table.devices[device].model.roles.device)
    return f"{client} {roles.client}, {device} {there}"


def _witness(verdict: Verdict) -> Witness:
    """Return the frame that shows it: the answer if one came, else the request."""
    play = verdict.play
    answer = next((each for each in play.answers if each.data), None)
    if answer is None or answer.values is None:
        outcome: Outcome = "same" if play.read_as else "refused"
        name = play.exchange.request.name
        return Witness(play.client, play.data, name, play.values, outcome, verdict.why)
    outcome = "misread" if play.seen.came else "refused"
    device = OTHER[play.client]
    return Witness(device, answer.data, answer.message, answer.values, outcome, verdict.why)
