"""What authors do to messages, to the ends of the line, and to what is said of a conversation."""

from collections.abc import Callable
from functools import partial

from tests.factories import Data
from tests.mutations.authors import MARK
from tests.mutations.desk import Desk, copied, in_words, renamed_in, reordered


def _ids_of(desk: Desk, message: Data) -> list[str]:
    parts = desk.parts_of(message)
    return [name for name, part in parts.items() if part["is"] == "id" and part.get("sent", True)]


def _renumber(desk: Desk, message: Data) -> None:
    """Give a message an id that no other has."""
    name = desk.pick(_ids_of(desk, message))
    said = message["id"]
    taken = {
        each["id"] if isinstance(each["id"], int) else each["id"].get(name)
        for each in desk.messages.values()
        if "id" in each
    }
    free = desk.pick(set(range(1, 200)) - taken)
    message["id"] = {**said, name: free} if isinstance(said, dict) else free


def _element_names(desk: Desk, message: Data) -> None:
    for field in message["fields"].values():
        if "element" in field:
            field["element"] = desk.fresh("Element")


def added(desk: Desk) -> None:
    message = copied(desk.one_of(desk.messages))
    _renumber(desk, message)
    message.pop("method", None)
    _element_names(desk, message)
    desk.messages[desk.fresh("Added")] = message


def taken_away(desk: Desk) -> None:
    del desk.messages[desk.pick(desk.messages)]


def renumbered(desk: Desk) -> None:
    _renumber(desk, desk.one_of(desk.messages))


def ids_swapped(desk: Desk) -> None:
    with_id = [each for each in desk.messages.values() if "id" in each]
    one = desk.pick(with_id)
    like = [one.get(key) for key in ("direction", "frame")]
    same = [each for each in with_id if [each.get(key) for key in ("direction", "frame")] == like]
    other = desk.pick(each for each in same if each["id"] != one["id"])
    one["id"], other["id"] = other["id"], one["id"]


def turned_round(desk: Desk) -> None:
    message = desk.one_of(desk.messages)
    sender, _, receiver = message["direction"].partition(" -> ")
    message["direction"] = f"{receiver} -> {sender}"


def moved(desk: Desk) -> None:
    names = [*desk.messages]
    desk.chance.shuffle(names)
    reordered(desk.messages, names)


def _renamed(said: bool, desk: Desk, *, renumbered: bool = False) -> None:
    name = desk.pick(desk.messages)
    if renumbered:
        _renumber(desk, desk.messages[name])
    desk.rename_message(name, desk.fresh("Renamed"), said=said)


def _replaced(alike: bool, desk: Desk) -> None:
    """Another message has the id of one that is gone, and perhaps its layout."""
    name = desk.pick(desk.messages)
    other = copied(desk.messages[name])
    other.pop("method", None)
    if alike:
        _element_names(desk, other)
    else:
        other["fields"] = {desk.fresh("only"): {"type": "u8", "about": "Something else."}}
    del desk.messages[name]
    desk.messages[desk.fresh("Alike" if alike else "Another")] = other


def split(desk: Desk) -> None:
    """A message has its first field only, and a new one has the others."""
    message = desk.pick(each for each in desk.messages.values() if len(each["fields"]) > 1)
    first, *others = message["fields"]
    rest = copied(message)
    for name in others:
        del message["fields"][name]
    del rest["fields"][first]
    for each in (message, rest):
        each.pop("method", None)
    _renumber(desk, rest)
    _element_names(desk, rest)
    desk.messages[desk.fresh("Rest")] = rest


# What only says something of what the client sends.
_ANSWERED = ("reply", "refusal", "failure", "echoed", "asks_for")
_OF_A_CLIENT = (*_ANSWERED, "acknowledged", "lasts", "method")


def end_renamed(desk: Desk) -> None:
    ends = desk.spec["endpoints"]
    old = desk.pick(ends)
    new = desk.fresh("end")
    renamed_in(ends, old, new)
    for message in desk.messages.values():
        message["direction"] = in_words(message["direction"], old, new)


def ends_in_other_order(desk: Desk) -> None:
    reordered(desk.spec["endpoints"], reversed([*desk.spec["endpoints"]]))
    for message in desk.messages.values():
        for key in _OF_A_CLIENT:
            message.pop(key, None)


def end_added(desk: Desk) -> None:
    desk.spec["endpoints"][desk.fresh("third")] = {MARK: 0, "about": "Listens."}


def _dropped(key: str, desk: Desk) -> None:
    desk.pick(each for each in desk.messages.values() if each.get(key)).pop(key)


def reply_changed(desk: Desk) -> None:
    message = desk.pick(each for each in desk.messages.values() if "reply" in each)
    others = {each["reply"] for each in desk.messages.values() if "reply" in each}
    message["reply"] = desk.pick(others - {message["reply"]})
    for key in ("echoed", "asks_for", "method"):
        message.pop(key, None)


def _said(key: str, text: str, desk: Desk) -> None:
    desk.one_of(desk.messages)[key] = text


MESSAGE_MUTATIONS: dict[str, Callable[[Desk], None]] = {
    "a message added": added,
    "a message removed": taken_away,
    "a message renumbered": renumbered,
    "ids of messages swapped": ids_swapped,
    "a message turned round": turned_round,
    "messages in another order": moved,
    "a message renamed, said": partial(_renamed, True),
    "a message renamed, unsaid": partial(_renamed, False),
    "a message renamed and renumbered, said": partial(_renamed, True, renumbered=True),
    "a message renamed and renumbered, unsaid": partial(_renamed, False, renumbered=True),
    "a message replaced by another": partial(_replaced, False),
    "a message replaced by another like it": partial(_replaced, True),
    "a message split in two": split,
    "an end renamed": end_renamed,
    "ends in another order": ends_in_other_order,
    "an end added": end_added,
    "a message deprecated": partial(_said, "deprecated", "Use another."),
    "a reply changed": reply_changed,
    "a vendor's name": partial(_said, "vendor_name", "CMD_OTHER"),
    **{
        f"{key} dropped": partial(_dropped, key)
        for key in (*_ANSWERED, "reports", "acknowledged", "lasts", "method")
    },
}
