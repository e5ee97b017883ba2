"""The file format of a recording: a line of hex for each event, and a comment.

    # recorded of '/dev/ttyUSB0' from 2026-01-02 09:08:07.250000 +0000 on
    HEX  # 0.000000 s, SENDER: what it says
    HEX  # 0.004167 s, noise: why it is noise
    # quiet

Times are seconds from its beginning. `# quiet` says that the line went quiet within a frame: what
follows is not the rest of it. Any reader of hex can read such a file; `recordings` reads all of it.
"""

from __future__ import annotations

import errno
import os
import stat
import time
from io import TextIOWrapper

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from os import PathLike

QUIET = "# quiet"
# What stands in the place of the sender: bytes that are no message, and what either end may send.
NOISE, EITHER = "noise", "either"

# No child has the file, and Windows leaves the ends of lines to Python.
_FLAGS: int = getattr(os, "O_CLOEXEC", 0) | getattr(os, "O_BINARY", 0)


class RecordingFile:
    """An open recording. Raises OSError where the file cannot be written.

    A recording is never overwritten: FileExistsError is raised for a file that holds anything. An
    empty file is accepted, and so is what is no file at all, such as a FIFO or /dev/null.
    """

    def __init__(self, path: str | PathLike[str]) -> None:
        # Not emptied by opening it, so that nothing is lost before it has been looked at.
        handle = os.open(path, os.O_WRONLY | os.O_CREAT | _FLAGS, 0o666)
        held = os.fstat(handle)
        if stat.S_ISREG(held.st_mode) and held.st_size:
            os.close(handle)
            raise FileExistsError(
                errno.EEXIST,
                f"it holds {held.st_size} bytes, and a recording is never overwritten; "
                "give another name, or remove it",
                os.fspath(path),
            )
        # A name may hold anything, and a line with anything but ASCII is taken for no hex. By the
        # line, so that the file is whole up to the last event whatever happens.
        self._file = TextIOWrapper(
            os.fdopen(handle, "wb"),
            encoding="ascii",
            errors="backslashreplace",
            line_buffering=True,
        )

    def begin(self, name: str) -> None:
        """Note what is recorded, and start its clock."""
        now = time.time()
        day = time.localtime(now)
        clock = f"{time.strftime('%Y-%m-%d %H:%M:%S', day)}.{int(now % 1 * 1_000_000):06d}"
        self._file.write(f"# recorded of {name!r} from {clock} {time.strftime('%z', day)} on\n")

    def write(self, data: bytes, at: float, who: str, what: object) -> None:
        """Write the bytes of one event, `at` seconds from the beginning."""
        self._file.write(f"{data.hex(' ').upper()}  # {at:.6f} s, {who}: {what}\n")

    def note(self, text: str) -> None:
        """Write a comment in a line of its own."""
        self._file.write(f"# {' '.join(text.split())}\n")

    def quiet(self) -> None:
        """Note that half a frame was given up: what follows is not its other half."""
        self._file.write(f"{QUIET}\n")

    def close(self) -> None:
        """Close the file. Raises OSError where its end could not be written."""
        self._file.close()
