"""Read and hold positions, for the verbs that record and play them."""

from __future__ import annotations

import sys

from ..client.holding import Holding
from ..client.long_question import parts_of
from ..frame.errors import LimitError
from ..line.link_errors import AbsentError, NoReplyError
from .exit_codes import INTERRUPTED
from .numerals import ranges

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

    from ..client.client import Client
    from ..client.library import Library
    from ..client.limits import Allowed
    from ..client.pose import Pose
    from .limits import Chosen
    from .program import Program

# Errors of reading positions that may be over at the next attempt.
UNREAD = (AbsentError, LimitError, NoReplyError)


def the_pose(library: Library) -> Pose:
    """Return how positions are read and commanded; only protocols with poses have these verbs."""
    if library.pose is None:
        raise AssertionError("this is for protocols with poses")
    return library.pose


def several(program: Program) -> str:
    """Return in words which are meant where none are named."""
    return f"those in {program.settings_file}, else all that answer"


def find_present(controller: Client, library: Library) -> tuple[int, ...]:
    """Return the numbers of all that are present. Raises NoReplyError."""
    pose = the_pose(library)
    questions = parts_of(library.exchanges, pose.read, pose.ids)
    return pose.present_in(controller.request(each) for each in questions)


def read_targets(
    controller: Client, library: Library, ids: Sequence[int], limits: Allowed
) -> list[tuple[int, int]]:
    """Return the current positions, as targets. Raises one of UNREAD unless all are present."""
    pose = the_pose(library)
    questions = parts_of(library.exchanges, pose.read, ids)
    exchanged = [(each, controller.request(each)) for each in questions]
    return pose.held(exchanged, limits)


def hold_those_there(
    controller: Client, library: Library, ids: Sequence[int], limits: Allowed
) -> bool:
    """Command the current positions of those that answer, and say which; whether that is all.

    Of each other it says why it is not held. Raises NoReplyError if nobody answers.
    """
    pose = the_pose(library)
    holding = Holding(pose, library.exchanges, ids, limits)
    for question in holding.questions:
        holding.take(controller.request(question))
    for command in holding.commands():
        controller.send(command)
    if holding.held:
        print(f"{listed(pose, holding.held)} held", file=sys.stderr)
    for number, why in holding.left.items():
        print(f"{listed(pose, [number])} not held: {why}", file=sys.stderr)
    return not holding.left


def stopped_by_hand(
    controller: Client, library: Library, ids: Sequence[int], limits: Chosen
) -> int:
    """Hold what moves, because Ctrl-C was pressed, and say so; return the exit status."""
    print(file=sys.stderr)
    if not ids:
        print("what was sent goes on to its end", file=sys.stderr)
        return INTERRUPTED
    try:
        hold_those_there(controller, library, ids, limits.allowed)
    except NoReplyError as error:
        print(f"the motion under way goes on to its end: {error}", file=sys.stderr)
    return INTERRUPTED


def nobody(pose: Pose) -> str:
    """Return what is said where nothing answers."""
    return f"no {pose.noun} is there: is the supply of the {pose.noun}s on?"


def listed(pose: Pose, ids: Iterable[int]) -> str:
    """Return some of them in words: `joint 1`, `joints 1, 2`."""
    numbers = [str(each) for each in ids]
    return f"{pose.noun}{'' if len(numbers) == 1 else 's'} {', '.join(numbers)}"


def in_options(error: Exception, limits: Chosen) -> str:
    """Return the error, in the words of the command line."""
    return str(limits.refused(error) if isinstance(error, LimitError) else error)


def numbers_of(pose: Pose) -> Callable[[str], tuple[int, ...]]:
    """Return what reads an argument such as `1-6,9`, the numbers of some of them."""
    bounds = pose.item
    return lambda text: ranges(text, bounds.low, bounds.high)
