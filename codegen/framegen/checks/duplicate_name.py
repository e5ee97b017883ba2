"""Rule: no two classes have the same name."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.named import classes
from framegen.checks.rule import Problem, StructureRule

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import Spec
    from framegen.reading.yamltree import KeyPath


def _look(spec: Spec) -> Iterator[Problem]:
    # Compared in lower case, since ServoMove and Servomove become one word where they are
    # functions, and one file on Windows and macOS.
    first: dict[str, tuple[KeyPath, str]] = {}
    for path, name, on_key in classes(spec):
        there, other = first.setdefault(name.lower(), (path, name))
        if there != path:
            message = (
                f"there are two classes called `{name}`"
                if name == other
                else f"`{name}` and `{other}` differ only in capitals"
            )
            yield Problem(
                path, message, "choose another name", on_key, (there, "the first is here")
            )


RULE = StructureRule(
    id="duplicate-name",
    title="No two classes have the same name",
    why="Messages and elements become classes in one module: one of two equal names would be lost.",
    bad="messages: {LampRead: {...}, Lampread: {...}}",
    good="messages: {LampRead: {...}, LampState: {...}}",
    look=_look,
)
