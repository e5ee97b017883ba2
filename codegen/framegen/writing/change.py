"""Changes: files that differ from what is wanted, and whose work would be replaced."""

from __future__ import annotations

from dataclasses import dataclass
from difflib import unified_diff
from io import StringIO
from typing import TYPE_CHECKING, Literal

from framewire.command.console import visible
from framewire.frame.pluralize import pluralize

if TYPE_CHECKING:
    from collections.abc import Sequence

Why = Literal["missing", "stale", "conflicted", "orphaned", "edited by hand", "foreign"]
# As many are named where there are many.
_NAMED = 20


@dataclass(frozen=True, slots=True)
class Change:
    """One file that differs from what is wanted. `new` is None where no file should be."""

    path: str
    why: Why
    old: str | None
    new: str | bytes | None

    @property
    def ours(self) -> bool:
        """Whether nobody loses anything by it."""
        return self.why not in ("edited by hand", "foreign")

    def diff(self) -> str:
        """Return the change as a unified diff; of what is no text, that it differs."""
        before = "/dev/null" if self.old is None else f"a/{visible(self.path)}"
        after = "/dev/null" if self.new is None else f"b/{visible(self.path)}"
        if isinstance(self.new, bytes):
            return f"Binary files {before} and {after} differ\n"
        old, new = (list(StringIO(text or "")) for text in (self.old, self.new))
        shown = "".join(
            line if line.endswith("\n") else f"{line}\n\\ No newline at end of file\n"
            for line in unified_diff(old, new, before, after)
        )
        # An empty file that comes or goes has no lines to show.
        return shown or f"--- {before}\n+++ {after}\n"


def describe(found: Sequence[Change]) -> str:
    """Describe the conflicts, a line each; of many, the number of further ones."""
    lines = [f"{change.why}: {visible(change.path)}" for change in found[:_NAMED]]
    if len(found) > len(lines):
        lines.append(f"and {pluralize(len(found) - len(lines), 'more file')}")
    return "\n".join(f"  {line}" for line in lines)
