"""What a device might take for something that may not be sent, in the frames of one envelope."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from framegen.language.values import to_hex

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator

    from framegen.language.notation import Ids
    from framegen.model.envelope import Envelope
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Candidates, Model


@dataclass(frozen=True)
class Danger:
    """The messages in one envelope that may not be sent, and how a device might find them.

    Where constants begin a frame and ids tell the message, a device may go by these alone, and test
    nothing else. Otherwise it can only find whole frames.
    """

    model: Model
    candidates: Candidates
    allowed: Collection[str]

    @property
    def frame(self) -> Envelope:
        """The envelope."""
        return self.candidates.frame

    @cached_property
    def forbidden(self) -> list[MessageLayout]:
        """The messages that may not be sent."""
        return [each for each in self.candidates.messages if each.name not in self.allowed]

    @cached_property
    def head(self) -> int:
        """How many bytes tell that a frame begins, and which message it is, as far as ids do."""
        header = len(self.frame.header)
        return max([header, *(part.at + part.size for part in self.frame.sent_ids)])

    def begun(self, data: bytes) -> str:
        """Return what begins in `data` for a device that goes by constants and ids alone."""
        if not (self.frame.header and self.frame.sent_ids):
            return ""
        for at in self._headers(data, range(len(data))):
            found = self.meanings.get(self._ids(data, at))
            if found is not None:
                return f"{to_hex(data[at : at + self.head])}, which begins {found}"
        return ""

    def places(self, data: bytes, places: range) -> list[int]:
        """Return where a forbidden message may begin, as far as constants and ids tell."""
        if not self.forbidden:
            return []
        begun = self._headers(data, places)
        return [at for at in begun if not self.frame.sent_ids or self._ids(data, at) in self._known]

    def _headers(self, data: bytes, places: range) -> Iterator[int]:
        header = self.frame.header
        at = data.find(header, places.start)
        while 0 <= at < min(places.stop, len(data)):
            yield at
            at = data.find(header, at + 1)

    def _ids(self, data: bytes, at: int) -> tuple[int, ...]:
        """Return the ids of what begins at `at`; none where they are not all there."""
        begun = data[at : at + self.frame.body_at]
        if not all(part.is_in(begun) for part in self.frame.sent_ids):
            return ()
        return tuple(part.read_in(begun) for part in self.frame.sent_ids)

    def sent_ids(self, message: MessageLayout) -> tuple[int, ...]:
        """Return the ids of a message that are sent."""
        return message.ids[: len(self.frame.sent_ids)]

    @cached_property
    def _known(self) -> set[tuple[int, ...]]:
        return {self.sent_ids(message) for message in self.forbidden}

    @cached_property
    def meanings(self) -> dict[tuple[int, ...], str]:
        """By ids, what a device might do that nothing allowed does."""
        spec, received = self.model.spec, self.model.roles.received
        found: dict[tuple[int, ...], str] = {}
        if len(self.frame.sent_ids) == 1:
            found |= {
                (code,): f"a frame of id {code}, as in {lookalike.title}"
                for lookalike in spec.lookalikes.values()
                for code in lookalike.commands
            }
        for each in spec.reserved:
            if each.id is not None and each.direction != received and (ids := self._of(each.id)):
                found[ids] = f"a frame of the reserved id {each.id}"
        found |= {self.sent_ids(each): f"a frame of {each.name}" for each in self.forbidden}
        messages = self.candidates.messages
        harmless = {self.sent_ids(each) for each in messages if each.name in self.allowed}
        return {ids: what for ids, what in found.items() if ids not in harmless}

    def _of(self, ids: Ids) -> tuple[int, ...]:
        """Return ids as this envelope has them; none where it has others."""
        if ids.one is not None:
            return (ids.one,) if len(self.frame.sent_ids) == 1 else ()
        by_part = dict(ids.by_part)
        found = tuple(by_part[part.name] for part in self.frame.sent_ids if part.name in by_part)
        return found if len(found) == len(self.frame.sent_ids) else ()

    def unknown(self, message: MessageLayout) -> int | None:
        """Return a last id that makes the others of a message those of none; None without one."""
        if not self.frame.sent_ids:
            return None
        *front, _ = self.sent_ids(message)
        every = self.model.messages.values()
        known = {self.sent_ids(each) for each in every if each.frame.id_part is not None}
        # A byte of the header there could begin a header.
        last, taken = self.frame.sent_ids[-1], known | self.meanings.keys()
        free = (
            code
            for code in range(last.high, max(last.low, last.high - 0x1000) - 1, -1)
            if (*front, code) not in taken and not set(last.write(code)) & set(self.frame.header)
        )
        return next(free, None)
