"""Settings of a verb with a port: by option, by environment variable, by file, or as usual.

The file is of the command alone: the library reads none by itself.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import NamedTuple

from .._client.exchanges import LIMITS
from .._frame.protocol import BAUD, LOCAL_ECHO
from .examples import PROGRAM
from .limits import Chosen
from .usage_error import UsageError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from argparse import Namespace

# The environment variable that names the port where no option does.
VARIABLE = f"{PROGRAM.upper()}_PORT"
FILE = f"{PROGRAM}.toml"


class Settings(NamedTuple):
    """What a file says; None and empty for what it leaves open."""

    path: Path | None = None
    port: str | None = None
    baud: float | None = None
    local_echo: bool | None = None
    ids: tuple[int, ...] = ()
    limits: Chosen | None = None


def fill_in(arguments: Namespace) -> None:
    """Give the arguments of a verb with a port the values that no option has given.

    `settings` is what the file says, and `port_from` what names the port, if it is no option.
    Raises UsageError for a file that cannot be used, even where nothing of it is needed.
    """
    arguments.settings = settings = read_settings()
    variable = os.environ.get(VARIABLE)
    arguments.port_from = ""
    if arguments.port is None and variable:
        arguments.port, arguments.port_from = variable, VARIABLE
    elif arguments.port is None and settings.port is not None:
        # Not by its path, which holds a user's name: reports of `doctor` show this to others.
        whose = "this folder" if settings.path == Path(FILE) else "the user's folder"
        arguments.port, arguments.port_from = settings.port, f"{FILE} in {whose}"
    usual = {"baud": BAUD, "local_echo": LOCAL_ECHO, "limits": Chosen(LIMITS.usual)}
    for name, value in usual.items():
        if getattr(arguments, name, value) is None:
            said = getattr(settings, name)
            setattr(arguments, name, value if said is None else said)


def read_settings() -> Settings:
    """Return what the file in this folder says, else the user's; nothing where there is none.

    Raises UsageError for a file that cannot be used.
    """
    for path in (Path(FILE), user_file()):
        data = None if path is None else read_bytes(path)
        if path is not None and data is not None:
            # Imported by those alone who have such a file: reading TOML takes some milliseconds.
            from .settings_file import parsed

            return parsed(path, data)
    return Settings()


def read_bytes(path: Path) -> bytes | None:
    """Return what a file holds; None where there is none. Raises UsageError."""
    try:
        return path.read_bytes()
    except (FileNotFoundError, NotADirectoryError):
        return None
    except OSError as error:
        advice = "set that right, or move it away"
        raise UsageError(f"{path} cannot be read: {error.strerror or error}; {advice}") from None


def user_file() -> Path | None:
    """Return the path of the user's file, there or not; None for a user without a home."""
    try:
        return _user_folder() / PROGRAM / FILE
    except RuntimeError:
        return None


def _user_folder() -> Path:
    if sys.platform == "win32":
        named, usual = os.environ.get("APPDATA"), ("AppData", "Roaming")
    else:
        named, usual = os.environ.get("XDG_CONFIG_HOME"), (".config",)
        if sys.platform == "darwin":
            usual = ("Library", "Application Support")
    # A path that is not absolute is invalid there, and does not count.
    if named and Path(named).is_absolute():
        return Path(named)
    return Path.home().joinpath(*usual)
