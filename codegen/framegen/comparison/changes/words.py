"""Change: something is described in other words."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from pydantic import BaseModel

from framegen.comparison.changes.change import Change, ChangeRule
from framegen.comparison.changes.wording import called
from framegen.language.spec import Note

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.things import Twin
    from framegen.reading.yamltree import KeyPath

_WORDS = ("title", "summary", "description", "about", "vendor_name", "text", "why", "here", "what")


def _differs(twin: Twin[Any], key: str) -> bool:
    # What a kind of thing does not have is nothing; pydantic is slow to say so.
    return bool(vars(twin.old).get(key) != vars(twin.new).get(key))


def _change(twin: Twin[Any], key: KeyPath) -> Change:
    what = f"`{key[0]}` " if key else ""
    text = f"{called(twin.new_path)}: {what}in other words"
    return Change("words", (*twin.old_path, *key), (*twin.new_path, *key), text)


def _look(both: Both) -> Iterator[Change]:
    for twin in both.everything():
        if isinstance(twin.old, BaseModel):
            # The text of a field is another thing than that of a note.
            keys = (key for key in _WORDS if key != "text" or isinstance(twin.old, Note))
            yield from (_change(twin, (key,)) for key in keys if _differs(twin, key))


RULE = ChangeRule(
    id="words",
    title="Something is described in other words",
    subject="document",
    why="It is for readers alone, on pages and in docstrings.",
    do="Nothing.",
    at="messages.LampRead",
    before="summary: Ask for the level of a lamp.",
    after="summary: Ask how bright a lamp is.",
    look=_look,
)
