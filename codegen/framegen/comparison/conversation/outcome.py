"""The outcome of a play: what is wrong with how it ends, in a word and in a sentence."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.conversation.play import OTHER

if TYPE_CHECKING:
    from framegen.comparison.conversation.client import Ending
    from framegen.comparison.conversation.device import Kind
    from framegen.comparison.conversation.play import Play, Table

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
# How a request should end that is answered in each way.
WANTED: dict[Kind, tuple[Ending, ...]] = {
    "reply": ("reply", "sent"),
    "refusal": ("refusal", "sent", "unasked"),
    "failure": ("failure", "sent", "unasked"),
}
# How it ends otherwise, where an answer came that the client has understood somehow.
_OTHERWISE: dict[tuple[Kind, Ending], tuple[str, str]] = {
    ("reply", "failure"): ("error", "succeeds, and {} is taken for a failure"),
    ("reply", "refusal"): ("error", "is answered by {}, which is taken for a refusal"),
    ("reply", "partial"): ("in part", "is answered by {}, which has no room for all that is asked"),
    ("refusal", "reply"): ("no error", "is refused by {}, which is taken for the reply"),
    ("refusal", "partial"): ("no error", "is refused by {}, which is taken for the reply"),
    ("refusal", "failure"): ("no error", "is refused by {}, which is taken for a failure"),
    ("failure", "reply"): ("no error", "fails, and {} is taken for success"),
    ("failure", "partial"): ("no error", "fails, and {} is taken for success"),
    ("failure", "refusal"): ("no error", "fails, and {} is taken for a refusal"),
}


def outcome_of(table: Table, play: Play) -> tuple[str, str]:
    """Return what is wrong with how a play ends, and why; nothing for what is right."""
    answer = ", ".join(each.message for each in play.answers if each.message)
    if play.ending == "sent" and play.seen.rest:
        return "unawaited", f"is answered by {answer}, which nobody awaits"
    if play.ending in WANTED[play.kind]:
        return "", ""
    if play.ending == "unasked":
        return "not asked", _unasked(play)
    if (play.kind, play.ending) in _OTHERWISE:
        outcome, text = _OTHERWISE[play.kind, play.ending]
        return outcome, text.format(answer)
    if play.kind != "reply":
        return "no error", _unnoticed(play, answer)
    return _lost(table, play, answer)


def _unnoticed(play: Play, answer: str) -> str:
    """Return why a refusal or a failure is not noticed."""
    if not answer:
        said = "is refused" if play.kind == "refusal" else "fails"
        return f"{said}, of which nothing is said: {_unsaid(play)}"
    said = f"is refused by {answer}, which" if play.kind == "refusal" else f"fails, and {answer}"
    return f"{said} {_unheard(play)}"


def _lost(table: Table, play: Play, answer: str) -> tuple[str, str]:
    """Return why a question has timed out."""
    if not play.read_as:
        return "no reply", f"gets no reply: the request is refused, {play.refusal}"
    if not play.answered:
        other = table.other(play.client, play.exchange)
        ours = "" if other is None else other.request.name
        others = [name for name in play.read_as if name != ours]
        read = f"the request is read as {', '.join(others)}, and " if others else ""
        return (
            "no reply",
            f"gets no reply: {read}{_unsaid(play)} in the {OTHER[play.client]} edition",
        )
    if not play.seen.came:
        return "no reply", f"gets no reply: {answer} {_unheard(play)}"
    came = ", ".join(play.seen.came)
    if {each.name for each in play.exchange.answers}.isdisjoint(play.seen.came):
        if came == answer:
            wanted = " or ".join(each.name for each in play.exchange.answers)
            return "other reply", f"is answered by {answer}, and not by {wanted}"
        return "other reply", f"is answered by {answer}, which is read as {came}"
    return "not recognized", f"is answered by {came}, which is not what was asked, or of whom"


def _unsaid(play: Play) -> str:
    """Return why a device that reads a request sends nothing back."""
    return ", ".join(dict.fromkeys(each.why for each in play.answers))


def _unasked(play: Play) -> str:
    address = play.exchange.address
    where = "" if address is None else f" at {address.name} {play.values[address.name]}"
    return f"is not asked{where}, where nobody is said to answer"


def _unheard(play: Play) -> str:
    if play.seen.came:
        return f"is read as {', '.join(play.seen.came)}, and answers nothing"
    return f"is refused, {play.seen.refusal}"
