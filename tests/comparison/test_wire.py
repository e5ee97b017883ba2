"""What one end makes of a frame of the other: single frames, by hand."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from framegen.comparison.effect import OUTCOMES
from framegen.comparison.wire import trials_of

from tests.comparison.edits import ALL, GONE, LISTS, SPECS, pair_of, with_

if TYPE_CHECKING:
    from framegen.comparison.effect import Which, Witness

    from tests.factories import Steps

SERVO = SPECS["busservo"]
UNLOADLESS = pair_of(SERVO, with_(SERVO, "messages", "ServoUnload", GONE))


def unloaded(servo_ids: list[int]) -> tuple[Witness, bool]:
    """Return what a controller that knows no ServoUnload makes of one."""
    trial = next(
        each for each in trials_of(UNLOADLESS, "old") if each.message.name == "ServoUnload"
    )
    return trial.of({"servo_ids": servo_ids})


def test_what_is_refused_may_hold_a_frame_that_is_read() -> None:
    witness, breaks = unloaded([0x55, 0x55, 2, 15])
    assert witness.data == bytes.fromhex("55 55 07 14 04 55 55 02 0F")
    assert (witness.outcome, witness.reading) == ("misread", "is read as BatteryVoltageRead")
    assert breaks


def test_what_is_refused_and_holds_nothing_is_refused() -> None:
    witness, breaks = unloaded([0x55, 0x54, 2, 15])
    assert (witness.outcome, breaks) == ("refused", True)


@pytest.mark.parametrize(
    "steps",
    [(*LISTS, "readings", "sized_by"), ("messages", "Flags", "fields", "layout", "always")],
    ids=["the size of a list", "what never changes"],
)
def test_what_is_given_now_and_was_worked_out_is_read_alike(steps: Steps) -> None:
    pair = pair_of(ALL, with_(ALL, *steps, GONE))
    # What is given now may be another number than the old edition works out.
    ends: tuple[tuple[Which, set[str]], ...] = (("old", {"same"}), ("new", {"same", "refused"}))
    for sender, outcomes in ends:
        found = {
            max((frame.outcome for frame, _ in trial.frames()), key=OUTCOMES.index)
            for trial in trials_of(pair, sender)
        }
        assert found == outcomes
