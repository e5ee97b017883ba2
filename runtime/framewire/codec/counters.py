"""Counters: what a decoder has seen of its stream, and a client of its line, so far."""

from __future__ import annotations


class Counters:
    """Counters of a decoder: bytes fed, messages, bytes of noise, unknown frames within it."""

    __slots__ = ("fed", "messages", "noise", "unknown_frames")

    def __init__(self, fed: int, messages: int, noise: int, unknown_frames: int) -> None:
        self.fed = fed
        self.messages = messages
        self.noise = noise
        self.unknown_frames = unknown_frames

    def __repr__(self) -> str:
        counts = ", ".join(f"{name}={getattr(self, name)}" for name in self.__slots__)
        return f"Counters({counts})"


class LineCounters:
    """Counters of a client, from its creation on; they continue over a reconnection.

    `sent` frames; `replies` that answered a request, and `unsolicited` ones that answered none
    (late ones, and those that came twice); requests with an `impossible` reply, which came sooner
    than the wire allows; `echoes` of what was sent; `reports`, of which nobody took `lost_reports`;
    `noise` bytes; `timeouts` of requests, and `retries` made after them; commands `replaced` by
    newer ones before they left.
    """

    __slots__ = (
        "echoes",
        "impossible",
        "lost_reports",
        "noise",
        "replaced",
        "replies",
        "reports",
        "retries",
        "sent",
        "timeouts",
        "unsolicited",
    )

    def __init__(self) -> None:
        self.sent = 0
        self.replies = 0
        self.unsolicited = 0
        self.impossible = 0
        self.echoes = 0
        self.reports = 0
        self.lost_reports = 0
        self.noise = 0
        self.timeouts = 0
        self.retries = 0
        self.replaced = 0

    def snapshot(self) -> tuple[int, int, int]:
        """Return the counts of all that is no reply: noise bytes, reports, unsolicited replies."""
        return self.noise, self.reports, self.unsolicited

    def __repr__(self) -> str:
        counts = ", ".join(f"{name}={getattr(self, name)}" for name in self.__slots__)
        return f"LineCounters({counts})"
