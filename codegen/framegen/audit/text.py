"""The report on an audit as text for a terminal, and as Markdown."""

from __future__ import annotations

import re
from textwrap import wrap
from typing import TYPE_CHECKING

from framewire.command.console import visible

from framegen.audit.report import sections, summary, verdict

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from framegen.audit.audit import Audit
    from framegen.audit.report import Section

# The widest row of a table.
_WIDEST = 100
_SPECIAL = re.compile(r"([\\`*_\[\]<>|#&~])")


def as_text(audit: Audit) -> Iterator[str]:
    """Report to a person at a terminal, line by line."""
    names = ", ".join(each.name for each in audit.recordings)
    yield f"{names}: {summary(audit)}"
    for section in sections(audit):
        yield ""
        yield f"{section.title[0].lower()}{section.title[1:]}:"
        if section.text:
            yield from (f"  {line}" for line in wrap(visible(section.text), _WIDEST - 2))
        yield from _columns(section)
        if section.yaml:
            yield ""
            yield "  To be added to the spec:"
            yield ""
            yield from (visible(line) for line in section.yaml.splitlines())
    yield ""
    yield verdict(audit)


def _columns(section: Section) -> Iterator[str]:
    """Yield a table; columns for which it is too wide have lines of their own, below the row."""
    if not section.rows:
        return
    rows = [tuple(visible(cell) for cell in row) for row in (section.head, *section.rows)]
    used = [at for at in range(len(section.head)) if any(row[at] for row in rows[1:])]
    widths = {at: max(len(row[at]) for row in rows) for at in used}
    beside = used[:1]
    for at in used[1:]:
        if sum(widths[each] + 2 for each in [*beside, at]) > _WIDEST:
            break
        beside.append(at)
    below = [at for at in used if at not in beside]
    for row in rows:
        cells = [
            f"{row[at]:>{widths[at]}}" if _is_count(section, at) else f"{row[at]:<{widths[at]}}"
            for at in beside
        ]
        yield f"  {'  '.join(cells)}".rstrip()
        if row is not rows[0]:
            yield from (f"      {row[at]}" for at in below if row[at])


def _is_count(section: Section, at: int) -> bool:
    return section.head[at] in ("seen", "sent") and all(row[at].isdigit() for row in section.rows)


def as_markdown(audit: Audit) -> Iterator[str]:
    """Report as Markdown, for an issue or a pull request, line by line."""
    protocol = audit.model.spec.protocol
    yield f"# Audit of {_escaped(protocol.name)} {_escaped(protocol.version)}"
    yield ""
    yield f"{', '.join(_escaped(each.name) for each in audit.recordings)}: {summary(audit)}."
    said = verdict(audit)
    yield f"**{_escaped(said[0].upper() + said[1:])}.**"
    for section in sections(audit):
        yield ""
        yield f"## {section.title}"
        if section.text:
            yield ""
            yield _escaped(section.text)
        if section.rows:
            yield ""
            yield _row(section.head)
            yield _row(["---"] * len(section.head))
            yield from (_row([_escaped(cell) for cell in row]) for row in section.rows)
        if section.yaml:
            yield ""
            yield "To be added to the spec:"
            yield ""
            fence = "`" * max(3, 1 + _longest_run(section.yaml))
            yield f"{fence}yaml"
            yield from (visible(line) for line in section.yaml.splitlines())
            yield fence


def _row(cells: Sequence[str]) -> str:
    return f"| {' | '.join(cells)} |"


def _escaped(text: str) -> str:
    indent = len(text) - len(text.lstrip(" "))
    return "&nbsp;" * indent + _SPECIAL.sub(r"\\\1", visible(text[indent:]))


def _longest_run(text: str) -> int:
    return max(map(len, re.findall("`+", text)), default=0)
