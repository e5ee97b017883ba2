"""A question whose reply repeats nothing of it is sent whole, by the model and by a client."""

import importlib
from typing import Any

import pytest
from framegen.language.spec import Spec
from framegen.model.model import derive

from tests.factories import BUSSERVO, Data, data_of, files_of, kiln, layout_of, library
from tests.lines.timed_line import client_of
from tests.mutations.places import GONE, having


def long_question(*, echoed: bool) -> Data:
    """Return the kiln, whose question for dampers can name more than its reply has room for."""
    # A pose is only there where the reply repeats the question.
    method = {"messages.DamperRead.method": "read_dampers(damper_ids) -> positions", "pose": GONE}
    return having(kiln(), method | ({} if echoed else {"messages.DamperRead.echoed": GONE}))


def test_a_method_that_is_not_declared_takes_the_list_first() -> None:
    data = data_of(BUSSERVO)
    del data["messages"]["ServoMove"]["method"]
    exchange = derive(Spec.model_validate(data)).exchanges_by_request["ServoMove"]
    assert (exchange.method.name, exchange.arguments) == ("servo_move", ("targets", "time_ms"))


@pytest.mark.parametrize(("echoed", "most", "split"), [(True, 84, True), (False, 0, False)])
def test_a_query_whose_reply_repeats_its_list_is_split(
    echoed: bool, most: int, split: bool
) -> None:
    data = long_question(echoed=echoed)
    exchange = layout_of(data).exchanges_by_request["DamperRead"]
    assert exchange.request.items is not None
    assert (exchange.most, exchange.split is not None) == (most, split)
    with library(files_of(data)) as made:
        names: Any = made
        board = importlib.import_module(f"{made.__name__}.device").Device()
        board.on_damper_read = lambda message: names.DamperPositions(
            [(each, 10 * each) for each in message.damper_ids]
        )
        with client_of(board) as controller:
            assert controller.read_dampers([3, 4]) == ((3, 30), (4, 40))
