"""Changes to the text of a spec, each at a place that is there once.

    {replace: TEXT, with: TEXT}     a stretch of one line
    {mark: TEXT}                    the same, to add nothing but marks
    {instead: LINE, add: LINES}     the line that begins so; the new ones are indented as it is
    {before: LINE, add: LINES}
    {after: LINE, add: LINES}
    {remove: LINE}

A line stands for itself and for what is indented deeper below it; where several begin so, the
outermost is meant. With `under`, a text or a line is looked for below that key alone. `times`
adds the lines so often, with # counting up from 0. What is added can be marked: «» around the
place of a finding, ⟦⟧ around another place. A pair of texts of any size is put in one's place.
"""

import re
from pathlib import Path
from typing import Any, TypeAlias

Edit: TypeAlias = dict[str, Any] | tuple[str, str]

_MARKS = re.compile("[«»⟦⟧]")
_KEYS = {"under", "replace", "with", "mark", "instead", "before", "after", "remove", "add", "times"}


class EditError(ValueError):
    """The text to be changed is not there, or more than once."""


def unmarked(text: str) -> str:
    return _MARKS.sub("", text)


def change(file: Path, *edits: Edit) -> None:
    """Change a file where it lies. Raises EditError if an edit does not apply."""
    file.write_text(edited(file.read_text(encoding="utf-8"), *edits), encoding="utf-8")


def edited(text: str, *edits: Edit) -> str:
    """Change a text, one edit after the other. Raises EditError if one does not apply."""
    for edit in edits:
        text = _edited(text, edit)
    return text


def _edited(text: str, edit: Edit) -> str:
    if isinstance(edit, tuple):
        old, new = edit
        _once(old, [text.count("\n", 0, at.start()) for at in re.finditer(re.escape(old), text)])
        return text.replace(old, new)
    if unknown := edit.keys() - _KEYS:
        raise EditError(f"an edit has no `{min(unknown)}`")
    lines = text.split("\n")
    within = range(len(lines))
    if "under" in edit:
        within = _entry(lines, within, f"{edit['under']}:")
    match edit:
        case {"replace": old, "with": new}:
            _replace(lines, within, old, new)
        case {"mark": new}:
            _replace(lines, within, unmarked(new), new)
        case {"instead": first, "add": added}:
            entry = _entry(lines, within, first)
            lines[entry.start : entry.stop] = _added(lines[entry.start], added, edit)
        case {"before": first, "add": added}:
            entry = _entry(lines, within, first)
            lines[entry.start : entry.start] = _added(lines[entry.start], added, edit)
        case {"after": first, "add": added}:
            entry = _entry(lines, within, first)
            lines[entry.stop : entry.stop] = _added(lines[entry.start], added, edit)
        case {"remove": first}:
            entry = _entry(lines, within, first)
            del lines[entry.start : entry.stop]
        case _:
            raise EditError(f"no edit has {', '.join(f'`{key}`' for key in edit)} alone")
    return "\n".join(lines)


def repeated(text: str, times: int) -> list[str]:
    return [text.replace("#", str(number)) for number in range(times)]


def _replace(lines: list[str], within: range, old: str, new: str) -> None:
    at = _once(old, [at for at in within for _ in range(lines[at].count(old))])
    lines[at] = lines[at].replace(old, new)


def _entry(lines: list[str], within: range, first: str) -> range:
    """Find the line that begins with `first`, and what is indented deeper below it."""
    begins = [at for at in within if unmarked(lines[at]).lstrip(" ").startswith(first)]
    outermost = min((len(_indent(lines[at])) for at in begins), default=0)
    start = _once(first, [at for at in begins if len(_indent(lines[at])) == outermost])
    below = range(start + 1, len(lines))
    return range(
        start, next((at for at in below if len(_indent(lines[at])) <= outermost), len(lines))
    )


def _once(text: str, found: list[int]) -> int:
    if len(found) != 1:
        where = f", in the lines {', '.join(str(at + 1) for at in found)}" if found else ""
        raise EditError(f"`{text}` must be there once, and is there {len(found)} times{where}")
    return found[0]


def _added(like: str, added: str, edit: dict[str, Any]) -> list[str]:
    text = "\n".join(repeated(added.rstrip("\n"), edit["times"])) if "times" in edit else added
    return [f"{_indent(like)}{line}" for line in text.rstrip("\n").split("\n")]


def _indent(line: str) -> str:
    return line[: len(line) - len(line.lstrip(" "))]
