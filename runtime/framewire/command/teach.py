"""The verb `teach`: releases the device, and records its positions each time Enter is pressed."""

from __future__ import annotations

import sys
from pathlib import Path

from ..client.pose import HOLD_MS
from ..frame.pluralize import pluralize
from ..line.link_errors import NoReplyError
from . import link
from .exit_codes import DONE, INTERRUPTED, NOT_ALL
from .limits import add_limits, limits_of
from .link import add_port, add_timeout, failures_reported, open_client
from .posefile import Recorded, read_poses, write_poses
from .positions import (
    UNREAD,
    find_present,
    in_options,
    listed,
    nobody,
    numbers_of,
    read_targets,
    several,
    the_pose,
)
from .usage_error import UsageError

TYPE_CHECKING = False
if TYPE_CHECKING:
    import argparse

    from ..client.client import Client
    from ..client.library import Library
    from ..client.pose import Pose
    from .limits import Chosen
    from .program import Program

ENDS = link.ENDS | {
    NOT_ALL: "no reply came in time, nothing was there to switch off, or nothing was recorded"
}
ABOUT = """\
Asks first, then switches the force off: whatever it holds up falls, so support it. Move it by hand
and press Enter: each time, all positions are added to FILE as a pose, for `play`. q and Enter, or
Ctrl-D, end the recording; Ctrl-C ends it at once. Each pose is saved as soon as it is recorded.
FILE is JSON, and can be edited. An existing file is left alone unless an option says otherwise."""


def add_arguments(parser: argparse.ArgumentParser, program: Program) -> None:
    """Declare the arguments of the verb."""
    parser.add_argument("file", type=Path, metavar="FILE", help="where the poses go")
    add_port(parser, program)
    parser.add_argument(
        "--ids",
        type=numbers_of(the_pose(program.library)),
        metavar="1-6,9",
        help=f"which to switch off and to record (default: {several(program)})",
    )
    kept = parser.add_mutually_exclusive_group()
    kept.add_argument("--append", action="store_true", help="add to the poses of FILE")
    kept.add_argument("--force", action="store_true", help="replace what FILE holds")
    parser.add_argument("--yes", action="store_true", help="switch off without asking")
    parser.add_argument(
        "--hold", action="store_true", help="at the end, hold everything there without asking"
    )
    add_limits(parser, program)
    add_timeout(parser)


def run(arguments: argparse.Namespace, program: Program) -> int:
    """Record as long as somebody presses Enter."""
    pose = the_pose(program.library)
    kept = _kept(arguments, pose, program.name)
    limits = limits_of(arguments)
    with (
        failures_reported(arguments),
        open_client(arguments, program, limits=limits.allowed) as controller,
    ):
        try:
            ids = (
                arguments.ids or arguments.settings.ids or find_present(controller, program.library)
            )
        except NoReplyError as error:
            print(error, file=sys.stderr)
            return NOT_ALL
        if not ids:
            print(nobody(pose), file=sys.stderr)
            return NOT_ALL
        if len(ids) > pose.room:
            problem = f"{len(ids)} {pose.noun}s are too many: one motion moves up to {pose.room}"
            raise UsageError(f"{problem}; choose some with --ids")
        lesson = _Lesson(
            controller, program.library, ids, arguments.file, kept, limits, program.name
        )
        if not arguments.yes and not _agreed(
            f"{listed(pose, ids)} will go limp, and what they hold up falls: support it. Go on?"
        ):
            print("nothing was switched off, and nothing recorded", file=sys.stderr)
            return NOT_ALL
        return lesson.give(hold_after=arguments.hold)


class _Lesson:
    """One session of recording."""

    def __init__(
        self,
        controller: Client,
        library: Library,
        ids: tuple[int, ...],
        path: Path,
        poses: list[Recorded],
        limits: Chosen,
        program: str,
    ) -> None:
        self._controller = controller
        self._library = library
        self._pose = the_pose(library)
        self._ids = ids
        self._path = path
        self._poses = poses
        self._before = len(poses)
        self._limits = limits
        self._program = program

    def give(self, *, hold_after: bool) -> int:
        """Release, and record until the user ends it; report in any case what is limp then."""
        who = listed(self._pose, self._ids)
        left = f"{who} {'is' if len(self._ids) == 1 else 'are'} limp"
        self._controller.send(self._pose.letting_go(self._ids))
        try:
            ended = self._record()
            ending = "Hold everything where it is now?"
            if (hold_after or (ended and _agreed(ending))) and self._held():
                left = f"{who} held"
        except KeyboardInterrupt:
            print(file=sys.stderr)
            return INTERRUPTED
        finally:
            recorded = len(self._poses) - self._before
            print(f"{pluralize(recorded, 'pose')} recorded; {left}", file=sys.stderr)
            if recorded:
                hint = f"`{self._program} play {self._path} --dry-run` shows what would be sent"
                print(hint, file=sys.stderr)
        return DONE if recorded else NOT_ALL

    def _record(self) -> bool:
        """Record at each Enter; return whether the user ended it, rather than the input."""
        prompt = "Enter records a pose, q and Enter ends"
        while (line := _line(f"{prompt}: ")) is not None:
            word = line.strip().lower()
            if word in {"q", "quit"}:
                return True
            if word:
                print(
                    f"{word[:40]!r} is not an answer; press Enter, or q and Enter", file=sys.stderr
                )
                continue
            try:
                targets = self._targets()
            except UNREAD as error:
                print(f"nothing recorded: {in_options(error, self._limits)}", file=sys.stderr)
                continue
            pose = Recorded(dict(targets))
            write_poses(self._path, [*self._poses, pose], self._program)
            self._poses.append(pose)
            shown = ",".join(f"{number}:{position}" for number, position in targets)
            print(f"pose {len(self._poses)}  {shown}", flush=True)
        return False

    def _held(self) -> bool:
        try:
            # One motion has room for all of them.
            self._controller.send(self._pose.motion(self._targets(), HOLD_MS))
        except UNREAD as error:
            print(f"not held: {in_options(error, self._limits)}", file=sys.stderr)
            return False
        return True

    def _targets(self) -> list[tuple[int, int]]:
        """Return the current positions, as targets. Raises one of UNREAD unless all are present."""
        return read_targets(self._controller, self._library, self._ids, self._limits.allowed)


def _kept(arguments: argparse.Namespace, pose: Pose, program: str) -> list[Recorded]:
    """Return the poses that are kept. Raises UsageError if a file would be lost."""
    path: Path = arguments.file
    if path.exists() and not path.is_file():
        raise UsageError(f"{path} is not a regular file, as poses need one: name another")
    if arguments.append and path.exists():
        return read_poses(path, pose, program)
    if path.exists() and not arguments.force:
        raise UsageError(
            f"{path} exists already; --append adds to its poses, --force replaces them"
        )
    if not path.parent.is_dir():
        raise UsageError(f"{path} cannot be written: there is no folder {path.parent}")
    return []


def _agreed(question: str) -> bool:
    """Return the answer to a yes-or-no question; no if there is none."""
    line = _line(f"{question} [y/N] ")
    return line is not None and line.strip().lower() in {"y", "yes"}


def _line(prompt: str) -> str | None:
    """Return a line that the user types; None once there is no more."""
    print(prompt, end="", file=sys.stderr, flush=True)
    try:
        line = sys.stdin.readline()
    except UnicodeDecodeError:
        return "?"
    except OSError:  # it is closed: nobody types
        line = ""
    if not line:
        print(file=sys.stderr)
    return line or None
