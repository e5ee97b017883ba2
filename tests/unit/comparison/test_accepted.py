"""Accepted breaks: what one covers, and what it does not: ids and names that are used again."""

import pytest
from framegen.comparison.accepted import accepted_breaks, ignored_breaks
from framegen.comparison.comparison import Comparison
from framegen.comparison.due import due
from framegen.comparison.effect import Effect
from framegen.comparison.report import FORMATS
from framegen.comparison.report.verdict import UNCERTAIN, USUAL_FAILURES, exit_status
from framegen.comparison.report.view import View

from tests.factories import Data
from tests.in_turn import in_turn
from tests.mutations.edits import edition
from tests.mutations.houses import DATA, DOOR, LIMIT, REASON, WINDOW, house


def effects(old: Data, new: Data) -> list[Effect]:
    found = Comparison(edition(old), edition(new)).effects
    return [each for each in found if each.axis in ("wire", "conversation") and each.breaks]


BOTH = {"messages.DoorOpened": REASON, "messages.GateOpened": "Both are doors."}


@in_turn("type_, outcome", lambda: [("i8", "misread"), ("u8", "uncertain")])
@in_turn(
    "breaks, left",
    lambda: [
        ({}, {"old", "new"}),
        ({"messages.DoorOpened": REASON}, {"old", "new"}),
        ({"messages.GateOpened": "Both are doors."}, set()),
        (BOTH, set()),
    ],
)
def test_that_a_message_is_gone_gives_its_id_to_no_other(
    breaks: dict[str, str], left: set[str], type_: str, outcome: str
) -> None:
    gate = {**DOOR, "fields": {"gate": {"type": type_, "about": "Which gate."}}}
    found = effects(house({"DoorOpened": DOOR}), house({"GateOpened": gate}, breaks=breaks))
    read = [each for each in found if each.outcome == outcome and each.witness]
    assert {each.witness.sender for each in read if each.witness} == {"old", "new"}
    assert {each.witness.sender for each in read if each.witness and not each.accepted} == left


def test_that_a_message_is_gone_covers_that_its_frames_are_refused() -> None:
    new = house({}, breaks={"messages.DoorOpened": REASON})
    found = effects(house({"DoorOpened": DOOR}), new)
    assert {each.outcome for each in found} == {"refused"}
    assert {each.accepted for each in found} == {REASON}


@pytest.mark.parametrize(
    ("path", "wrong"),
    [
        ("messages", "`messages` would accept whatever breaks in any of them"),
        ("message.DoorOpened", "a spec has no `message`"),
        ("messages.DoorOpened.field", "`messages.DoorOpened` has no `field`"),
        ("messages..DoorOpened", "`messages..DoorOpened` is no path into a spec"),
    ],
)
def test_what_check_refuses_accepts_nothing(path: str, wrong: str) -> None:
    old, new = edition(house({"DoorOpened": DOOR})), edition(house({}, breaks={path: REASON}))
    comparison = Comparison(old, new)
    assert {each.accepted for each in comparison.effects} == {""}
    assert accepted_breaks(comparison.pair) == []
    assert [(each.path, why) for each, why in ignored_breaks(comparison.pair)] == [(path, wrong)]
    assert f"version 9.0.0 accepts nothing by `breaks`: {wrong}\n" in text(comparison)
    back = Comparison(new, new)
    assert ignored_breaks(back.pair) == []


@in_turn(
    "path, said",
    lambda: [
        ("messages.DoorOpend.id", "; there is no message `DoorOpend`, did you mean `DoorOpened`?"),
        ("messages.Q", "; there is no message `Q`"),
        ("messages.VentJammed", ""),
        ("link.baud", ""),
    ],
)
def test_a_message_that_neither_edition_has_was_misspelt(path: str, said: str) -> None:
    old, new = house({"DoorOpened": DOOR}), house({}, breaks={path: REASON})
    shown = text(Comparison(edition(old), edition(new)))
    assert f"version 9.0.0 accepts what breaks nothing: {path}{said}\n" in shown


@pytest.mark.parametrize(
    ("version", "breaks", "proposed"),
    [
        ("8.0.0", {}, '- version: "8.0.0"'),
        ("9.0.0", {}, "# What is meant to break, each with its reason:"),
        ("9.0.0", {"messages.DoorOpened": REASON}, None),
    ],
)
def test_an_entry_that_the_history_has_is_not_proposed_again(
    version: str, breaks: dict[str, str], proposed: str | None
) -> None:
    new = house({}, breaks=breaks)
    new["protocol"] = {**new["protocol"], "version": version}
    new["history"] = [{"version": "9.0.0", "changes": ["It."], "breaks": breaks}]
    comparison = Comparison(edition(house({"DoorOpened": DOOR})), edition(new))
    vars(comparison)["effects"] = [each for each in comparison.effects if each.axis != "programs"]
    shown = FORMATS["markdown"](View(comparison))
    found = [line.strip() for line in shown.partition("```yaml\n")[2].splitlines()]
    assert (found[0] if found else None) == proposed
    assert ("#   messages.DoorOpened: REASON" in found) is (not breaks and proposed is not None)


