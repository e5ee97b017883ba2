"""Settings of a verb with a port: by option, by environment variable, by file, or as usual.

The file is of the command alone: the library reads none by itself.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import NamedTuple

from .limits import Chosen
from .usage_error import UsageError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from argparse import Namespace

    from .program import Program


class Settings(NamedTuple):
    """What a file says; None and empty for what it leaves open."""

    path: Path | None = None
    port: str | None = None
    baud: float | None = None
    local_echo: bool | None = None
    ids: tuple[int, ...] = ()
    limits: Chosen | None = None


def fill_in(arguments: Namespace, program: Program) -> None:
    """Give the arguments of a verb with a port the values that no option has given.

    `settings` is what the file says, and `port_from` what names the port, if it is no option.
    Raises UsageError for a file that cannot be used, even where nothing of it is needed.
    """
    arguments.settings = settings = read_settings(program)
    file, variable = program.settings_file, os.environ.get(program.port_variable)
    arguments.port_from = ""
    if arguments.port is None and variable:
        arguments.port, arguments.port_from = variable, program.port_variable
    elif arguments.port is None and settings.port is not None:
        # Not by its path, which holds a user's name: reports of `doctor` show this to others.
        whose = "this folder" if settings.path == Path(file) else "the user's folder"
        arguments.port, arguments.port_from = settings.port, f"{file} in {whose}"
    link, limits = program.library.link, program.library.limits
    usual = {
        "baud": link.baud,
        "local_echo": link.local_echo,
        "limits": Chosen(limits.usual, limits),
    }
    for name, value in usual.items():
        if getattr(arguments, name, value) is None:
            said = getattr(settings, name)
            setattr(arguments, name, value if said is None else said)


def read_settings(program: Program) -> Settings:
    """Return what the file in this folder says, else the user's; nothing where there is none.

    Raises UsageError for a file that cannot be used.
    """
    for path in (Path(program.settings_file), user_file(program)):
        data = None if path is None else read_bytes(path)
        if path is not None and data is not None:
            # Imported by those alone who have such a file: reading TOML takes some milliseconds.
            from .settings_file import parsed

            return parsed(path, data, program.library)
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


def user_file(program: Program) -> Path | None:
    """Return the path of the user's file, there or not; None for a user without a home."""
    try:
        return _user_folder() / program.name / program.settings_file
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
