"""What one end makes of a frame of the other: single frames, by hand."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.wire import trials_of

from tests.comparison.edits import GONE, SPECS, pair_of, with_

if TYPE_CHECKING:
    from framegen.comparison.effect import Witness

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
