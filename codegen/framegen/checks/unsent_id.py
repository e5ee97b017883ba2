"""Rule: an id that is not sent is covered by a checksum."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.frames import envelopes
from framegen.checks.rule import Problem, StructureRule
from framegen.language.spec import ChecksumPart, IdPart

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import Spec


def _look(spec: Spec) -> Iterator[Problem]:
    for path, frame in envelopes(spec):
        checksums = {name: each for name, each in frame.items() if isinstance(each, ChecksumPart)}
        for name, part in frame.items():
            if not isinstance(part, IdPart) or part.sent:
                continue
            if all(each.covers and name not in each.covers for each in checksums.values()):
                what = f"`{name}` is not sent, and no checksum covers it: it changes no byte"
                hint = "remove it"
                if checksums:
                    last, each = list(checksums.items())[-1]
                    line = ", ".join([*each.covers, name])
                    hint = f"let `{last}` cover it, in its order: `covers: [{line}]`; or remove it"
                yield Problem((*path, name), what, hint, on_key=True)


RULE = StructureRule(
    id="unsent-id",
    title="An id that is not sent is covered by a checksum",
    why="Some protocols add a number to a checksum that both ends know, one for each message. It "
    "is in no frame, so that a checksum is all that shows it.",
    bad="{seed: {is: id, type: u8, sent: false}, check: {covers: [length, payload], ...}}",
    good="{seed: {is: id, type: u8, sent: false}, check: {covers: [length, payload, seed], ...}}",
    look=_look,
)
