"""An effect: something that users of a protocol notice when one edition takes another's place."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

if TYPE_CHECKING:
    from collections.abc import Mapping

    from framegen.reading.yamltree import KeyPath

Axis: TypeAlias = Literal["wire", "conversation", "programs"]
Which: TypeAlias = Literal["old", "new"]
Outcome: TypeAlias = Literal["same", "in part", "uncertain", "refused", "misread"]

# From the least to the worst. `in part`: all that both editions know is read alike, and one of them
# knows more. `uncertain`: it is read alike if a name was only changed, which nothing says.
OUTCOMES: tuple[Outcome, ...] = ("same", "in part", "uncertain", "refused", "misread")


@dataclass(frozen=True, slots=True)
class Witness:
    """A frame that shows an effect: who sends it, its values, and what the receiver makes of it.

    `sender` is the edition of who sends, `message` and `values` are in its words. `reading` is what
    the receiver, who has the other edition, understands instead, or why it refuses the frame.
    `read_as` are the other messages that the receiver takes it for.
    """

    sender: Which
    data: bytes
    message: str
    values: Mapping[str, Any]
    outcome: Outcome
    reading: str
    read_as: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Effect:
    """Something that changes for users: on one axis, for one pair of ends, at one place.

    `old` and `new` are the paths in the two editions, None where an edition has no such thing.
    `outcome` is a word or two for programs (`refused`, `no reply`, `removed`); `text` says it in a
    sentence. `ends` says between whom: `old host, new controller`; of a program it is empty.
    `breaks` is False where only what is new is not understood by who does not know it yet.
    `certain` is False where a name that changed may be another thing. `accepted` is the reason for
    which the history of the spec accepts it. `editions` are the kept ones that show it, where the
    one that is compared does not. `remedy` says what to do, besides what changes explain.
    """

    axis: Axis
    outcome: str
    old: KeyPath | None
    new: KeyPath | None
    text: str
    ends: str = ""
    breaks: bool = True
    certain: bool = True
    witness: Witness | None = None
    accepted: str = ""
    editions: tuple[str, ...] = ()
    remedy: str = ""

    @property
    def path(self) -> KeyPath:
        """The path in the new edition, or in the old where it is gone."""
        return self.new or self.old or ()
