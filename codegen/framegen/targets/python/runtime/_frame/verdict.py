"""A verdict on the beginning of a frame."""

from __future__ import annotations

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from .errors import Reason
    from .message import Message


class Verdict:
    """What bytes begin: a message, no frame at all, or a frame that is not complete.

    For a message, `kind` is its class and `size` that of its frame; `reason` and `offset` say what
    is wrong if anything follows. Otherwise they say why it is no message and where that shows.
    While it `is_open`, more bytes may change the verdict: `size` is the number at which it can be
    judged further. Otherwise `size` is the number of bytes that show it. `claim` is the size that a
    frame of unknown command would have.
    """

    __slots__ = ("claim", "is_open", "kind", "offset", "reason", "size")

    def __init__(
        self,
        kind: type[Message] | None,
        reason: Reason,
        offset: int,
        size: int,
        *,
        claim: int = 0,
        is_open: bool = False,
    ) -> None:
        self.kind = kind
        self.reason = reason
        self.offset = offset
        self.size = size
        self.claim = claim
        self.is_open = is_open
