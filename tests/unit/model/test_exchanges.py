"""A question whose reply repeats nothing of it is sent whole, by the model and by a client.

Who the client is, the order of the endpoints settles, whatever the order of the messages.
"""

import importlib
from typing import Any

import pytest
from framegen.language.spec import Spec
from framegen.model.model import derive

from tests.factories import (
    BUSSERVO,
    DEMO,
    Data,
    compiled_of,
    data_of,
    files_of,
    kiln,
    layout_of,
    library,
)
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


SERVO, HOUSE = data_of(BUSSERVO), data_of(DEMO)


def report_first(data: Data) -> Data:
    """Return the same with a message of the device in front."""
    device = list(data["endpoints"])[1]
    messages = data["messages"]
    front = next(name for name in messages if messages[name]["direction"].startswith(device))
    return {**data, "messages": {front: messages[front], **messages}}


def turned_round(data: Data) -> Data:
    return {**data, "endpoints": dict(reversed(data["endpoints"].items()))}


def rules(data: Data) -> list[str]:
    return [finding.rule for finding in compiled_of(data).findings]


@pytest.mark.parametrize("data", [SERVO, HOUSE], ids=["busservo", "greenhouse"])
def test_a_report_before_the_commands_does_not_swap_the_roles(data: Data) -> None:
    moved = report_first(data)
    assert list(moved["messages"]) != list(data["messages"])
    assert layout_of(moved).roles == layout_of(data).roles

    name = data["protocol"]["name"]
    before, after = files_of(data), files_of(moved)
    # What lists messages lists them in the order of the spec; what each end does is the same.
    for file in ("_controller", "_async_controller", "_library"):
        path = f"generated/{name}/{file}.py"
        assert _without_banner(before[path]) == _without_banner(after[path]), path


def _without_banner(text: str) -> list[str]:
    return [line for line in text.split("\n") if not line.startswith("#")]


def test_swapped_endpoints_are_reported_where_a_client_has_methods() -> None:
    assert set(rules(turned_round(SERVO))) == {"limits", "lasts", "method", "pose", "verb"}


@pytest.mark.parametrize(
    ("change", "found"),
    [(lambda data: data, []), (report_first, ["endpoints"]), (turned_round, ["endpoints"])],
    ids=["as it was", "a report first", "turned round"],
)
def test_a_spec_whose_roles_differ_in_an_older_edition_is_told(
    change: Any, found: list[str]
) -> None:
    """Edition 1 took whoever sends first for the library's user."""
    assert rules({**change(HOUSE), "framegen": 1}) == found


def test_a_kind_follows_from_the_sender() -> None:
    model = layout_of(report_first(HOUSE))
    kinds = {name: model.kind(name) for name in model.messages}
    assert kinds.pop("StationRead") == "query"
    assert kinds.pop("StationState") == "reply"
    assert kinds == {"TextShow": "command", "VentJammed": "report", "VentsOpen": "command"}


def test_a_third_endpoint_is_read_and_ignored() -> None:
    model = layout_of(HOUSE)
    assert (model.roles.client, model.roles.device) == ("gateway", "station")
    keys = ["gateway_to_station", "station_to_gateway", "gateway_to_display"]
    assert [way.key for way in model.ways] == keys
    assert "TextShow" not in [each.request.name for each in model.exchanges]
