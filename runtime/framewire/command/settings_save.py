"""Save settings in their file: their own lines change, and all else stays as it is."""

from __future__ import annotations

import json
import re

from .settings import read_bytes, user_file
from .settings_file import table_of, text_of
from .usage_error import UsageError
from .whole_file import write_whole

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path
    from typing import TypeAlias

    from .program import Program

    Value: TypeAlias = str | float | bool | list[int]

# A key and its value at the beginning of a line: text, a list without comments, or one word.
_KEY = r"^[ \t]*[\"']?{}[\"']?[ \t]*=[ \t]*"
_VALUE = r"(?:\"(?:[^\"\\\n]|\\.)*\"|'[^'\n]*'|\[[^]#\"']*\]|[^\s#\"'\[{]+)"
_TABLE = re.compile(r"^[ \t]*\[", re.MULTILINE)
_ANY_KEY = re.compile(rf"{_KEY.format('[A-Za-z_]+')}{_VALUE}[^\n]*(?:\n|\Z)", re.MULTILINE)


def save(path: Path | None, values: Mapping[str, Value], program: Program) -> tuple[Path, str]:
    """Put values in the file in use, or in the user's, and return its path and their lines.

    Raises UsageError, and leaves the file as it was, where one cannot be put in by itself.
    """
    path = path or user_file(program)
    if path is None:
        raise UsageError("nothing saved: there is no home folder for settings")
    lines = [f"{key} = {_written(value)}" for key, value in values.items()]
    data = read_bytes(path) or b""
    text = before = text_of(path, data)
    for line in lines:
        text = _with(text, line)
    encoded = data[: len(data) - len(before.encode())] + text.encode(errors="replace")
    # What comes out is read again: nothing but these values may have changed.
    try:
        changed = table_of(path, text_of(path, encoded))
    except UsageError:
        changed = {}
    if changed != {**table_of(path, before), **values}:
        raise UsageError(
            f"{path}: nothing saved: what stands there cannot be changed by itself; write:", lines
        )
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise UsageError(f"{path} cannot be written: {error.strerror or error}") from None
    write_whole(path, encoded)
    return path, ", ".join(lines)


def _with(text: str, line: str) -> str:
    """Return a text in which a line stands in place of what its key was, or is added."""
    end = "\r\n" if "\r\n" in text else "\n"
    table = _TABLE.search(text)
    # A list may have lines that begin as a table does; what is read again tells.
    top = len(text) if table is None else table.start()
    key, _, value = line.partition(" = ")
    found = re.compile(f"({_KEY.format(key)}){_VALUE}", re.MULTILINE).search(text, 0, top)
    if found is not None:
        return f"{text[: found.start()]}{found[1]}{value}{text[found.end() :]}"
    at = max((each.end() for each in _ANY_KEY.finditer(text, 0, top)), default=0)
    head, rest = text[:at], text[at:]
    if head and not head.endswith("\n"):
        head += end
    gap = end if rest and not at else ""
    return f"{head}{line}{end}{gap}{rest}"


def _written(value: Value) -> str:
    """Return a value in TOML. JSON is written alike, but for the rate `inf`."""
    if isinstance(value, float):
        return f"{value:g}"
    return json.dumps(value, ensure_ascii=False)
