"""The examples in the docstrings of both clients are executed, against a board in memory."""

from __future__ import annotations

import ast
import asyncio
import doctest
import inspect
from typing import TYPE_CHECKING, Any

import pytest
from busservo import AsyncController, Controller
from busservo._exchanges import EXCHANGES

from tests.in_turn import in_turn
from tests.lines.live_line import LiveLine
from tests.timeouts import LIVE

if TYPE_CHECKING:
    from framewire.client.exchange import Exchange

METHODS = [pytest.param(each, id=each.method) for each in EXCHANGES.values()]


def examples(client: type, exchange: Exchange) -> list[doctest.Example]:
    method = getattr(client, exchange.method)
    found = doctest.DocTestParser().get_examples(inspect.getdoc(method) or "")
    assert found, f"{exchange.method} shows no example"
    return found


@in_turn("exchange", lambda: METHODS)
def test_the_examples_of_the_client_for_threads(exchange: Exchange) -> None:
    with Controller(LiveLine(), **LIVE) as controller:
        names: dict[str, Any] = {"controller": controller}
        for example in examples(Controller, exchange):
            if example.want:
                assert f"{eval(example.source, names)!r}\n" == example.want  # noqa: S307 - our own
            else:
                exec(example.source, names)  # noqa: S102 - our own


@in_turn("exchange", lambda: METHODS)
def test_the_examples_of_the_client_for_asyncio(exchange: Exchange) -> None:
    async def run() -> None:
        async with AsyncController(LiveLine(), **LIVE) as controller:
            names: dict[str, Any] = {"controller": controller}
            for example in examples(AsyncController, exchange):
                flags = ast.PyCF_ALLOW_TOP_LEVEL_AWAIT
                mode = "eval" if example.want else "exec"
                code = compile(example.source.strip(), "example", mode, flags)
                result = eval(code, names)  # noqa: S307 - our own
                value = await result if inspect.isawaitable(result) else result
                if example.want:
                    assert f"{value!r}\n" == example.want

    asyncio.run(run())


@in_turn("exchange", lambda: METHODS)
def test_both_clients_take_the_same_arguments(exchange: Exchange) -> None:
    one, other = (
        inspect.signature(getattr(kind, exchange.method)).parameters
        for kind in (Controller, AsyncController)
    )
    assert one == other
    latest = () if exchange.lasts is None else ("latest",)
    assert tuple(one)[1:] == (*exchange.arguments, *latest)
