"""Rule: the name of a protocol is not taken where it names a package, a command and folders."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.rule import Problem, StructureRule
from framegen.language.package_names import why_taken

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import Spec


def _look(spec: Spec) -> Iterator[Problem]:
    name = spec.protocol.name
    why = why_taken(name)
    if why:
        other = f"{name.removesuffix('_simulator')}_protocol"
        hint = f"choose another name, such as `{other}`"
        yield Problem(("protocol", "name"), f"`{name}` {why}", hint)


RULE = StructureRule(
    id="protocol-name",
    title="The name of a protocol is not taken",
    why="The name of a protocol names its package, its command, its folders and its files, beside "
    "those of others: under another name in one place, nobody would find them. Any other name "
    "that a language has taken is changed by its target.",
    bad="protocol: {name: print, ...}",
    good="protocol: {name: print_protocol, ...}",
    look=_look,
)
