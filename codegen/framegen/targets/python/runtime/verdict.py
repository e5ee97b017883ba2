"""What can be told of bytes as the beginning of a frame."""

from __future__ import annotations

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from .errors import Reason
    from .message import Message


class Verdict:
    """What bytes begin: a message, no frame at all, or what more of them may make one.

    Of a message, `kind` is its class and `size` that of its frame. Of anything else, `reason` and
    `offset` say why it is none and at which byte that shows. `size` is then the number of bytes that
    show it or, of what is only too short, the number at which more can be told. `claim` is the size
    of the frame that an unknown command would have.
    """

    __slots__ = ("claim", "kind", "offset", "reason", "size")

    def __init__(
        self,
        kind: type[Message] | None,
        reason: Reason | None,
        offset: int,
        size: int,
        claim: int = 0,
    ) -> None:
        self.kind = kind
        self.reason = reason
        self.offset = offset
        self.size = size
        self.claim = claim
