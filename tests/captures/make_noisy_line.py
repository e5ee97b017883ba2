"""The noisy line: its events as noisy_line.md has them, from which this writes noisy_line.bin.

Run it without arguments after a change of a row. No byte is drawn at random, so the two files come
out the same everywhere. The session is made up, but nothing in it is far-fetched: the frames are
those of the protocol document, what is known of boards in the field, and the mistakes people make.
"""

import re
from pathlib import Path
from typing import NamedTuple

PAGE = Path(__file__).with_name("noisy_line.md")
_ROW = re.compile(r"^\| \d+ \| \d+ \| (\w+) \| `([0-9A-F ]+)` \| (.*) \| (.*) \|$", re.MULTILINE)


class Event(NamedTuple):
    """Bytes that came onto the line together, and their correct decoding."""

    sender: str
    hex: str
    story: str
    reads_as: str
    """What its bytes belong to when either side may have sent them, in order.

    A frame that is legal both ways is named as the host's. Two names where the bytes fall apart;
    the name of the event before where that one swallows their beginning.
    """

    @property
    def data(self) -> bytes:
        """The bytes themselves."""
        return bytes.fromhex(self.hex)


EVENTS = tuple(Event(*row) for row in _ROW.findall(PAGE.read_text(encoding="utf-8")))


def recording() -> bytes:
    """Return the bytes of all events in order, as the recorder saw them."""
    return b"".join(event.data for event in EVENTS)


def description() -> str:
    """Return the page with its events and their offsets counted again."""
    number = offset = 0

    def counted(row: re.Match[str]) -> str:
        nonlocal number, offset
        number, event = number + 1, Event(*row.groups())
        cells = (number, offset, event.sender, f"`{event.hex}`", event.story, event.reads_as)
        offset += len(event.data)
        return "| " + " | ".join(map(str, cells)) + " |"

    page = _ROW.sub(counted, PAGE.read_text(encoding="utf-8"))
    return re.sub(r"\d+ events, \d+ bytes", f"{number} events, {offset} bytes", page)


def main() -> None:
    """Write both files."""
    PAGE.write_text(description(), encoding="utf-8", newline="\n")
    PAGE.with_suffix(".bin").write_bytes(recording())


if __name__ == "__main__":
    main()
