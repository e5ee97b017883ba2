"""Any request: a client sends whole frames that a board understands, or refuses it."""

import math
from contextlib import suppress
from typing import Any

import pytest
from busservo import Controller, EncodeError, IncompleteReplyError, Message, NoReplyError
from busservo._exchanges import EXCHANGES
from busservo.strategies import messages
from hypothesis import given
from hypothesis import strategies as st

from tests.in_turn import in_turn
from tests.lines.at_board import client_at, virtual_board
from tests.lines.both_clients import both

numbers = (
    st.integers()
    | st.integers(-2, 300)
    | st.sampled_from([0, 1, 255, 256, 65535, 65536, -1])
    | st.floats()
    | st.booleans()
    | st.none()
    | st.text(max_size=3)
)
lists = (
    st.lists(numbers, max_size=300)
    | st.lists(st.integers(0, 255), max_size=300)
    | st.lists(st.tuples(numbers, numbers), max_size=100)
    | st.lists(st.tuples(st.integers(0, 255), st.integers(0, 65535)), max_size=100)
    | st.binary(max_size=20)
)
any_call = st.one_of(
    [
        st.tuples(st.just(each), st.tuples(*[numbers | lists for _ in each.arguments]))
        for each in EXCHANGES.values()
    ]
)


def at(board: Any, **more: Any) -> Any:
    return client_at(board, Controller, baud=math.inf, settle=None, **more)


@given(st.lists(any_call, max_size=8))
def test_any_arguments_make_whole_frames_or_are_refused(requests: list[tuple[Any, Any]]) -> None:
    with virtual_board() as board, at(board) as controller:
        for exchange, arguments in requests:
            before = board.accepted
            try:
                with suppress(NoReplyError, IncompleteReplyError):
                    getattr(controller, exchange.method)(*arguments)
            except EncodeError:
                assert board.accepted == before, "what was refused has been sent all the same"
            else:
                assert board.accepted > before
        assert board.rejects.total == 0


@given(st.lists(messages(), max_size=20))
def test_any_message_is_sent_whole_or_refused(requests: list[Message]) -> None:
    with virtual_board() as board, at(board, reply_timeout=0.01) as controller:
        sent = 0
        for message in requests:
            for way in (controller.send, controller.request, controller.send_latest):
                try:
                    with suppress(NoReplyError):
                        way(message)
                    sent += 1
                except (TypeError, EncodeError):
                    continue
        controller.close()
        assert board.accepted + controller.counters.replaced == sent
        assert board.rejects.total == 0


@in_turn("exchange", EXCHANGES.values)
@both()
async def test_nonsense_is_refused_by_both_clients(
    controller: Any, line: Any, exchange: Any
) -> None:
    for wrong in (None, -1, "x", [None], [-1], 1 << 99) if exchange.arguments else ():
        with pytest.raises(EncodeError):
            await getattr(controller, exchange.method)(*[wrong] * len(exchange.arguments))
    assert line.received == []
