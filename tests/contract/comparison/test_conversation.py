"""What ends of two editions say to each other: the verdicts, held against ends that talk."""

from functools import cache
from itertools import islice, product
from typing import Any

import pytest
from framegen.comparison.conversation import conversation_effects
from framegen.comparison.conversation.client import Client
from framegen.comparison.conversation.play import OTHER, Table
from framegen.comparison.conversation.report_effects import acknowledges
from framegen.comparison.effect import Effect, Which
from framegen.comparison.pair import Pair
from framegen.reading.yamltree import dotted

from tests.contract.comparison import conversations
from tests.contract.comparison.conversation_cases import CASES, HOUSE, SERVO, Said
from tests.contract.comparison.ends import differing, ends_of
from tests.contract.comparison.uart import understood
from tests.factories import data_of
from tests.in_turn import in_turn
from tests.mutations.edits import pair_of
from tests.mutations.mutations import SPECS
from tests.mutations.places import with_

WHICH: tuple[Which, Which] = ("old", "new")


@cache
def pair_named(name: str) -> Pair:
    return pair_of(CASES[name].old, CASES[name].new)


@cache
def effects_named(name: str) -> list[Effect]:
    return [*conversation_effects(pair_named(name))]


def said_of(effects: list[Effect]) -> list[Said]:
    """Return what is said; of exchanges with the same outcome between the same ends, the first."""
    found: dict[Any, Said] = {}
    for effect in effects:
        on_a_message = effect.path[0] == "messages"
        message = effect.text.partition(" ")[0] if on_a_message else dotted(effect.path)
        key = (effect.ends, effect.outcome, effect.breaks)
        found.setdefault(key, Said(effect.ends, effect.outcome, message, effect.breaks))
    return [*found.values()]


@in_turn("name", lambda: CASES)
def test_what_is_said_of_an_exchange(name: str) -> None:
    assert said_of(effects_named(name)) == CASES[name].said


@pytest.mark.parametrize("name", ["busservo", "modbus", "lxservo"])
def test_nothing_is_said_of_an_edition_and_itself(name: str) -> None:
    data = data_of(SPECS[name])
    assert [*conversation_effects(pair_of(data, data))] == []


@in_turn("name", lambda: CASES)
def test_each_effect_has_its_ends_its_place_and_its_frame(name: str) -> None:
    pair = pair_named(name)
    for effect in effects_named(name):
        assert effect.axis == "conversation"
        old, new = effect.ends.split(", ")
        assert {old.split()[0], new.split()[0]} == {"old", "new"}
        assert old.split()[1] != new.split()[1]
        if effect.path[0] == "messages":
            names = {path[1] for path in (effect.old, effect.new) if path is not None}
            assert effect.text.partition(" ")[0] in names
        if effect.witness is not None:
            sender = pair.edition(effect.witness.sender).model
            assert effect.witness.message in sender.messages


def test_a_reply_that_is_linked_first_is_told_as_what_programs_lose() -> None:
    text = {each.outcome: each.text for each in effects_named("a reply is new")}
    assert text["no reply"] == (
        "BatteryVoltageRead gets no reply unless BatteryVoltage has always followed it, "
        "which the old edition does not say"
    )
    assert text["no report"] == (
        "BatteryVoltage is reported no longer: the new host takes it for the answer to "
        "BatteryVoltageRead, returns it to a program that asks, and drops it where none does"
    )


@pytest.mark.parametrize("name", ["a reply is new", "a reply has room for fewer", "both ends ask"])
def test_the_way_back_mirrors_the_way_there(name: str) -> None:
    conversations.assert_mirrored(pair_named(name))


def test_the_frame_that_shows_it_is_short() -> None:
    (effect, *_) = (each for each in effects_named("nothing is repeated") if each.witness)
    assert effect.witness is not None
    # One reply has room for 84 servos.
    assert len(effect.witness.data) <= len(["55", "55", "0C", "15", "03"]) + 3 * 3


