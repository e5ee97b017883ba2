"""The report for people at a terminal."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framewire.command.console import visible
from framewire.frame.pluralize import pluralize

from framegen.comparison.accepted import ignored_breaks
from framegen.comparison.report.titles import group_title, shortened_list
from framegen.comparison.report.verdict import AXES, STANDING_WORDS, standing
from framegen.comparison.report.view import rule_of
from framegen.comparison.report.words import between, call_of, effect_text, hex_of

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from framegen.comparison.effect import Effect
    from framegen.comparison.report.view import Section, View

# Of what has no effect, so much is listed.
_MOST_LISTED = 10


def render(view: View) -> str:
    """Return the verdicts as a table, then each message with its changes, effects and frames."""
    if view.nothing:
        return f"{_header(view)}\n\n  nothing changed that a spec says\n"
    blocks = ["\n".join([_header(view), "", *_table(view), *_notes(view)])]
    explained: set[str] = set()
    blocks += ["\n".join(_group(view, group, explained)) for group in view.groups]
    if view.without_effect:
        blocks.append("\n".join(_without_effect(view)))
    return "\n\n".join(blocks) + "\n"


def _header(view: View) -> str:
    old, new = view.old, view.new
    name = visible(new.spec.protocol.name)
    return f"{name}: {old.label} ({visible(old.version)}) -> {new.label} ({visible(new.version)})"


def _table(view: View) -> list[str]:
    rows: list[tuple[str, str, str]] = []
    for axis in AXES:
        verdicts = [each for each in view.verdicts if each.axis == axis]
        if not any(each.effects for each in verdicts):
            rows.append((axis, "", "works as before"))
            continue
        for number, each in enumerate(verdicts):
            ends = "" if each.ends is None else f"{each.ends}: "
            rows.append(("" if number else axis, ends, str(each)))
    if view.order:
        rows.append(("upgrade", "", view.order))
    if view.version_finding:
        rows.append(("version", "", view.version_finding))
    first, second = (max(len(row[column]) for row in rows) for column in (0, 1))
    return [
        f"  {name:<{first}}  {f'{ends:<{second}}' if ends else ''}{said}"
        for name, ends, said in rows
    ]


def _notes(view: View) -> Iterator[str]:
    old, new = (each.compiled.tolerated for each in (view.old, view.new))
    if old:
        found = pluralize(len(old), "finding")
        yield f"  note: {view.old.label} has {found} by today's rules, and is compared all the same"
    if new:
        found = pluralize(len(new), "finding")
        yield f"  note: {view.new.label} is not right yet: `framegen check` shows {found}"
    if view.capped:
        yield f"  note: at most {view.most_tried} frames a message are tried out, of " + (
            shortened_list(view.capped)
        )
    for line, why in ignored_breaks(view.pair):
        yield f"  note: version {visible(line.version)} accepts nothing by `breaks`: {visible(why)}"
    for line in view.idle:
        what = f"  note: version {visible(line.version)} accepts what breaks nothing: "
        yield f"{what}{visible(line.path)}{view.meant(line)}"


def _group(view: View, group: Sequence[Section], explained: set[str]) -> Iterator[str]:
    first = group[0]
    yield group_title(view, group)
    for change in first.changes:
        yield f"  {visible(change.text)}"
        yield f"    {view.places(change)}"
        rule = rule_of(change)
        if rule is not None and rule.id not in explained:
            explained.add(rule.id)
            yield f"    why: {rule.why}"
            yield f"    do: {rule.do}"
    if len(group) > 1:
        yield f"  of {first.title}, and of the others alike:"
    shown: set[bytes | str] = set()
    for effect in first.effects:
        yield from _effect(effect, first.title, shown)


def _effect(effect: Effect, title: str, shown: set[bytes | str]) -> Iterator[str]:
    """Yield the lines of an effect; a frame or a remedy that was shown before is not repeated."""
    who = between(effect)
    where = f"{effect.axis}, {who}" if who else effect.axis
    yield f"  {STANDING_WORDS[standing(effect)]}: {where}: {effect_text(effect, title)}"
    if effect.witness is not None and effect.witness.data not in shown:
        shown.add(effect.witness.data)
        yield f"    {hex_of(effect.witness.data)}"
        yield f"    {call_of(effect.witness)}"
    if effect.accepted:
        yield f"    accepted: {visible(effect.accepted)}"
    elif effect.remedy and effect.remedy not in shown:
        shown.add(effect.remedy)
        yield f"    do: {visible(effect.remedy)}"


def _without_effect(view: View) -> Iterator[str]:
    for title, found in (
        ("without effect: {} that no end and no program notices", view.tried_in_vain),
        ("documentation: {} that nothing depends on", view.documentation),
    ):
        if found:
            yield title.format(pluralize(len(found), "change"))
        for change in found[:_MOST_LISTED]:
            yield f"  {visible(change.text)}"
            yield f"    {view.place(change)}"
        if len(found) > _MOST_LISTED:
            yield f"  and {len(found) - _MOST_LISTED} more: `--format json` lists them all"
