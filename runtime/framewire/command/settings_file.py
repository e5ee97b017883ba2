"""What a file of settings may hold: TOML, of which every key is checked before any is used."""

from __future__ import annotations

import json
import math
import re
import sys
from difflib import get_close_matches

from .limits import ANY, Chosen
from .numerals import whole
from .settings import Settings
from .usage_error import UsageError

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

TYPE_CHECKING = False
if TYPE_CHECKING:
    from pathlib import Path
    from typing import Any

    from ..client.library import Library
    from ..client.limits import Bounds

# Where the reader of TOML says that an error is.
_PLACE = re.compile(r" \((?:at line (\d+), column (\d+)|at end of document)\)$")
# What its reasons mean to whoever has written a name of a port, or a key twice.
_HINTS = {
    "Invalid value": 'text stands in quotes: port = "COM7"',
    "Cannot overwrite": "a key stands there once",
    "Unescaped": r"with backslashes, text stands in single quotes: port = '\\.\COM10'",
}
_MARK = b"\xef\xbb\xbf"  # that it is UTF-8, as some editors of Windows begin a file


def parsed(path: Path, data: bytes, library: Library) -> Settings:
    """Return the settings in the bytes of a file. Raises UsageError that names path and key."""
    return _Reader(path, text_of(path, data), library).settings()


def text_of(path: Path, data: bytes) -> str:
    """Return the text in the bytes of a file, its line breaks as they are. Raises UsageError."""
    try:
        return data.removeprefix(_MARK).decode()
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        raise UsageError(f"{path}, line {line}: it is not UTF-8: save it as that") from None


def table_of(path: Path, text: str) -> dict[str, Any]:
    """Return the keys and values of TOML. Raises UsageError."""
    try:
        return tomllib.loads(text)
    except (ValueError, RecursionError) as error:
        problem, where = str(error), str(path)
        place = _PLACE.search(problem)
        if place is not None:
            problem = problem[: place.start()]
            line, column = place.groups()
            where += f", line {line}, column {column}" if line else ", at its end"
        hint = next((f"; {said}" for part, said in _HINTS.items() if part in problem), "")
        raise UsageError(f"{where}: it is not TOML: {problem}{hint}") from None


class _Reader:
    """A reader of one file, with errors that name its path, the line and the key."""

    def __init__(self, path: Path, text: str, library: Library) -> None:
        self._path = path
        self._text = text
        self._library = library
        self._pose = library.pose
        self._table = table_of(path, text)

    def settings(self) -> Settings:
        known = ["port", "baud", "local_echo", "ids", "limits"]
        for key in self._table:
            if key not in known:
                near = get_close_matches(key, known, 1)
                hint = f"did you mean {near[0]}?" if near else f"there are {', '.join(known)}"
                raise self._wrong([key], f"there is no such key; {hint}")
        return Settings(
            self._path, self._port(), self._baud(), self._echo(), self._ids(), self._limits()
        )

    def _port(self) -> str | None:
        port = self._table.get("port")
        if port is None or (isinstance(port, str) and port):
            return port
        raise self._wrong(["port"], f'{_shown(port)} is no name of a port, such as "COM7"')

    def _baud(self) -> float | None:
        baud = self._table.get("baud")
        if baud is None or (_is_whole(baud) and baud >= 1):
            return baud
        if isinstance(baud, float) and math.isinf(baud) and baud > 0:
            return baud
        problem = "is no rate: a whole number of baud, 1 or more, or inf"
        raise self._wrong(["baud"], f"{_shown(baud)} {problem}")

    def _echo(self) -> bool | None:
        echo = self._table.get("local_echo")
        if echo is None or isinstance(echo, bool):
            return echo
        raise self._wrong(["local_echo"], f"{_shown(echo)} is neither true nor false")

    def _ids(self) -> tuple[int, ...]:
        ids, pose = self._table.get("ids", []), self._pose
        if "ids" in self._table and pose is None:
            raise self._wrong(["ids"], "nothing that is asked here takes a list of ids; remove it")
        if not isinstance(ids, list) or not all(map(_is_whole, ids)):
            raise self._wrong(["ids"], f"{_shown(ids)} is no list of numbers, such as [1, 2, 3]")
        for each in ids:
            if pose is not None and each not in pose.ids:
                bounds = f"{pose.ids[0]}..{pose.ids[-1]}"
                raise self._wrong(["ids"], f"{each} is outside {bounds}, which a {pose.noun} has")
        return tuple(dict.fromkeys(ids))

    def _limits(self) -> Chosen | None:
        given = self._table.get("limits")
        if given is None:
            return None
        limits = self._library.limits
        if limits.usual is None:
            raise self._wrong(["limits"], "nothing that is sent here has limits; remove it")
        if not isinstance(given, dict):
            return Chosen(self._bounds(given, ["limits"]), limits, str(self._path))
        each = {self._number(key): self._bounds(given[key], ["limits", key]) for key in given}
        addressed = any(exchange.address.field for exchange in self._library.exchanges.values())
        try:
            allowed = limits.chosen(each, addressed=addressed)
        except ValueError:
            problem = "nothing that has limits here has a number: write one pair for all"
            raise self._wrong(["limits"], f"{problem}, such as {self._usual()}") from None
        return Chosen(allowed, limits, str(self._path))

    def _number(self, key: str) -> int:
        try:
            number = whole(key)
        except ValueError:
            number = -1
        if number < 0 or str(number) != key:
            raise self._wrong(["limits", key], f"{key[:40]!r} is not a number, such as 1")
        if self._pose is not None and not self._pose.item.low <= number <= self._pose.item.high:
            bounds = f"{self._pose.item.low}..{self._pose.item.high}"
            raise self._wrong(["limits", key], f"{key} is outside {bounds} of a {self._pose.noun}")
        return number

    def _bounds(self, given: Any, keys: list[str]) -> Bounds | None:
        if given == ANY:
            return None
        if not isinstance(given, list) or len(given) != 2 or not all(map(_is_whole, given)):
            problem = f'no pair like {self._usual()}, nor "{ANY}" for anything'
            raise self._wrong(keys, f"{_shown(given)} is {problem}")
        low, high = given
        if low > high:
            raise self._wrong(keys, f"{_shown(given)} has the higher value first")
        return low, high

    def _usual(self) -> str:
        """Return the usual limits, as an example."""
        return str([*(self._library.limits.usual or ())])

    def _wrong(self, keys: list[str], what: str) -> UsageError:
        """Return the error about a key, with its line if there is just one that begins with it."""
        begins = re.compile(rf"[ \t]*\[?[ \t]*[\"']?{re.escape(keys[-1])}[\"']?[ \t]*[]=.]")
        lines = enumerate(self._text.split("\n"), 1)
        found = [at for at, line in lines if begins.match(line)]
        where = f"{self._path}, line {found[0]}" if len(found) == 1 else str(self._path)
        return UsageError(f"{where}: {'.'.join(keys)}: {what}")


def _is_whole(value: object) -> bool:
    return isinstance(value, int) and not isinstance(value, bool)


def _shown(value: object) -> str:
    """Return a value as it is written, shortened."""
    number = isinstance(value, float)
    text = str(value) if number else json.dumps(value, ensure_ascii=False, default=str)
    return text if len(text) <= 40 else f"{text[:37]}..."
