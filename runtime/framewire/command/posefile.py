"""A file of poses: JSON that `teach` writes, `play` reads, and anybody can edit."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from difflib import get_close_matches

from ..frame.errors import EncodeError
from .usage_error import UsageError
from .whole_file import write_whole

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence
    from pathlib import Path
    from typing import Any

    from ..client.pose import Pose
    from .limits import Chosen

VERSION = 1
# The longest pause that a motion may be followed by.
LONGEST_PAUSE = 3600.0


@dataclass(frozen=True)
class Recorded:
    """One pose: positions by number; how long the way there takes, and the pause after it.

    None if the file leaves that to `play`.
    """

    positions: dict[int, int]
    time_ms: int | None = None
    pause_s: float | None = None


def read_poses(path: Path, pose: Pose, program: str) -> list[Recorded]:
    """Return all poses of a file, proven sendable. Raises UsageError with the place.

    `program` is the command whose file it has to be.
    """
    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        problem = getattr(error, "strerror", None) or error
        raise UsageError(f"{path} cannot be read: {problem}") from None
    try:
        data = json.loads(text, object_pairs_hook=_without_doubles)
    except json.JSONDecodeError as error:
        where = f"line {error.lineno}, column {error.colno}"
        raise UsageError(f"{path}, {where}: it is not JSON: {error.msg}") from None
    except (ValueError, RecursionError) as error:
        raise UsageError(f"{path}: {error}") from None
    return _Reader(path, pose, _format(program)).poses(data)


def write_poses(path: Path, poses: Sequence[Recorded], program: str) -> None:
    """Write the poses, one a line, and leave no half file behind. Raises UsageError."""
    lines = ",\n".join(f"    {json.dumps(_plain(each))}" for each in poses)
    text = (
        f'{{\n  "format": {json.dumps(_format(program))},\n  "version": {VERSION},\n  "poses": [\n'
        f"{lines}\n  ]\n}}\n"
    )
    write_whole(path, text.encode())


def check_limits(path: Path, poses: Iterable[Recorded], pose: Pose, limits: Chosen) -> None:
    """Raise UsageError for the first position that is outside its limits."""
    each_its_own = isinstance(limits.allowed, Mapping)
    for at, recorded in enumerate(poses):
        for number, position in recorded.positions.items():
            bounds = pose.limits.of(number, limits.allowed)
            if bounds is not None and not bounds[0] <= position <= bounds[1]:
                owner = f"{pose.noun} {number}" if each_its_own else ""
                place = f"{path}: poses[{at}].positions.{number}"
                raise limits.outside(place, position, bounds, owner)


def _format(program: str) -> str:
    """Return what the files of a command say of themselves."""
    return f"{program} poses"


def _plain(pose: Recorded) -> dict[str, Any]:
    plain: dict[str, Any] = {"positions": {str(key): at for key, at in pose.positions.items()}}
    if pose.time_ms is not None:
        plain["time_ms"] = pose.time_ms
    if pose.pause_s is not None:
        plain["pause_s"] = pose.pause_s
    return plain


def _without_doubles(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """Return an object of the file. Raises ValueError if a key is there twice."""
    made: dict[str, Any] = {}
    for key, value in pairs:
        if key in made:
            raise ValueError(f"the key {key[:40]!r} appears twice in one object")
        made[key] = value
    return made


class _Reader:
    """A reader of the file's objects, with errors that name the place."""

    def __init__(self, path: Path, pose: Pose, form: str) -> None:
        self._path = path
        self._pose = pose
        self._form = form

    def poses(self, data: Any) -> list[Recorded]:
        self._object(data, "", ["format", "version", "poses"], needed=3)
        if data["format"] != self._form:
            raise self._wrong("format", f"{_shown(data['format'])} is not {self._form!r}")
        if data["version"] != VERSION or isinstance(data["version"], bool):
            problem = f"{_shown(data['version'])} is not a version known here, which is {VERSION}"
            raise self._wrong("version", problem)
        if not isinstance(data["poses"], list):
            raise self._wrong("poses", f"{_shown(data['poses'])} is not a list")
        return [self._recorded(each, f"poses[{at}]") for at, each in enumerate(data["poses"])]

    def _recorded(self, data: Any, place: str) -> Recorded:
        self._object(data, place, ["positions", "time_ms", "pause_s"], needed=1)
        here = f"{place}.positions"
        self._object(data["positions"], here, None)
        positions = {
            self._number(key, here): self._value(self._pose.place, value, f"{here}.{key}")
            for key, value in data["positions"].items()
        }
        if len(positions) not in range(1, self._pose.room + 1):
            problem = f"{len(positions)} {self._pose.noun}s is outside 1..{self._pose.room}"
            raise self._wrong(here, f"{problem}, which one motion has room for")
        time_ms = data.get("time_ms")
        if time_ms is not None:
            time_ms = self._value(self._pose.duration, time_ms, f"{place}.time_ms")
        pause = data.get("pause_s")
        if pause is not None and not (
            isinstance(pause, (int, float))
            and not isinstance(pause, bool)
            and 0 <= pause <= LONGEST_PAUSE
        ):
            problem = f"{_shown(pause)} is no number of seconds from 0 to {LONGEST_PAUSE:g}"
            raise self._wrong(f"{place}.pause_s", problem)
        return Recorded(positions, time_ms, pause)

    def _number(self, key: str, place: str) -> int:
        if not (key.isascii() and key.isdecimal()) or str(int(key[:9])) != key:
            problem = f'{key[:40]!r} is not the number of a {self._pose.noun}, such as "1"'
            raise self._wrong(place, problem)
        return self._value(self._pose.item, int(key), f"{place}.{key}")

    def _value(self, number: Any, value: Any, place: str) -> int:
        try:
            checked: int = number.checked(value, place)
        except EncodeError as error:
            raise self._wrong(place, error.problem) from None
        return checked

    def _object(self, data: Any, place: str, known: list[str] | None, *, needed: int = 0) -> None:
        """Raise UsageError unless it has the first `needed` of the known keys, and no other."""
        if not isinstance(data, dict):
            raise self._wrong(place, f"{_shown(data)} is not an object {{...}}")
        if known is None:
            return
        for key in data:
            if key not in known:
                near = get_close_matches(key, known, 1)
                hint = f"did you mean {near[0]!r}?" if near else f"there are {', '.join(known)}"
                raise self._wrong(place, f"there is no key {key[:40]!r}; {hint}")
        for key in known[:needed]:
            if key not in data:
                raise self._wrong(place, f"the key {key!r} is missing")

    def _wrong(self, place: str, what: str) -> UsageError:
        return UsageError(f"{self._path}: {place}: {what}" if place else f"{self._path}: {what}")


def _shown(value: Any) -> str:
    text = json.dumps(value)
    return text if len(text) <= 40 else f"{text[:37]}..."
