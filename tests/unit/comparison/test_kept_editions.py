"""Every kept edition counts: what an older one misreads is told once, with the way out."""

import json
from collections.abc import Sequence
from typing import Any

import pytest
from framegen.comparison import kept
from framegen.comparison.comparison import Comparison
from framegen.comparison.edition import Edition
from framegen.comparison.effect import Effect
from framegen.comparison.kept import look_at_kept
from framegen.comparison.pair import Pair
from framegen.comparison.partners import Listed
from framegen.comparison.report import FORMATS
from framegen.comparison.report.view import View
from framegen.comparison.wire import Trial
from framegen.reading.yamltree import Unusable

from tests.factories import Data
from tests.in_turn import in_turn
from tests.mutations.edits import edition
from tests.mutations.houses import DOOR, LIMIT, REASON, WAY, WINDOW, house
from tests.mutations.mutations import after
from tests.second_reader import Reader

GATE = {**DOOR, "summary": "A gate is open."}
OTHER = {**GATE, "fields": {"gate": {"type": "i8", "about": "Which gate."}}}
ELSEWHERE = {**WINDOW, "id": 0x78}
WITH_DOOR = house({"DoorOpened": DOOR})
NONE = house({})


def versioned(data: Data, version: str) -> Data:
    return {**data, "protocol": {**data["protocol"], "version": version}}


def listed(data: Data, version: str = "0.4.0") -> Listed:
    """Return a kept edition, which is read when it is needed."""
    return Listed(f"{version}.yaml", "", lambda: edition(versioned(data, version)))


def found_in(before: Sequence[Listed], old: Data, new: Data) -> list[Effect]:
    return look_at_kept(Pair(edition(old), edition(new)), before).effects


def told(effects: Sequence[Effect]) -> list[tuple[str, str]]:
    return [(each.outcome, each.text) for each in effects]


MISREAD = [
    ("misread", "DoorOpened is read as GateOpened"),
    ("misread", "GateOpened is read as DoorOpened"),
]
PERHAPS = [("uncertain", f"{text}, which may be another message") for _, text in MISREAD]
STILL = [("uncertain", "DoorOpened: programs in use may still know another message of that name")]


@in_turn(
    "released, new, expected",
    lambda: [
        # The id is given to another message.
        (NONE, house({"GateOpened": OTHER}), MISREAD),
        (NONE, house({"GateOpened": GATE}), PERHAPS),
        (NONE, house({"GateOpened": {**GATE, "was": "DoorOpened"}}), []),
        # The name is.
        (NONE, house({"DoorOpened": ELSEWHERE}), STILL),
        # Nothing of it is used again, or it is back.
        (NONE, house({"WindowOpened": ELSEWHERE}), []),
        (NONE, WITH_DOOR, []),
        (NONE, house({"GateOpened": {**OTHER, "direction": "gateway -> station"}}), []),
        # No frame of the one is one of the other.
        (NONE, house({"WindowOpened": WINDOW}), []),
        # It was released so, whatever else is new.
        (house({"GateOpened": OTHER}), house({"GateOpened": OTHER, "WindowOpened": ELSEWHERE}), []),
        (house({"GateOpened": GATE}), house({"GateOpened": GATE, "WindowOpened": ELSEWHERE}), []),
        # The edition that is compared shows the same.
        (WITH_DOOR, house({"GateOpened": OTHER}), []),
        (WITH_DOOR, NONE, []),
    ],
)
def test_what_an_older_edition_misreads_is_told_unless_the_newest_shows_it(
    released: Data, new: Data, expected: list[tuple[str, str]]
) -> None:
    assert told(found_in([listed(WITH_DOOR)], released, new)) == expected
    assert found_in([listed(released)], released, new) == []


def test_a_frame_shows_it_which_means_nothing_to_the_edition_between() -> None:
    gate = house({"GateOpened": OTHER})
    found = found_in([listed(WITH_DOOR)], NONE, gate)
    assert len(found) == len(MISREAD)
    readers = [Reader(data) for data in (WITH_DOOR, NONE, gate)]
    for each in found:
        assert each.witness is not None
        frame = each.witness.data
        read = [[n for n in by.names([WAY]) if by.read(n, frame) is not None] for by in readers]
        assert read == [["DoorOpened"], [], ["GateOpened"]]


def test_what_several_editions_show_is_told_once_and_of_all_of_them() -> None:
    before = [listed(NONE, "0.5.0"), *(listed(WITH_DOOR, f"0.{each}.0") for each in (4, 3))]
    found = found_in(before, NONE, house({"GateOpened": OTHER}))
    assert [each.editions for each in found] == [("0.4.0", "0.3.0")] * len(MISREAD)


