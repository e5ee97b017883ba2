"""Reads and holds positions, for the verbs that record and play them."""

from __future__ import annotations

from .._client.exchanges import POSE
from .._client.long_question import parts_of
from .._client.pose import HOLD_MS
from .._frame.errors import LimitError
from .._serial.link_errors import AbsentError, NoReplyError
from .limits import refused

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from .._client.client import Client
    from .._client.limits import Bounds
    from .._client.pose import Pose

# What keeps positions from being read, and is over at the next attempt.
UNREAD = (AbsentError, LimitError, NoReplyError)


def the_pose() -> Pose:
    """How positions are read and commanded: this is here only where they are."""
    if POSE is None:
        raise AssertionError("this is for protocols with poses")
    return POSE


def find_present(controller: Client, pose: Pose) -> tuple[int, ...]:
    """The numbers of all that are there. Raises NoReplyError."""
    return pose.present_in(controller.request(each) for each in parts_of(pose.read, pose.ids))


def read_targets(
    controller: Client, pose: Pose, ids: Sequence[int], limits: Bounds | None
) -> list[tuple[int, int]]:
    """Where these are now, as targets. Raises one of UNREAD unless all are there."""
    exchanged = [(each, controller.request(each)) for each in parts_of(pose.read, ids)]
    return pose.held(exchanged, limits)


def hold(controller: Client, pose: Pose, ids: Sequence[int], limits: Bounds | None) -> None:
    """Commands where these are now. Raises one of UNREAD."""
    targets = read_targets(controller, pose, ids, limits)
    # As many motions as it takes: the first is on its way before the next is made.
    for at in range(0, len(targets), pose.room):
        controller.send(pose.motion(targets[at : at + pose.room], HOLD_MS))


def listed(pose: Pose, ids: Iterable[int]) -> str:
    """Some of them in words: `joint 1`, `joints 1, 2`."""
    numbers = [str(each) for each in ids]
    return f"{pose.noun}{'' if len(numbers) == 1 else 's'} {', '.join(numbers)}"


def in_options(error: Exception) -> str:
    """What went wrong, in the words of the command line."""
    return str(refused(error) if isinstance(error, LimitError) else error)
