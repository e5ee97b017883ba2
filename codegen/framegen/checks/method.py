"""Rule: every message that a client sends can be a method of the client."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.rule import ModelRule, Problem
from framegen.language.spec import AddressPart, CounterPart
from framegen.model.exchanges import arguments_of, method_of
from framegen.reading.findings import did_you_mean

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import Frame, Message, Spec
    from framegen.model.model import Model
    from framegen.reading.yamltree import KeyPath


def _look(model: Model) -> Iterator[Problem]:
    spec, sent = model.spec, model.roles.sent
    first: dict[str, KeyPath] = {}
    for name, message in spec.messages.items():
        declared = message.method is not None
        path: KeyPath = ("messages", name, "method") if declared else ("messages", name)
        if message.direction != sent:
            if declared:
                what = f"{name} goes {message.direction}, and a client sends {sent}"
                yield Problem(path, what, "only what a client sends has a method")
            continue
        yield from _name(path, method_of(name, message).name, first, declared=declared)
        if message.method is not None:
            frame = spec.envelopes[spec.frame_of(message)]
            yield from _arguments(path, name, message, frame)
            yield from _result(path, name, message, spec)
    for key in ("hold", "present", "targets") if spec.pose is not None else ():
        yield from _name(("pose", key), getattr(spec.pose, key), first, declared=True)


def _name(
    path: KeyPath, name: str, first: dict[str, KeyPath], *, declared: bool
) -> Iterator[Problem]:
    there = first.setdefault(name, path)
    if there != path:
        hint = "choose another name" if declared else "give the message a `method`"
        also = (there, "the first is here")
        yield Problem(path, f"there are two methods called `{name}`", hint, not declared, also)


def _arguments(path: KeyPath, name: str, message: Message, frame: Frame) -> Iterator[Problem]:
    known = arguments_of(message)
    given = list(message.method.arguments) if message.method else []
    for argument in dict.fromkeys(given):
        if argument not in known:
            yield Problem(path, *_unknown(name, argument, known, frame))
        elif given.count(argument) > 1:
            yield Problem(path, f"`{argument}` is given twice", "name each argument once")
    missing = [argument for argument in known if argument not in given]
    if missing:
        what = f"the method leaves out {' and '.join(f'`{each}`' for each in missing)}"
        yield Problem(path, what, "name every field but the count")


def _unknown(name: str, argument: str, known: list[str], frame: Frame) -> tuple[str, str]:
    """Say what is wrong with an argument that the message does not have."""
    part = frame.get(argument)
    if isinstance(part, AddressPart):
        what = f"`{argument}` is the address, the first argument of every method"
        return what, "leave it out: a method names the fields alone"
    if isinstance(part, CounterPart):
        return f"`{argument}` is a running number, which a client counts", "leave it out"
    return f"{name} has no argument `{argument}`", did_you_mean(argument, known)


def _result(path: KeyPath, name: str, message: Message, spec: Spec) -> Iterator[Problem]:
    result = message.method.result if message.method else ""
    if not result:
        return
    if message.reply is None:
        what = f"{name} has no reply that could have `{result}`"
        yield Problem(path, what, "declare its `reply`, or leave out the result")
        return
    reply = spec.messages.get(message.reply)
    known = [] if reply is None else arguments_of(reply)
    if reply is not None and result not in known:
        what = f"{message.reply} has no `{result}` to return"
        yield Problem(path, what, did_you_mean(result, known))


RULE = ModelRule(
    id="method",
    title="Every message that a client sends can be a method of the client",
    why="A client has one method for each message, with the fields as arguments: one of two equal "
    "names would be lost, and a field that is left out could not be sent.",
    bad="LampsSet: {method: set_lamps(lamps)}",
    good="LampsSet: {method: set_lamps(lamps, fade_ms)}",
    look=_look,
)
