"""A client for asyncio whose port is still to be opened."""

from __future__ import annotations

from types import TracebackType
from typing import TYPE_CHECKING, Generic, TypeVar

from .line_threads import opened

if TYPE_CHECKING:
    from collections.abc import Callable, Generator
    from typing import Any

    from ..line.transport import Transport
    from .async_client import AsyncClient

_Client = TypeVar("_Client", bound="AsyncClient")
_HOW = "enter it with `async with`, or await it"


class Awaited(Generic[_Client]):
    """A client that is about to be opened: by `await`, or better by `async with`."""

    def __init__(
        self, opener: Callable[[], Transport], make: Callable[[Transport], _Client]
    ) -> None:
        self._open = opener
        self._make = make
        self._client: _Client

    def __await__(self) -> Generator[Any, None, _Client]:
        return self._opened().__await__()

    async def __aenter__(self) -> _Client:
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
        await self._client.__aexit__(kind, error, traceback)

    async def _opened(self) -> _Client:
        # Opening may take a while (a socket, a slow adapter), and would block the loop.
        transport = await opened(self._open)
        try:
            self._client = self._make(transport)
        except BaseException:
            transport.close()
            raise
        return await self._client.__aenter__()
