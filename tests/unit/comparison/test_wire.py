"""What one end makes of a frame of the other: single frames, by hand."""

import pytest
from framegen.comparison.edges import values_to_try
from framegen.comparison.effect import OUTCOMES, Which
from framegen.comparison.meaning import translated
from framegen.comparison.pair import Pair
from framegen.comparison.wire import trials_of, try_out, wire_effects
from framegen.model.layout import MessageLayout

from tests.factories import Data, Steps
from tests.mutations.edits import ALL, LISTS, SPECS, pair_of
from tests.mutations.houses import DOOR, WAY, house
from tests.mutations.places import GONE, with_

SERVO = SPECS["busservo"]
LIST = ("quantity", "bytes_left", "readings")
COIL = ("CoilWrite", "CoilWritten")
UNLOADLESS = pair_of(SERVO, with_(SERVO, "messages", "ServoUnload", GONE))


# Of everything, two messages, and of the one the list that is sized.
SIZED = {name: ALL["messages"]["Lists"]["fields"][name] for name in LIST}
SOME = with_(ALL, "messages", {name: ALL["messages"][name] for name in ("Flags", "Lists")})
SOME = with_(SOME, *LISTS, SIZED)


def test_what_is_refused_may_hold_a_frame_that_is_read() -> None:
    """Of a controller that knows no ServoUnload."""
    (unload,) = (
        each for each in trials_of(UNLOADLESS, "old") if each.message.name == "ServoUnload"
    )
    witness, breaks = unload.of({"servo_ids": [0x55, 0x55, 2, 15]})
    assert witness.data == bytes.fromhex("55 55 07 14 04 55 55 02 0F")
    assert (witness.outcome, witness.reading) == ("misread", "is read as BatteryVoltageRead")
    assert breaks
    # Another holds nothing.
    witness, breaks = unload.of({"servo_ids": [0x55, 0x54, 2, 15]})
    assert (witness.outcome, breaks) == ("refused", True)


@pytest.mark.parametrize(
    "steps",
    [(*LISTS, "readings", "sized_by"), ("messages", "Flags", "fields", "layout", "always")],
    ids=["the size of a list", "what never changes"],
)
def test_what_is_given_now_and_was_worked_out_is_read_alike(steps: Steps) -> None:
    pair = pair_of(SOME, with_(SOME, *steps, GONE))
    # What is given now may be another number than the old edition works out.
    ends: tuple[tuple[Which, set[str]], ...] = (("old", {"same"}), ("new", {"same", "refused"}))
    for sender, outcomes in ends:
        found = {
            max((frame.outcome for frame, _ in trial.frames()), key=OUTCOMES.index)
            for trial in trials_of(pair, sender)
        }
        assert found == outcomes


def broken(old: Data, new: Data) -> set[str]:
    """Return what ends notice of which editions as breaking."""
    pair = pair_of(old, new)
    return {each.outcome for each in wire_effects(pair, try_out(pair)) if each.breaks}


KIND: Data = {"type": "u8", "about": "Which layout."}


def asked(pair: Pair) -> tuple[MessageLayout, MessageLayout]:
    old, new = (each.model.messages["DoorAsked"] for each in (pair.old, pair.new))
    return old, new


def with_field(direction: str, size: int, name: str, field: Data) -> Data:
    """Return the greenhouse with one more message of one more field."""
    message = {**DOOR, "direction": direction, "length": 1 + size}
    return house({"DoorAsked": {**message, "fields": {**DOOR["fields"], name: field}}})


@pytest.mark.parametrize(
    ("direction", "outcomes"), [("gateway -> station", set()), (WAY, {"refused"})]
)
def test_a_value_free_now_was_never_asked_of_an_old_end(direction: str, outcomes: set[str]) -> None:
    old, new = (with_field(direction, 1, "kind", each) for each in ({**KIND, "always": 4}, KIND))
    # A device that sends what no old end reads is another matter: nobody there chose that.
    assert broken(old, new) == outcomes


def test_what_is_not_varied_has_a_value_that_both_ends_allow() -> None:
    ends = (with_field(WAY, 1, "kind", {**KIND, "range": each}) for each in ("0..240", "0..1"))
    pair = pair_of(*ends)
    old, new = asked(pair)
    usual = next(values_to_try(old, new, {"door": "door", "kind": "kind"}, pairs=False))
    assert usual["kind"] == 1


def test_what_stands_behind_a_field_that_is_gone_is_said_again() -> None:
    pair = pair_of(
        with_field(WAY, 1, "kind", KIND), house({"DoorAsked": {**DOOR, "fields": {"kind": KIND}}})
    )
    old, new = asked(pair)
    said = translated(pair.fields(old, new), old, new, {"door": 3, "kind": 5})
    assert said == {"kind": 5}


@pytest.mark.parametrize(("widened", "outcomes"), [("0..250", set()), ("0..200", {"refused"})])
def test_an_address_that_no_old_end_has_is_nobody_in_use(widened: str, outcomes: set[str]) -> None:
    modbus = SPECS["modbus"]
    some = with_(modbus, "messages", {name: modbus["messages"][name] for name in COIL})
    assert broken(some, with_(some, "frame", "unit", "range", widened)) == outcomes


def with_gaps(gaps: Data, direction: str = WAY) -> Data:
    message = {**DOOR, "direction": direction, "length": "2 * door + 1"}
    return house({"DoorAsked": {**message, "fields": {**DOOR["fields"], "gaps": gaps}}})


NUMBERS: Data = {"type": "u16", "counted_by": "door", "about": "How far."}
NAMED: Data = {
    **{key: each for key, each in NUMBERS.items() if key != "type"},
    "element": "Gap",
    "fields": {"gap": {"type": "u16", "about": "How far."}},
}


@pytest.mark.parametrize("direction", ["gateway -> station", WAY])
@pytest.mark.parametrize(("type_", "outcomes"), [("u16", set()), ("i16", {"misread", "refused"})])
def test_a_list_of_numbers_is_that_of_elements_with_one_number_each(
    direction: str, type_: str, outcomes: set[str]
) -> None:
    named = {**NAMED, "fields": {"gap": {**NAMED["fields"]["gap"], "type": type_}}}
    bare, other = (with_gaps(each, direction) for each in (NUMBERS, named))
    there, back = broken(bare, other), broken(other, bare)
    assert there | back <= outcomes
    assert bool(there) == bool(outcomes)


@pytest.mark.parametrize("named", [False, True], ids=["numbers", "elements"])
@pytest.mark.parametrize(("sent", "said"), [([2000, 3000], [2, 3]), ([2000, 1], None)])
def test_numbers_of_a_list_are_said_again_in_the_units_of_the_other(
    sent: list[int], said: list[int] | None, *, named: bool
) -> None:
    gaps = with_(NAMED, "fields", "gap", "unit", "m") if named else {**NUMBERS, "unit": "m"}
    pair = pair_of(with_gaps({**NUMBERS, "unit": "mm"}), with_gaps(gaps))
    old, new = asked(pair)
    again = translated(pair.fields(old, new), old, new, {"gaps": sent})
    elements = [{"gap": each} if named else each for each in said or []]
    assert again == (None if said is None else {"gaps": elements})
