"""Rule: the messages that read, command and release positions have the same fields."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.rule import ModelRule, Problem
from framegen.language.number_types import NUMBER_TYPES
from framegen.language.spec import ListField, NumberField
from framegen.model.exchanges import arguments_of
from framegen.reading.findings import did_you_mean

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import Message, Pose, Spec
    from framegen.model.model import Model
    from framegen.reading.yamltree import KeyPath


def _look(model: Model) -> Iterator[Problem]:
    spec = model.spec
    if spec.pose is None:
        return
    found = list(_messages(model, spec.pose))
    yield from found
    if found:
        return
    read, move, release = (
        spec.messages[name] for name in (spec.pose.read, spec.pose.move, spec.pose.release)
    )
    requested = _lone_list(read)
    reported = None if requested is None else _reported(spec, read, requested)
    if requested is None or reported is None:
        what = f"{spec.pose.read} does not request positions by a list of numbers alone"
        hint = "its reply has to repeat the list (`echoed`) in elements of a number and a position"
        yield Problem(("pose", "read"), what, hint)
        return
    yield from _ids(spec.pose, read.fields[requested])
    yield from _move(spec.pose.move, move, reported)
    yield from _texts(spec, spec.pose)
    if requested in arguments_of(move) and move.fields[requested].counted_by is None:
        what = f"`{spec.pose.hold}` would have two arguments named `{requested}`"
        hint = f"give them different names in {spec.pose.read} and {spec.pose.move}"
        yield Problem(("pose", "hold"), what, hint)
    if _lone_list(release) != requested:
        what = f"{spec.pose.release} does not release a list `{requested}` alone"
        yield Problem(("pose", "release"), what, f"{spec.pose.read} has `{requested}`")


def _messages(model: Model, pose: Pose) -> Iterator[Problem]:
    sent = [message.name for message in model.sent(model.roles.sent)]
    for key in ("read", "move", "release"):
        name: str = getattr(pose, key)
        if name not in sent:
            there = "is no message of a client's" if name in model.messages else "is no message"
            yield Problem(("pose", key), f"`{name}` {there}", did_you_mean(name, sent))
    if pose.release == pose.read:
        what = f"{pose.read} requests positions, and cannot release them as well"
        yield Problem(("pose", "release"), what, "name the message that releases them")


def _lone_list(message: Message) -> str | None:
    """Return the list of numbers, if it is all that the message is given."""
    names = arguments_of(message)
    if len(names) != 1:
        return None
    field = message.fields[names[0]]
    is_number = isinstance(field, NumberField) and field.text is None
    return names[0] if is_number and field.counted_by is not None else None


def _reported(spec: Spec, read: Message, requested: str) -> list[str] | None:
    """Return the fields of an element of the reply: the requested number, and its position."""
    reply = None if read.reply is None else spec.messages.get(read.reply)
    name, _, inner = read.echoed.get(requested, "").partition(".")
    items = None if reply is None else reply.fields.get(name)
    if not isinstance(items, ListField):
        return None
    fields = list(items.fields)
    return fields if len(fields) == 2 and fields[0] == inner else None


def _ids(pose: Pose, field: NumberField | ListField) -> Iterator[Problem]:
    type_ = NUMBER_TYPES.get(getattr(field, "type", ""))
    low, high = pose.ids.low, pose.ids.high
    if high is None or low > high:
        what = f"the ids {pose.ids} have no end, or end before they begin"
        yield Problem(("pose", "ids"), what, "write both ends, like 1..253")
    elif type_ is not None and not type_.low <= low <= high <= type_.high:
        what = f"{pose.ids} is outside {type_.low}..{type_.high}, which {type_.name} holds"
        yield Problem(("pose", "ids"), what, "keep them inside the type")


def _move(name: str, move: Message, reported: list[str]) -> Iterator[Problem]:
    given = {key: move.fields[key] for key in arguments_of(move)}
    lists = [field for field in given.values() if isinstance(field, ListField)]
    if [list(items.fields) for items in lists] != [reported]:
        what = f"{name} has no list of elements with the fields {' and '.join(reported)}"
        yield Problem(("pose", "move"), what, "name the fields as in the reply")
    numbers = [field for field in given.values() if isinstance(field, NumberField)]
    if len(numbers) != 1 or numbers[0].counted_by is not None:
        what = f"{name} does not have one number besides the list"
        yield Problem(("pose", "move"), what, "it has to be the time of the motion in milliseconds")


def _texts(spec: Spec, pose: Pose) -> Iterator[Problem]:
    """Find text among what is read and commanded."""
    reply = spec.messages[pose.read].reply or ""
    for key, message in (("read", reply), ("move", pose.move)):
        for path, name, field in _given(spec, message):
            if field.text is not None:
                what = f"`{name}` of {message} is text, and a pose is made of numbers"
                hint = "describe it as a number, or leave out `pose`"
                yield Problem(path, what, hint, True, (("pose", key), "the pose is here"))


def _given(spec: Spec, message: str) -> Iterator[tuple[KeyPath, str, NumberField]]:
    """Yield the numbers and texts that a message is given, those of elements as well."""
    for name in arguments_of(spec.messages[message]):
        path, field = ("messages", message, "fields", name), spec.messages[message].fields[name]
        if isinstance(field, NumberField):
            yield path, name, field
            continue
        for inner, number in field.fields.items():
            yield (*path, "fields", inner), inner, number


RULE = ModelRule(
    id="pose",
    title="The messages that read, command and release positions have the same fields",
    why="A client holds the positions that it has read, and plays those that were recorded: the "
    "fields of a reply have to be those that a command takes.",
    bad="pose: {read: LampRead, move: FansSet, ...}",
    good="pose: {read: LampsRead, move: LampsSet, ...}",
    look=_look,
)