def text(comparison: Comparison) -> str:
    return FORMATS["text"](View(comparison))


WITHOUT_NAME = {key: value for key, value in LIMIT.items() if key != "name"}
WITHOUT_WAY = {key: value for key, value in LIMIT.items() if key != "direction"}
OTHER_WAY = {**LIMIT, "direction": "gateway -> station"}
OTHER_ID = {**LIMIT, "id": 0x76}
# The reservation that these tests add, behind those of the greenhouse.
AFRESH = ("reserved", len(DATA.get("reserved", ())))
NAME_ALONE = {"name": "DoorOpened", "why": LIMIT["why"]}


def about(reserved: Data, new: Data) -> list[Effect]:
    """Return the effects on a reservation: that it is gone has no new place."""
    found = Comparison(edition(house({}, [reserved])), edition(new)).effects
    return [each for each in found if each.old == AFRESH]


def reuses(reserved: Data, new: Data) -> list[Effect]:
    return [each for each in about(reserved, new) if each.new is not None]


@in_turn(
    "reserved, name, axes",
    lambda: [
        (LIMIT, "WindowOpened", ["wire"]),
        (WITHOUT_NAME, "WindowOpened", ["wire"]),
        (WITHOUT_NAME, "DoorOpened", ["wire"]),
        (WITHOUT_WAY, "WindowOpened", ["wire"]),
        (OTHER_WAY, "WindowOpened", []),
        (OTHER_ID, "WindowOpened", []),
        (OTHER_ID, "DoorOpened", ["programs"]),
        (OTHER_WAY, "DoorOpened", ["programs"]),
        # It is back.
        (LIMIT, "DoorOpened", []),
    ],
)
def test_what_was_reserved_is_not_used_unawares(reserved: Data, name: str, axes: list[str]) -> None:
    found = reuses(reserved, house({name: WINDOW}))
    assert [each.axis for each in found] == axes
    for each in found:
        assert (each.outcome, each.breaks, each.certain) == ("uncertain", True, False)
        assert each.path == ("messages", name)
        assert str(LIMIT["why"]) in each.text
        assert each.accepted == ""


def test_a_reuse_is_accepted_where_the_message_is_and_none_if_it_had_its_id_all_along() -> None:
    window = {"WindowOpened": WINDOW}
    found = reuses(LIMIT, house(window, breaks={"messages.WindowOpened": REASON}))
    assert [each.accepted for each in found] == [REASON]
    found = Comparison(edition(house(window, [WITHOUT_NAME])), edition(house(window))).effects
    assert [each for each in found if each.breaks] == []


@in_turn(
    "reserved, messages, kept, axes",
    lambda: [
        (LIMIT, {}, [LIMIT], []),
        (LIMIT, {}, [], ["wire", "programs"]),
        (WITHOUT_NAME, {}, [], ["wire"]),
        (NAME_ALONE, {}, [], ["programs"]),
        # What is reserved is said otherwise.
        (LIMIT, {}, [WITHOUT_NAME, NAME_ALONE], []),
        (LIMIT, {}, [WITHOUT_NAME], ["programs"]),
        (LIMIT, {}, [NAME_ALONE], ["wire"]),
        (LIMIT, {}, [WITHOUT_WAY], []),
        (LIMIT, {}, [OTHER_WAY], ["wire"]),
        (WITHOUT_WAY, {}, [LIMIT], ["wire"]),
        (WITHOUT_WAY, {}, [LIMIT, OTHER_WAY], ["wire"]),
        (LIMIT, {}, [OTHER_ID], ["wire"]),
        # What has it again is not free.
        (LIMIT, {"DoorOpened": DOOR}, [], []),
        (LIMIT, {"WindowOpened": WINDOW}, [], ["programs"]),
        (LIMIT, {"WindowOpened": {**WINDOW, "was": "DoorOpened"}}, [], []),
        # No end of that way is left.
        ({**WITHOUT_NAME, "direction": "door -> gateway"}, {}, [], []),
    ],
)
def test_a_reservation_that_is_dropped_is_told(
    reserved: Data, messages: Data, kept: list[Data], axes: list[str]
) -> None:
    found = about(reserved, house(messages, kept))
    assert [each.axis for each in found if each.new is None] == axes


def test_a_dropped_reservation_is_no_patch_until_it_is_accepted() -> None:
    for breaks in ({}, {"reserved": REASON}, {f"reserved[{AFRESH[1]}]": REASON}):
        comparison = Comparison(edition(house({}, [LIMIT])), edition(house({}, breaks=breaks)))
        assert due(comparison.effects, comparison.changes) == "major"
        view = View(comparison)
        status = exit_status(view.effects, None, USUAL_FAILURES)
        assert status == (0 if breaks else UNCERTAIN)
        shown = FORMATS["text"](view)
        assert "is gone: id 119 (station -> gateway), name DoorOpened" in shown
        assert "    do: Keep it as long as any end still sends what had it.\n" in shown
