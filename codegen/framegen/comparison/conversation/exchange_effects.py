"""Effects on exchanges: a request that worked between two old ends, and no longer works.

What worked between two ends of the old edition must work when one of them is new. What the old
edition could not say, or never did, is an addition where it fails: unless nothing of a request that
both know works any more.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framegen.comparison.conversation.play import OTHER
from framegen.comparison.effect import Effect, Witness

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from framegen.comparison.conversation.play import Play, Table
    from framegen.comparison.effect import Which
    from framegen.model.exchanges import Exchange
    from framegen.model.layout import MessageLayout

# What becomes of an exchange, from the worst to the least: of several, one is said.
OUTCOMES = (
    "no reply",
    "other reply",
    "not recognized",
    "error",
    "no error",
    "in part",
    "not asked",
    "unawaited",
)


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
    found = {
        kind: [verdict for play in plays if play.kind == kind and (verdict := _judged(table, play))]
        for kind in ("reply", "refusal", "failure")
    }
    replies = found["reply"]
    if replies and table.other(client, exchange) is not None:
        tried = [play for play in plays if play.kind == "reply" and play.ending != "unasked"]
        if tried and all(play.ending == "timeout" for play in tried):
            replies = [Verdict(each.outcome, each.why, True, each.play) for each in replies]
    worst = _worst(replies)
    if worst is not None:
        yield worst
    if worst is not None and worst.outcome == "no reply" and not worst.play.read_as:
        return
    for kind in ("refusal", "failure"):
        other = _worst(found[kind])
        if other is not None and (worst is None or worst.outcome != other.outcome):
            yield other


def _worst(found: Sequence[Verdict]) -> Verdict | None:
    """Return the worst verdict, one that breaks before all others; of equals the first."""
    return min(
        found, key=lambda each: (not each.breaks, OUTCOMES.index(each.outcome)), default=None
    )


def _judged(table: Table, play: Play) -> Verdict | None:
    """Return what is wrong with a play; None where it ends as it should, or as it did before."""
    outcome, why = _outcome(table, play)
    if not outcome:
        return None
    before = play.before
    if outcome == "unawaited":
        if before is not None and before.rest == play.seen.rest:
            return None
        mistaken = _mistaken(table, play)
        said = f"{why}, and may be taken for the reply to {mistaken}" if mistaken else why
        return Verdict(outcome, said, bool(mistaken), play)
    if before is not None and before.ending == play.ending:
        return None
    wanted = {"reply": ("reply", "sent"), "refusal": ("refusal",), "failure": ("failure",)}
    worked = before is not None and before.ending in wanted[play.kind]
    return Verdict(outcome, why, worked, play)


def _outcome(table: Table, play: Play) -> tuple[str, str]:
    """Return what is wrong with how a play ends, and why; nothing for what is right."""
    there = f"{OTHER[play.client]} edition"
    came = ", ".join(play.seen.came)
    match play.kind, play.ending:
        case ("reply", "reply") | ("refusal", "refusal") | ("failure", "failure"):
            return "", ""
        case _, "sent":
            if not play.seen.rest:
                return "", ""
            named = ", ".join(each.message for each in play.answers if each.data)
            return "unawaited", f"is answered by {named}, which nobody awaits"
        case _, "unasked":
            return ("", "") if play.kind != "reply" else ("not asked", _unasked(play))
        case "refusal", "reply" | "partial" | "failure":
            return "no error", f"is refused by {_answers(play)}, which is taken for the reply"
        case "refusal", _:
            return "no error", f"is refused by {_answers(play)}, which {_unheard(play)}"
        case "failure", "reply" | "partial":
            return "no error", f"fails, and {_answers(play)} is taken for success"
        case "failure", "timeout":
            return "no error", f"fails, and {_answers(play)} {_unheard(play)}"
        case _, "failure":
            return "error", f"succeeds, and {_answers(play)} is taken for a failure"
        case _, "refusal":
            return "other reply", f"is answered by {_answers(play)}, which is read as a refusal"
        case _, "partial":
            return "in part", f"is answered by {_answers(play)}, which lacks some of what is asked"
    if not play.read_as:
        return "no reply", f"gets no reply: the request is refused, {play.refusal}"
    if not play.answered:
        others = [name for name in play.read_as if name != _theirs(table, play)]
        read = f"the request is read as {', '.join(others)}, and " if others else ""
        why = ", ".join(dict.fromkeys(each.why for each in play.answers))
        return "no reply", f"gets no reply: {read}{why.replace('there', f'in the {there}')}"
    if not came:
        return "no reply", f"gets no reply: {_answers(play)} {_unheard(play)}"
    assert play.exchange.reply is not None
    kinds = {each.name for each in play.exchange.answers}
    if kinds.isdisjoint(play.seen.came):
        return "other reply", f"is answered by {_answers(play)}, which is read as {came}"
    return (
        "not recognized",
        f"is answered by {came}, which repeats something else, or is from another",
    )


def _unasked(play: Play) -> str:
    address = play.exchange.address
    assert address is not None
    return f"is not asked at {address.name} {play.values[address.name]}, where nobody answers"


def _unheard(play: Play) -> str:
    if play.seen.came:
        return f"is read as {', '.join(play.seen.came)}, and answers nothing"
    return f"is refused, {play.seen.refusal}"


def _answers(play: Play) -> str:
    return ", ".join(each.message for each in play.answers if each.message) or "nothing"


def _theirs(table: Table, play: Play) -> str:
    other = table.other(play.client, play.exchange)
    return "" if other is None else other.request.name


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
    """Return who speaks with whom: `old host, new controller`."""
    device = OTHER[client]
    asks, answers = table.clients[client].model.roles, table.devices[device].model.roles
    return f"{client} {asks.client}, {device} {answers.device}"


def _witness(verdict: Verdict) -> Witness:
    """Return the frame that shows it: the answer if one came, else the request."""
    play = verdict.play
    answer = next((each for each in play.answers if each.data), None)
    if answer is None or answer.values is None:
        outcome = "same" if play.read_as else "refused"
        name = play.exchange.request.name
        return Witness(play.client, play.data, name, play.values, outcome, verdict.why)  # type: ignore[arg-type]
    outcome = "misread" if play.seen.came else "refused"
    device = OTHER[play.client]
    return Witness(device, answer.data, answer.message, answer.values, outcome, verdict.why)  # type: ignore[arg-type]
