"""Exit statuses of the command, the same for every verb."""

from __future__ import annotations

from . import console

DONE = console.DONE
# What each verb means by it stands in its ENDS.
NOT_ALL = 1
UNUSABLE = console.UNUSABLE
LINE_LOST = 3
INTERRUPTED = console.INTERRUPTED
READER_GONE = console.READER_GONE
# What a shell reports for a program that SIGTERM ended.
TERMINATED = 143

MEANINGS = {
    DONE: "done",
    UNUSABLE: "the input, an option or the port cannot be used; the error says why",
    INTERRUPTED: "ended by Ctrl-C",
    READER_GONE: "the program that read the output has ended",
}
