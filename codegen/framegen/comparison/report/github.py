"""The report for GitHub: an annotation of the new spec for each break, then the Markdown."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from framewire.command.console import visible

from framegen.comparison.report import markdown
from framegen.comparison.report.ends import ends_of
from framegen.comparison.report.verdict import standing
from framegen.comparison.report.words import between, hex_of

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from framegen.comparison.effect import Effect
    from framegen.comparison.report.view import View

_LEVELS = {"breaks": "error", "uncertain": "warning", "accepted": "notice"}


def render(view: View) -> str:
    """Return workflow commands, a line each, and the report in Markdown."""
    commands = "".join(f"{each}\n" for each in workflow_commands(view))
    # A runner looks for commands of the older kind within a line, too.
    return commands + markdown.render(view).replace("##[", "# #[")


def workflow_commands(view: View) -> Iterator[str]:
    """Yield a workflow command for each message and each two ends that break, and the version's."""
    found: dict[object, list[Effect]] = {}
    for effect in view.effects:
        if effect.breaks:
            found.setdefault(_about(view, effect), []).append(effect)
    for effects in found.values():
        yield _annotation(view, effects)
    if view.version_finding:
        at = _place(view, ("protocol", "version"))
        yield f"::warning {at},title=version::{workflow_message(view.version_finding)}"


def _about(view: View, effect: Effect) -> object:
    """Return what an annotation is about: how bad it is, of which message, and between whom."""
    ends = None if effect.axis == "programs" else str(ends_of(view.pair, effect))
    return standing(effect), ends, effect.editions, effect.path[:2]


def _annotation(view: View, effects: Sequence[Effect]) -> str:
    first = effects[0]
    axes = " and ".join(dict.fromkeys(each.axis for each in effects))
    who = between(first)
    title = f"{axes}, {who}" if who else axes
    lines = [line for each in effects for line in _lines(each)]
    lines += [f"do: {remedy}" for remedy in view.remedies(effects)]
    text = "\n".join(dict.fromkeys(lines))
    # What is gone is shown where it would stand.
    at = _place(view, first.new or (first.old or ())[:1])
    level = _LEVELS[standing(first)]
    return f"::{level} {at},title={workflow_property(title)}::{workflow_message(text)}"


def _lines(effect: Effect) -> Iterator[str]:
    yield effect.text
    if effect.witness is not None:
        yield hex_of(effect.witness.data)
    if effect.accepted:
        yield f"accepted: {effect.accepted}"


def _place(view: View, path: tuple[str | int, ...]) -> str:
    at = view.new.compiled.tree.key_at(path)
    return f"file={workflow_property(_file(view.new.label))},line={at.line},col={at.column}"


def _file(label: str) -> str:
    """Return the file of an edition. That at a revision is the same; no revision has a colon."""
    return label if Path(label).is_file() else label.partition(":")[2] or label


def workflow_message(text: str) -> str:
    """Escape the message of a workflow command."""
    lines = "\n".join(visible(line) for line in text.split("\n"))
    return lines.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")


def workflow_property(text: str) -> str:
    """Escape a property of a workflow command."""
    return workflow_message(visible(text)).replace(":", "%3A").replace(",", "%2C")
