"""The report for pull requests and change logs, with the entry for the history of the spec."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.report.verdict import AXES, standing
from framegen.comparison.report.words import between, effect_text, hex_of
from framegen.pluralize import pluralize
from framegen.reading.yamltext import block, scalar
from framegen.reading.yamltree import dotted
from framegen.targets.docs.escape import code, markdown, verbatim

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.effect import Effect
    from framegen.comparison.report.view import View

_WORDS = {"breaks": "breaks", "uncertain": "uncertain", "accepted": "on purpose"}
# Rows of a table, and items of a list: a comment on a pull request has room for 65 536 characters.
_MOST = 100
# Up to so many rows, long frames are shown as a whole.
_FEW, _BYTES, _BYTES_OF_MANY = 30, 300, 40


def render(view: View) -> str:
    """Return the verdicts, what breaks with its frames, and what to write into the history."""
    blocks = [_header(view)]
    if view.nothing:
        return "\n\n".join([*blocks, "Nothing changed that a spec says."]) + "\n"
    blocks.append("\n".join(_verdicts(view)))
    blocks += _upgrade(view)
    breaking = [effect for effect in view.effects if effect.breaks]
    if breaking:
        blocks += ["### What breaks", "\n".join(_breaks(breaking))]
    if view.sentences:
        blocks += ["### What changed", "\n".join(_changes(view))]
        blocks += ["For `history` in the spec:", _entry(view)]
    return "\n\n".join(blocks) + "\n"


def _header(view: View) -> str:
    old, new = view.old, view.new
    name = markdown(new.spec.protocol.name)
    return (
        f"## {name} {markdown(view.next_version)}\n\n"
        f"Compared with {markdown(old.version)}: {code(old.label)} → {code(new.label)}"
    )


def _verdicts(view: View) -> Iterator[str]:
    yield "| | between | verdict |"
    yield "|---|---|---|"
    for axis in AXES:
        verdicts = [each for each in view.verdicts if each.axis == axis]
        if not any(each.effects for each in verdicts):
            yield f"| {axis} | | works as before |"
            continue
        for each in verdicts:
            ends = "" if each.ends is None else markdown(each.ends)
            yield f"| {axis} | {ends} | {markdown(each)} |"


def _upgrade(view: View) -> Iterator[str]:
    if view.order:
        yield f"Upgrade {markdown(view.order)}."
    if view.version_finding:
        yield f"**Version**: {markdown(view.version_finding)}."


def _breaks(effects: list[Effect]) -> Iterator[str]:
    yield "| | where | what | between | frame |"
    yield "|---|---|---|---|---|"
    most = _BYTES if len(effects) <= _FEW else _BYTES_OF_MANY
    for effect in effects[:_MOST]:
        frame = "" if effect.witness is None else code(hex_of(effect.witness.data, most))
        what = _prose(effect_text(effect, str(effect.path[1]) if effect.path[1:] else ""))
        if effect.accepted:
            what += f" (accepted: {_prose(effect.accepted)})"
        kind = f"{_WORDS[standing(effect)]}: {effect.axis}"
        where = code(dotted(effect.path))
        ends = markdown(between(effect).replace("->", "→"))
        yield f"| {kind} | {where} | {what} | {ends} | {frame} |"
    if len(effects) > _MOST:
        yield f"\nAnd {pluralize(len(effects) - _MOST, 'effect')} more."


def _changes(view: View) -> Iterator[str]:
    for sentence in view.sentences[:_MOST]:
        yield f"- {_prose(sentence)}"
    if len(view.sentences) > _MOST:
        yield f"- and {pluralize(len(view.sentences) - _MOST, 'change')} more"


def _prose(text: str) -> str:
    """Escape a sentence, in which what stands between two backticks is code."""
    parts = text.split("`")
    if not len(parts) % 2:
        return markdown(text)
    found = [code(part) if at % 2 else _inner(part) for at, part in enumerate(parts)]
    return "".join(found).strip()


def _inner(text: str) -> str:
    """Escape a part of a line, and keep the blanks around it."""
    return f"{' ' * text[:1].isspace()}{markdown(text)}{' ' * text[-1:].isspace()}"


def _entry(view: View) -> str:
    """Return the entry in YAML; what breaks and is not accepted yet waits there for its reason."""
    entry = {"version": view.next_version, "changes": view.sentences}
    lines = [f"  {line}" for line in block([entry])]
    places = [dotted(each.path) for each in view.effects if each.breaks and not each.accepted]
    if places:
        lines += ["    # What is meant to break, each with its reason:", "    # breaks:"]
        lines += [f"    #   {scalar(place)}: REASON" for place in dict.fromkeys(places)]
    text = "\n".join(lines)
    return f"```yaml\n{verbatim(text)}\n```"
