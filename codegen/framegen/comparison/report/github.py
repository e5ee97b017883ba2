"""The report for GitHub: an annotation of the new spec for each break, then the Markdown."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.report import markdown
from framegen.comparison.report.verdict import standing
from framegen.comparison.report.words import between, hex_of
from framegen.console import visible

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.effect import Effect
    from framegen.comparison.report.view import View

_LEVELS = {"breaks": "error", "uncertain": "warning", "accepted": "notice"}


def render(view: View) -> str:
    """Return workflow commands, a line each, and the report in Markdown."""
    commands = "".join(f"{each}\n" for each in workflow_commands(view))
    # A runner looks for commands of the older kind within a line, too.
    return commands + markdown.render(view).replace("##[", "# #[")


def workflow_commands(view: View) -> Iterator[str]:
    """Yield a workflow command for each effect that breaks, and one for the version."""
    for effect in view.effects:
        if effect.breaks:
            yield _annotation(view, effect)
    if view.version_finding:
        at = _place(view, ("protocol", "version"))
        yield f"::warning {at},title=version::{workflow_message(view.version_finding)}"


def _annotation(view: View, effect: Effect) -> str:
    who = between(effect)
    title = f"{effect.axis}, {who}" if who else effect.axis
    text = effect.text
    if effect.witness is not None:
        text += f"\n{hex_of(effect.witness.data)}"
    if effect.accepted:
        text += f"\naccepted: {effect.accepted}"
    # What is gone is shown where it would stand.
    at = _place(view, effect.new or (effect.old or ())[:1])
    level = _LEVELS[standing(effect)]
    return f"::{level} {at},title={workflow_property(title)}::{workflow_message(text)}"


def _place(view: View, path: tuple[str | int, ...]) -> str:
    at = view.new.compiled.tree.key_at(path)
    # The file at a revision is the same file.
    file = view.new.label.rpartition(":")[2]
    return f"file={workflow_property(file)},line={at.line},col={at.column}"


def workflow_message(text: str) -> str:
    """Escape the message of a workflow command."""
    lines = "\n".join(visible(line) for line in text.split("\n"))
    return lines.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")


def workflow_property(text: str) -> str:
    """Escape a property of a workflow command."""
    return workflow_message(visible(text)).replace(":", "%3A").replace(",", "%2C")
