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
    If it is `proven`, there is such a frame, and it has `size` bytes. `whole` is the frame that is
    there if the line is quiet, where a longer one may come.
    """

    __slots__ = ("claim", "is_open", "kind", "offset", "proven", "reason", "size", "whole")

    def __init__(
        self,
        kind: type[Message] | None,
        reason: Reason,
        offset: int,
        size: int,
        *,
        claim: int = 0,
        is_open: bool = False,
        proven: bool = False,
        whole: Verdict | None = None,
    ) -> None:
        self.kind = kind
        self.reason = reason
        self.offset = offset
        self.size = size
        self.claim = claim
        self.is_open = is_open
        self.proven = proven
        self.whole = whole
