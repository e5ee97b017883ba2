"""The verbs that every command has, and those of commands that move things."""

from __future__ import annotations

from framewire.command.own_verbs import FIRST, OTHERS

VERBS = tuple(dict.fromkeys(verb for verb, _, _ in (*FIRST, *OTHERS)))
# Those for positions. A message may have the verb `stop` all the same: it is sent first.
OF_POSES = frozenset(verb for verb, needs, _ in OTHERS if needs == "poses")
STOP = "stop"
