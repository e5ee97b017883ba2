"""What a client sends by default: less than the wire carries, for safety."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from framegen.language.values import Range
    from framegen.model.layout import MessageLayout


@dataclass(frozen=True, slots=True)
class SendingLimits:
    """The usual limits, those of other devices by whose they are, and the fields they are of.

    `fields` has the paths of the fields (`targets.position`) by the message that they are in.
    """

    usual: Range
    others: Mapping[str, Range]
    fields: Mapping[str, Sequence[str]]


def sending_limits(requests: Iterable[MessageLayout]) -> SendingLimits | None:
    """Return the limits of what a client sends, which are the same for every field; None for none.

    That they are the same is a rule of `framegen check`.
    """
    limited = {each.name: each.limited for each in requests if each.limited}
    if not limited:
        return None
    limits = next(each for fields in limited.values() for each in fields.values())
    return SendingLimits(
        limits.usual, limits.others, {name: [*fields] for name, fields in limited.items()}
    )
