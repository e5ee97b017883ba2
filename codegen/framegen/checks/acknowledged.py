"""Rule: what acknowledges a message is one of its reports, and shares a field with it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.rule import Problem, StructureRule
from framegen.model.exchanges import paths_of
from framegen.reading.findings import did_you_mean

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import Message, Spec


def _look(spec: Spec) -> Iterator[Problem]:
    for name, message in spec.messages.items():
        if message.acknowledged is None:
            continue
        found = _misfit(name, message, message.acknowledged, spec)
        if found is not None:
            yield Problem(("messages", name, "acknowledged"), *found)


def _misfit(name: str, message: Message, report: str, spec: Spec) -> tuple[str, str] | None:
    if message.reply is not None:
        what = f"{name} is answered by {message.reply}, which confirms it already"
        return what, "leave out `acknowledged`"
    if message.lasts is not None:
        what = f"{name} also `lasts`, and a client can wait for only one of the two"
        return what, "leave out `acknowledged`, or `lasts`"
    if report not in message.reports:
        hint = did_you_mean(report, message.reports) or f"name {report} there, too"
        return f"{report} is not among the `reports` of {name}", hint
    other = spec.messages.get(report)
    paths = {} if other is None else paths_of(other)
    for path, in_list in paths_of(message).items():
        field = path.partition(".")[0]
        if other is not None and field in other.fields and (in_list or paths.get(path, True)):
            what = f"`{field}` is a list in {name} or in {report}"
            return what, "only numbers can be compared: give one of the two another name"
    return None


RULE = StructureRule(
    id="acknowledged",
    title="What acknowledges a message is one of its reports, and shares a field with it",
    why="A client waits for that report with the values of the message: if it can never follow, "
    "every message seems to be refused.",
    bad="LampFade: {reports: [LampLit], acknowledged: LampOut}",
    good="LampFade: {reports: [LampLit], acknowledged: LampLit}",
    look=_look,
)
