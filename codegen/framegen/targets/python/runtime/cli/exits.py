"""How the command ends: the numbers that a shell gets to see, the same for every verb."""

from __future__ import annotations

DONE = 0
# What each verb means by it stands in its ENDS.
NOT_ALL = 1
UNUSABLE = 2
LINE_LOST = 3
# What a shell reports for a program that SIGINT, SIGPIPE or SIGTERM ended.
INTERRUPTED = 130
READER_GONE = 141
TERMINATED = 143

MEANINGS = {
    DONE: "done",
    UNUSABLE: "what was given is of no use, or the port cannot be opened; the error says why",
    INTERRUPTED: "ended by Ctrl-C",
    READER_GONE: "whoever read the output has gone",
}
