"""The arguments that name a capture, for the verbs that read one: hex, a file, standard input."""

from __future__ import annotations

import io
from contextlib import contextmanager
from pathlib import Path

from ..codec.hextext import HexError, is_hex, read_hex
from ..recording.form import FORMS, log_lines
from .recording import Recording, opened
from .usage_error import UsageError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace
    from collections.abc import Iterator

    from ..codec.protocol_codec import ProtocolCodec
    from ..frame.direction import Direction


def add_capture(parser: ArgumentParser, codec: ProtocolCodec) -> None:
    """Declare the arguments that name a capture and describe what it holds."""
    parser.add_argument(
        "input",
        nargs="*",
        metavar="HEX|FILE",
        help="bytes in hex, or one file of hex or raw bytes; - or nothing is standard input",
    )
    parser.add_argument("--file", type=Path, metavar="FILE", help="a file, even if its name is hex")
    parser.add_argument(
        "--direction",
        choices=[*codec.named, "any"],
        default="any",
        help="who sent the bytes, where they do not say so themselves (default: any)",
    )
    parser.add_argument(
        "--format",
        choices=FORMS,
        default="auto",
        help="what a file or standard input holds (default: auto, by its first word)",
    )


def direction_in(arguments: Namespace, codec: ProtocolCodec) -> Direction | None:
    """Return who sent the bytes, None for either."""
    return codec.named.get(arguments.direction)


@contextmanager
def opened_capture(arguments: Namespace, codec: ProtocolCodec) -> Iterator[tuple[Recording, str]]:
    """Open the input, and return it with its form. Raises UsageError."""
    words: list[str] = arguments.input
    file: Path | None = arguments.file
    if file is not None and words:
        raise UsageError("give either --file or bytes, not both")
    if file is None and len(words) == 1 and words[0] != "-" and is_file(words[0]):
        file = Path(words[0])
    if file is None and words and words != ["-"]:
        text = " ".join(words)
        if log_lines(text) is not None:
            stream = io.BytesIO(text.encode(errors="replace"))
            yield Recording(stream, "the command line", codec), "hex"
            return
        try:
            data = read_hex(text)
        except HexError as error:
            _refuse_files(words)
            other = f", and there is no file {words[0]!r}" if len(words) == 1 else ""
            raise UsageError(f"{error}{other}") from None
        yield Recording(io.BytesIO(data), "the command line", codec), "raw"
        return
    with opened(file or Path("-"), codec) as recording:
        yield recording, arguments.format


def _refuse_files(words: list[str]) -> None:
    """Raise UsageError for a folder, and for more files than one."""
    if len(words) == 1 and _is_folder(words[0]):
        raise UsageError(f"{words[0]} is a folder: name a file in it")
    if all(map(is_file, words)):
        raise UsageError(f"these are {len(words)} files: give one at a time")


def _is_folder(word: str) -> bool:
    try:
        return Path(word).is_dir()
    except (OSError, ValueError):
        return False


def is_file(word: str) -> bool:
    """Return whether a word names a file, rather than bytes."""
    try:
        return not is_hex(word) and Path(word).is_file()
    except (OSError, ValueError):
        return False
