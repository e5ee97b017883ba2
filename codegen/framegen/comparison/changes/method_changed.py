"""Change: the method or the verb that sends a message is another."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import Change, ChangeRule
from framegen.comparison.changes.telling import changed
from framegen.comparison.changes.wording import became, called, signature
from framegen.language.values import Method
from framegen.model.exchanges import method_of

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both


def _look(both: Both) -> Iterator[Change]:
    for each in both.messages.twins:
        name = str(each.old_path[1])
        was, now = each.old.method, each.new.method
        if was is not None:
            reply = "" if each.old.reply is None else each.old.reply
            result = both.field(reply, was.result) if was.result else ""
            arguments = tuple(str(both.field(name, one)) for one in was.arguments)
            was = Method(was.name, arguments, result or "")
        if was != now:
            old, new = (
                signature(method_of(str(path[1]), message))
                for path, message in ((each.old_path, each.old), (each.new_path, each.new))
            )
            said = f"method {new}, named or not" if old == new else became("method", old, new)
            text = f"{called(each.new_path)}: {said}"
            yield Change(
                "method-changed", (*each.old_path, "method"), (*each.new_path, "method"), text
            )
        old_verb, new_verb = each.old.verb, each.new.verb
        yield from changed("method-changed", each, "verb", old_verb, new_verb, "verb")


RULE = ChangeRule(
    id="method-changed",
    title="The method or the verb that sends a message is another",
    subject="program",
    why="Programs call it by name, give arguments by place, and use what it returns; scripts of a "
    "shell have its verb.",
    do="Keep name and order. Where the result must change, add a message.",
    at="messages.LampsSet",
    before="",
    after="method: set_lamps(lamps)",
    look=_look,
)
