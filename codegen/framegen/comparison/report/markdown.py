"""The report for pull requests and change logs, with the entry for the history of the spec."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framewire.frame.pluralize import pluralize

from framegen.comparison.accepted import places
from framegen.comparison.report.verdict import AXES, STANDING_WORDS, standing
from framegen.comparison.report.words import between, effect_text, hex_of
from framegen.reading.yamltext import block, scalar
from framegen.reading.yamltree import dotted
from framegen.targets.docs.escape import code, markdown, verbatim

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from framegen.comparison.effect import Effect
    from framegen.comparison.report.view import View

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
    remedies = view.remedies(breaking)
    if remedies:
        blocks += ["### What to do", "\n".join(_items(remedies, "remedy", "remedies"))]
    if view.sentences:
        blocks += ["### What changed", "\n".join(_items(view.sentences, "change"))]
        blocks += _for_history(view)
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
        kind = f"{STANDING_WORDS[standing(effect)]}: {effect.axis}"
        where = code(dotted(effect.path))
        ends = markdown(between(effect).replace("->", "→"))
        yield f"| {kind} | {where} | {what} | {ends} | {frame} |"
    if len(effects) > _MOST:
        yield f"\nAnd {pluralize(len(effects) - _MOST, 'effect')} more."


def _items(sentences: Sequence[str], noun: str, plural: str = "") -> Iterator[str]:
    for sentence in sentences[:_MOST]:
        yield f"- {_prose(sentence)}"
    if len(sentences) > _MOST:
        yield f"- and {pluralize(len(sentences) - _MOST, noun, plural)} more"


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


def _left(view: View) -> list[str]:
    """Return where something breaks that is not accepted yet."""
    left = [each for each in view.effects if each.breaks and not each.accepted]
    return [*dict.fromkeys(dotted(place) for each in left for place in places(each))]


def _for_history(view: View) -> Iterator[str]:
    """Yield the entry in YAML; what breaks and is not accepted yet waits there for its reason.

    Where the history has the version, only that is left to write.
    """
    left = [f"#   {scalar(place)}: REASON" for place in _left(view)]
    if any(each.version == view.next_version for each in view.new.spec.history):
        if left:
            yield f"For `breaks` of {markdown(view.next_version)} in `history`:"
            yield _yaml(["# What is meant to break, each with its reason:", *left])
        return
    lines = [*block([{"version": view.next_version, "changes": view.sentences}])]
    if left:
        about = ["# What is meant to break, each with its reason:", "# breaks:"]
        lines += [f"  {line}" for line in (*about, *left)]
    yield "For `history` in the spec:"
    yield _yaml([f"  {line}" for line in lines])


def _yaml(lines: Sequence[str]) -> str:
    text = "\n".join(lines)
    return f"```yaml\n{verbatim(text)}\n```"
