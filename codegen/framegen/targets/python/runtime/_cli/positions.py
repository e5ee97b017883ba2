"""Read and hold positions, for the verbs that record and play them."""

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

# Errors of reading positions that may be over at the next attempt.
UNREAD = (AbsentError, LimitError, NoReplyError)


def the_pose() -> Pose:
    """Return how positions are read and commanded; only protocols with poses have these verbs."""
    if POSE is None:
        raise AssertionError("this is for protocols with poses")
    return POSE


def find_present(controller: Client, pose: Pose) -> tuple[int, ...]:
    """Return the numbers of all that are present. Raises NoReplyError."""
    return pose.present_in(controller.request(each) for each in parts_of(pose.read, pose.ids))


def read_targets(
    controller: Client, pose: Pose, ids: Sequence[int], limits: Bounds | None
) -> list[tuple[int, int]]:
    """Return the current positions, as targets. Raises one of UNREAD unless all are present."""
    exchanged = [(each, controller.request(each)) for each in parts_of(pose.read, ids)]
    return pose.held(exchanged, limits)


def hold(controller: Client, pose: Pose, ids: Sequence[int], limits: Bounds | None) -> None:
    """Command the current positions. Raises one of UNREAD."""
    targets = read_targets(controller, pose, ids, limits)
    # As many motions as it takes: the first is sent before the next is made.
    for at in range(0, len(targets), pose.room):
        controller.send(pose.motion(targets[at : at + pose.room], HOLD_MS))


def listed(pose: Pose, ids: Iterable[int]) -> str:
    """Return some of them in words: `joint 1`, `joints 1, 2`."""
    numbers = [str(each) for each in ids]
    return f"{pose.noun}{'' if len(numbers) == 1 else 's'} {', '.join(numbers)}"


def in_options(error: Exception) -> str:
    """Return the error, in the words of the command line."""
    return str(refused(error) if isinstance(error, LimitError) else error)
