"""The verb `play`: moves through recorded poses, one after the other."""

from __future__ import annotations

import argparse
import sys
import time
from itertools import chain, repeat
from pathlib import Path

from ..client.wire_time import WireTime
from ..frame.pluralize import pluralize
from . import link
from .exit_codes import DONE
from .limits import add_limits, limits_of
from .link import add_port, add_timeout, failures_reported, open_client
from .numerals import at_least, from_zero, whole
from .posefile import LONGEST_PAUSE, check_limits, read_poses
from .positions import stopped_by_hand, the_pose
from .progress_thread import slept
from .usage_error import UsageError
from .values import fields_as_text

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable

    from ..client.client import Client
    from ..client.library import Library
    from ..client.pose import Pose
    from ..frame.message import Message
    from .limits import Chosen
    from .posefile import Recorded
    from .program import Program

ENDS = link.ENDS
ABOUT = """\
Moves to each pose of FILE, which `teach` has written, and waits for as long as that takes. The
whole file is looked at before the first move. Ctrl-C commands the positions of that moment, so that
nothing moves on. Give it room, and look at --dry-run first: nothing here knows what is in the way,
and the first pose may be far away."""


def add_arguments(parser: argparse.ArgumentParser, program: Program) -> None:
    """Declare the arguments of the verb."""
    parser.add_argument("file", type=Path, metavar="FILE", help="poses that `teach` has recorded")
    add_port(parser, program)
    parser.add_argument(
        "--time-ms",
        type=_time_of(the_pose(program.library)),
        default=1000,
        metavar="MS",
        help="how long the way to each pose takes, where the file does not say (default: 1000)",
    )
    parser.add_argument(
        "--pause",
        type=from_zero(highest=LONGEST_PAUSE, unit="seconds"),
        default=0.0,
        metavar="S",
        help="seconds to stay at each pose, where the file does not say (default: 0)",
    )
    parser.add_argument(
        "--repeat", type=at_least(1), default=1, metavar="N", help="play it so often (default: 1)"
    )
    parser.add_argument("--dry-run", action="store_true", help="print what would be sent, and when")
    add_limits(parser, program)
    add_timeout(parser)


def run(arguments: argparse.Namespace, program: Program) -> int:
    """Play a file, or only print what it would send."""
    pose, limits = the_pose(program.library), limits_of(arguments)
    poses = read_poses(arguments.file, pose, program.name)
    check_limits(arguments.file, poses, pose, limits)
    if not poses:
        raise UsageError(f"{arguments.file} holds no pose")
    steps = [_Step(at, each, program.library, arguments) for at, each in enumerate(poses, 1)]
    if arguments.dry_run:
        at = 0.0
        for step in chain.from_iterable(repeat(steps, arguments.repeat)):
            print(step.line(at), flush=True)
            at += step.wire + step.seconds
        total = pluralize(len(steps) * arguments.repeat, "pose")
        print(f"{total} in {at:.3f} s: nothing was sent", file=sys.stderr)
        return DONE
    with (
        failures_reported(arguments),
        open_client(arguments, program, limits=limits.allowed) as controller,
    ):
        return _play(controller, program.library, steps, arguments.repeat, limits)


class _Step:
    """One motion, and how long to wait for it."""

    def __init__(
        self, number: int, recorded: Recorded, library: Library, arguments: argparse.Namespace
    ) -> None:
        pose = the_pose(library)
        time_ms = arguments.time_ms if recorded.time_ms is None else recorded.time_ms
        pause = arguments.pause if recorded.pause_s is None else recorded.pause_s
        self.message: Message = pose.motion(recorded.positions.items(), time_ms)
        self.number = number
        self.ids = tuple(recorded.positions)
        self.seconds = time_ms / 1000 + pause
        self.wire = WireTime(library.link, arguments.baud).seconds(len(self.message.encode()))

    def line(self, at: float) -> str:
        """Return the line that is printed for it."""
        what = f"{type(self.message).__name__} {fields_as_text(self.message)}"
        return f"{at:12.6f}  pose {self.number}  {what}"


def _play(
    controller: Client, library: Library, steps: list[_Step], times: int, limits: Chosen
) -> int:
    began = time.monotonic()
    done = 0
    try:
        for step in chain.from_iterable(repeat(steps, times)):
            at = time.monotonic()
            print(step.line(at - began), flush=True)
            sent = controller.send(step.message)
            slept(at + sent.delay + sent.duration + step.seconds, "the next pose")
            done += 1
    except KeyboardInterrupt:
        ids = tuple(dict.fromkeys(each for step in steps for each in step.ids))
        return stopped_by_hand(controller, library, ids, limits)
    finally:
        print(f"{done} of {pluralize(len(steps) * times, 'pose')} played", file=sys.stderr)
    return DONE


def _time_of(pose: Pose) -> Callable[[str], int]:
    """Return what reads how long a motion takes, in milliseconds."""
    bounds = pose.duration

    def time_ms(text: str) -> int:
        try:
            given = whole(text)
        except ValueError as error:
            raise argparse.ArgumentTypeError(str(error)) from None
        if not bounds.low <= given <= bounds.high:
            problem = f"{given} is outside {bounds.low}..{bounds.high} milliseconds"
            raise argparse.ArgumentTypeError(problem)
        return given

    return time_ms