def test_another_reply_is_told_with_the_one_that_is_awaited() -> None:
    bare = with_(SERVO, "messages", "BatteryVoltageRead", "method", "read_battery_voltage()")
    new = with_(bare, "messages", "BatteryVoltageRead", "reply", "ActionGroupStopped")
    found = [each for each in conversation_effects(pair_of(bare, new)) if each.breaks]
    assert [each.text for each in found if each.outcome == "other reply"] == [
        "BatteryVoltageRead is answered by ActionGroupStopped, and not by BatteryVoltage",
        "BatteryVoltageRead is answered by BatteryVoltage, and not by ActionGroupStopped",
    ]


@pytest.mark.parametrize(
    "name", ["a reply is gone", "a reply has room for more", "a refusal is gone"]
)
def test_the_generated_ends_see_what_is_said(name: str) -> None:
    message = CASES[name].said[-1].message
    with ends_of(pair_named(name)) as ends:
        assert differing(ends, {message}) == []


@pytest.mark.parametrize("name", [name for name in CASES if "command is" in name])
def test_the_generated_client_is_acknowledged_as_is_said(name: str) -> None:
    pair = pair_named(name)
    table = Table(pair)
    with ends_of(pair) as ends:
        for client in WHICH:
            exchange = table.clients[client].exchanges["ActionGroupRun"]
            if exchange.acknowledged is None:
                continue
            for values, data in islice(table.requests(client, exchange), 5):
                said = acknowledges(table, client, OTHER[client], data)
                assert ends.acknowledged(client, OTHER[client], values) is said


@pytest.mark.parametrize("name", ["a reply is gone", "a refusal is gone"])
def test_the_generated_client_drops_the_reports_that_are_said_to_be_dropped(name: str) -> None:
    pair = pair_named(name)
    message = next(each.message for each in CASES[name].said if each.outcome == "no report")
    with ends_of(pair) as ends:
        for client in WHICH:
            dropped = Client(pair.edition(client).model).becomes(message) == "dropped"
            assert ends.reported(client, OTHER[client], message) is not dropped


@pytest.mark.parametrize("key", ["baud", "data_bits", "parity", "stop_bits"])
def test_ends_understand_each_other_where_nothing_is_said_of_the_line(key: str) -> None:
    values: dict[str, list[Any]] = {
        "baud": [9600, 9500, 9650, 9700, 9780, 9900, 10400, 19200, 4800],
        "data_bits": [8, 7],
        "parity": ["none", "even", "odd"],
        "stop_bits": [1, 2],
    }
    data = bytes([0x55, 0x55, 0x7F, 0x00, 0x2A, 0x40, 0x3F, 0x55])
    usual = values[key][:1] if key == "baud" else values[key]
    for one, other in product(usual, values[key]):
        pair = pair_of(with_(SERVO, "link", key, one), with_(SERVO, "link", key, other))
        old, new = pair.old.spec.link, pair.new.spec.link
        lost = not (understood(old, new, data) and understood(new, old, data))
        said = [effect.breaks for effect in conversation_effects(pair)]
        # A stop bit more is waited for by some receivers, and not by others.
        wanted = lost or (key == "stop_bits" and one != other)
        assert said == ([True, True] if wanted else []), (one, other)


@pytest.mark.parametrize(("old", "new"), [(False, True), (True, False)])
def test_an_echo_is_expected_by_who_knows_of_it(old: bool, new: bool) -> None:
    pair = pair_of(with_(HOUSE, "link", "local_echo", old), with_(HOUSE, "link", "local_echo", new))
    said = {effect.ends.split()[0]: effect.breaks for effect in conversation_effects(pair)}
    with ends_of(pair) as ends:
        for client in WHICH:
            made, there = ends.library(client), ends.library(OTHER[client]).Device()
            echo = pair.edition(OTHER[client]).spec.link.local_echo
            fails = False
            with ends.client(client, there, echo=echo) as controller:
                try:
                    controller.send(made.VentsOpen(1, [(1, 2)]))
                except made.EchoError:
                    fails = True
                fails = fails or bool([*controller.reports(timeout=1.0)])
            assert fails is said[client]
