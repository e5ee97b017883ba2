"""The result of a command whose effect takes a time that it says: when it will be over."""

from __future__ import annotations

from collections.abc import Awaitable, Callable, Generator

from ..line.link_errors import TransportError
from .request import Request, Sent
from .wire_time import WireTime

TYPE_CHECKING = False
if TYPE_CHECKING:
    import typing_extensions as typing

    from .base_client import Steps
else:
    from ..frame.typing_later import typing

# What is waited for, one thing after the other.
_Ending: typing.TypeAlias = Generator[Request | float | None, None, bool]


class Timed(Sent):
    """A command that starts something which goes on for `lasts` seconds.

    Its end is calculated from when the last byte has left and from what the command says: nothing
    on the line reports it. What cannot be done in that time takes longer.

    If it was sent with `latest`, it may still wait for the line: `delay` is then how long it will
    wait at least, and `ends_at` is not known yet.
    """

    __slots__ = ("_check", "_clock", "_request", "lasts")

    def __init__(
        self,
        request: Request,
        wire_time: WireTime,
        clock: Callable[[], float],
        check: Callable[[], None],
    ) -> None:
        duration = wire_time.seconds(len(request.message.encode()))
        sent = request.sent
        delay = max(0.0, wire_time.free_at - clock()) if sent is None else sent.delay
        super().__init__(request.message, delay, duration)
        self.lasts = request.exchange.seconds(request.message)
        self._request = request
        self._clock = clock
        # Raises the error of a line that is lost or closed.
        self._check = check

    @property
    def ends_at(self) -> float | None:
        """When it is over, on the clock of the client; None before it is sent, or if it never is.

        That clock is `time.monotonic`, unless the client was given another.
        """
        return None if self._request.sent is None else self._request.left_at + self.lasts

    @property
    def remaining(self) -> float | None:
        """The seconds until it is over, and 0.0 from then on; None while `ends_at` is None."""
        ends_at = self.ends_at
        return None if ends_at is None else max(0.0, ends_at - self._clock())

    @property
    def replaced(self) -> bool:
        """Whether a newer one has taken its place before it left, so that it never began."""
        request = self._request
        return request.done and request.sent is None and request.error is None

    def _over(self) -> bool:
        """Return whether there is nothing left to wait for. Raises the error that stopped it."""
        error = self._request.error
        if error is not None:
            raise error.again() if isinstance(error, TransportError) else error
        return self.replaced or self.remaining == 0.0

    def _until_over(self) -> Steps[bool]:
        """Wait until it is over; whether it has been carried out."""
        while not self._over():
            self._check()
            yield self.ends_at
        return not self.replaced

    def __repr__(self) -> str:
        return f"{super().__repr__()[:-1]}, lasts={self.lasts})"


class Motion(Timed):
    """A command that starts something which goes on for `lasts` seconds; it can be waited for."""

    __slots__ = ("_finish",)

    def __init__(self, *what: typing.Any, finish: Callable[[_Ending], bool]) -> None:
        super().__init__(*what)
        self._finish = finish

    def wait(self) -> bool:
        """Wait until it is over: return True, or False if a newer one has taken its place.

        Reports that come meanwhile are kept. Raises TransportError if the line is lost or closed
        before the end.
        """
        return self._finish(self._until_over())


class AsyncMotion(Timed):
    """A command that starts something which goes on for `lasts` seconds; it can be waited for."""

    __slots__ = ("_finish",)

    def __init__(self, *what: typing.Any, finish: Callable[[_Ending], Awaitable[bool]]) -> None:
        super().__init__(*what)
        self._finish = finish

    async def wait(self) -> bool:
        """Wait until it is over: return True, or False if a newer one has taken its place.

        Reports that come meanwhile are kept. Raises TransportError if the line is lost or closed
        before the end.
        """
        return await self._finish(self._until_over())