def test_what_an_older_edition_reserves_is_not_used_unawares() -> None:
    reserving = listed(house({}, [LIMIT]), "0.5.0")
    (found,) = found_in([reserving], NONE, house({"GateOpened": OTHER}))
    assert (found.axis, found.outcome, found.editions) == ("wire", "uncertain", ("0.5.0",))
    assert str(LIMIT["why"]) in found.text
    # An edition that has the message shows it by its frames.
    old, new = edition(house({}, [LIMIT])), edition(house({"GateOpened": OTHER}))
    comparison = Comparison(old, new, [reserving, listed(WITH_DOOR)])
    wire = [each for each in comparison.effects if each.axis == "wire" and each.breaks]
    assert told(wire) == MISREAD


def test_a_reuse_is_accepted_at_the_message_that_takes_the_id_and_by_nothing_else() -> None:
    for path, accepted in (("messages.GateOpened", REASON), ("messages.DoorOpened", "")):
        new = house({"GateOpened": OTHER}, breaks={path: REASON})
        found = Comparison(edition(NONE), edition(new), [listed(WITH_DOOR)]).effects
        assert {each.accepted for each in found if each.editions} == {accepted}


def refuse() -> Edition:
    raise Unusable("it is no spec", hint="nothing")


def test_where_no_message_changed_no_kept_edition_is_read() -> None:
    kept_ones = [Listed(f"{each}.yaml", "", refuse) for each in range(10)]
    new = versioned(house({"DoorOpened": DOOR}, [LIMIT]), "9.9.9")
    assert found_in(kept_ones, WITH_DOOR, new) == []


def test_what_cannot_be_read_is_said_and_the_others_are_compared() -> None:
    pair = Pair(edition(NONE), edition(house({"GateOpened": OTHER})))
    found = look_at_kept(pair, [Listed("old.yaml", "", refuse), listed(WITH_DOOR)])
    assert found.unread == ["old.yaml: it is no spec"]
    assert told(found.effects) == MISREAD


def test_of_ten_editions_that_say_the_same_only_the_new_message_is_tried(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    tried: list[str] = []
    frames = Trial.frames

    def counted(self: Trial) -> Any:
        tried.append(self.message.name)
        return frames(self)

    monkeypatch.setattr(Trial, "frames", counted)
    before = [listed(WITH_DOOR, f"0.4.{each}") for each in range(10)]
    assert found_in(before, WITH_DOOR, house({"DoorOpened": DOOR, "WindowOpened": ELSEWHERE})) == []
    assert tried == ["WindowOpened"] * len(before)


@pytest.mark.parametrize(
    ("spec", "first", "last"),
    [
        ("demo", "a named value removed", "u16 became i16"),
        ("demo", "u16 became i16", "u16 became i16"),
        ("modbus", "u16 became i16", "words: the protocol"),
        ("busservo", "padding added in front", "u16 became i16"),
    ],
)
def test_what_is_not_tried_again_would_show_nothing(
    spec: str, first: str, last: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    one, other = after(spec, [first]), after(spec, [last])
    assert one is not None
    assert other is not None
    pair, before = Pair(other.old, other.new), Listed("old.yaml", "", lambda: one.new)
    found = told(look_at_kept(pair, [before]).effects)
    monkeypatch.setattr(kept, "_same", lambda *_: frozenset())
    assert told(look_at_kept(pair, [before]).effects) == found


DO = "If it is the same, write `was: DoorOpened` below `messages.GateOpened`; "


@in_turn(
    "before, old, remedy",
    lambda: [
        # Of the edition that is compared, a change says it; of one before, the effect.
        ((), WITH_DOOR, "write `was: DoorOpened` below `messages.GateOpened`"),
        ([listed(WITH_DOOR)], NONE, DO),
        ([listed(WITH_DOOR)], NONE, "give it another id, and reserve that of DoorOpened"),
    ],
)
@in_turn("name", lambda: ["text", "markdown", "github"])
def test_the_way_out_stands_in_every_format(
    name: str, before: Sequence[Listed], old: Data, remedy: str
) -> None:
    new = edition(house({"GateOpened": GATE}))
    shown = FORMATS[name](View(Comparison(edition(old), new, before)))
    assert remedy in shown
    if name == "github":
        (first, *_) = (line for line in shown.splitlines() if line.startswith("::warning"))
        assert remedy in first


def test_what_is_accepted_needs_no_way_out() -> None:
    new = house({"GateOpened": GATE}, breaks={"messages.GateOpened": REASON})
    view = View(Comparison(edition(NONE), edition(new), [listed(WITH_DOOR)]))
    assert view.remedies(view.effects) == []


def test_each_format_says_whose_frames_they_are() -> None:
    new = edition(house({"GateOpened": OTHER}))
    view = View(Comparison(edition(NONE), new, [listed(WITH_DOOR), listed(WITH_DOOR, "0.3.0")]))
    for name, arrow in (("text", "->"), ("markdown", "→"), ("github", "->")):
        said = f"old station of 0.4.0, 0.3.0 {arrow} new gateway"
        assert said.replace(",", "%2C" if name == "github" else ",") in FORMATS[name](view), name
    effects = json.loads(FORMATS["json"](view))["effects"]
    found = [each["editions"] for each in effects if each["standing"] == "breaks"]
    assert found == [["0.4.0", "0.3.0"]] * len(MISREAD)
