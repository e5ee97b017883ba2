"""The verbs that every command has, and those of commands that move things."""

from __future__ import annotations

# In the order of a day's work: what programs call is last.
VERBS = (
    *("ports", "doctor", "stop", "hold", "monitor", "teach", "play", "decode", "explain", "docs"),
    *("encode", "send", "stats", "replay", "simulate", "answer", "bench-line"),
)
# Those for positions. A message may have the verb `stop` all the same: it is sent first.
OF_POSES = frozenset({"stop", "hold", "teach", "play"})
STOP = "stop"
