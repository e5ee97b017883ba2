"""Open a port for asyncio, and return a client of the device behind it."""

from __future__ import annotations

from collections.abc import Iterable
from functools import partial
from os import PathLike
from types import TracebackType
from typing import TYPE_CHECKING

from .._frame.protocol import BAUD, LOCAL_ECHO
from .._serial.opening import open_transport
from .async_controller import AsyncController
from .base_client import REPLY_TIMEOUT, REPORT_LIMIT
from .exchanges import LIMITS
from .limits import Allowed
from .line_threads import opened

if TYPE_CHECKING:
    from collections.abc import Callable, Generator
    from typing import Any

    from .._serial.transport import Transport

_HOW = "enter open_async_controller() with `async with`, or await it"


class Opening:
    """A client that is about to be opened: by `await`, or better by `async with`."""

    def __init__(
        self, opener: Callable[[], Transport], make: Callable[[Transport], AsyncController]
    ) -> None:
        self._open = opener
        self._make = make
        self._controller: AsyncController

    def __await__(self) -> Generator[Any, None, AsyncController]:
        return self._opened().__await__()

    async def __aenter__(self) -> AsyncController:
        return await self._opened()

    if not TYPE_CHECKING:

        def __getattr__(self, name: str) -> object:
            problem = f"the client is not open yet, and has no {name!r}"
            raise AttributeError(f"{problem}: {_HOW}", name=name, obj=self)

        def __enter__(self) -> object:
            raise TypeError(f"the client is not open yet: {_HOW}")

        def __exit__(self, *_: object) -> None: ...

    async def __aexit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        await self._controller.__aexit__(kind, error, traceback)

    async def _opened(self) -> AsyncController:
        # Opening may take a while (a socket, a slow adapter), and would block the loop.
        transport = await opened(self._open)
        try:
            self._controller = self._make(transport)
        except BaseException:
            transport.close()
            raise
        return await self._controller.__aenter__()


def open_async_controller(
    port: str,
    *,
    baud: float = BAUD,
    exclusive: bool = True,
    reply_timeout: float = REPLY_TIMEOUT,
    retries: int = 0,
    trace: str | PathLike[str] | None = None,
    report_limit: int = REPORT_LIMIT,
    limits: Allowed = LIMITS.usual,
    ids: Iterable[int] = (),
    on_exit: str | None = None,
    local_echo: bool = LOCAL_ECHO,
    settle: float | None = None,
) -> Opening:
    """Open the port of a device, to be used in an `async with`.

    It may also be awaited, and the client closed by hand. The arguments and the errors are those of
    open_controller; the errors come when it is entered or awaited.
    """
    opener = partial(open_transport, port, baud=baud, exclusive=exclusive)
    make = partial(
        AsyncController,
        baud=baud,
        reply_timeout=reply_timeout,
        retries=retries,
        trace=trace,
        report_limit=report_limit,
        limits=limits,
        ids=ids,
        on_exit=on_exit,
        local_echo=local_echo,
        settle=settle,
    )
    return Opening(opener, make)
