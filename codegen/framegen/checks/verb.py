"""Rule: every verb is one word of a shell, and sends one message."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from framegen.checks.rule import ModelRule, Problem
from framegen.language.command_verbs import OF_POSES, STOP, VERBS
from framegen.model.exchanges import arguments_of, long_verb_of

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import Message
    from framegen.model.model import Model

_VERB = re.compile(r"[a-z][a-z0-9]*(?:-[a-z0-9]+)*")
_LONGEST = 40


def _look(model: Model) -> Iterator[Problem]:
    spec, sent = model.spec, model.roles.sent
    named: dict[str, list[str]] = {}
    # A word that is chosen for one message is in the way of another's method, wherever that stands.
    for name, message in sorted(spec.messages.items(), key=lambda each: bool(each[1].verb)):
        if message.direction == sent:
            for verb in {message.verb, long_verb_of(name, message)} - {""}:
                named.setdefault(verb, []).append(name)
    for name, message in spec.messages.items():
        if not message.verb:
            continue
        path = ("messages", name, "verb")
        if message.direction != sent:
            what = f"{name} goes {message.direction}, and a client sends {sent}"
            yield Problem(path, what, "only what a client sends has a verb")
        elif found := _form(message.verb) or _taken(message, poses=spec.pose is not None):
            yield Problem(path, *found)
        elif (first := named[message.verb][0]) != name:
            there = ("messages", first)
            what = f"there are two verbs called `{message.verb}`"
            yield Problem(path, what, "choose another word", also=(there, "the other is here"))


def _form(verb: str) -> tuple[str, str] | None:
    """Say why a verb is no word of a shell."""
    if _VERB.fullmatch(verb) is None:
        proposed = "-".join(re.findall(r"[a-z0-9]+", verb.lower()))
        hint = f"write `{proposed}`" if _VERB.fullmatch(proposed) else "begin it with a letter"
        return f"`{verb}` is no verb: it has lower-case letters, digits and hyphens", hint
    if len(verb) > _LONGEST:
        return f"`{verb}` has {len(verb)} characters, and a verb {_LONGEST} at most", "shorten it"
    return None


def _taken(message: Message, *, poses: bool) -> tuple[str, str] | None:
    """Say why the command has another use for a verb."""
    if message.verb == STOP and poses:
        if not arguments_of(message) and message.reply is None:
            return None
        what = f"`{STOP}` sends its message before it holds what moves, and has nothing to fill in"
        return what, "name a message without fields and without a reply, or choose another word"
    if message.verb in VERBS and (poses or message.verb not in OF_POSES):
        return f"every command has a verb `{message.verb}` already", "choose another word"
    return None


RULE = ModelRule(
    id="verb",
    title="Every verb is one word of a shell, and sends one message",
    why="A command has one verb for each message of its client beside those that every command "
    "has: of two that are equal, one could not be called.",
    bad="LampsSet: {verb: send}",
    good="LampsSet: {verb: light}",
    look=_look,
)
