"""The targets of a project: those that its pyproject.toml names, or else all there are."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

from framewire.command.console import visible

from framegen.reading.findings import did_you_mean
from framegen.reading.yamltree import Unusable
from framegen.targets import table

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable
    from pathlib import Path

    from framegen.targets.target import Target

FILE = "pyproject.toml"
_KEY = f"`targets` under [tool.framegen] of {FILE}"


def chosen_targets(root: Path) -> tuple[Target, ...]:
    """Return the targets of a project. Raises Unusable where its file names others, or none."""
    file = root / FILE
    try:
        text = file.read_text(encoding="utf-8")
    except (OSError, UnicodeError):
        return table.TARGETS
    if "tool.framegen" not in text:
        return table.TARGETS
    try:
        names = _names(tomllib.loads(text))
    except tomllib.TOMLDecodeError as error:
        raise Unusable(f"{visible(str(file))} is not TOML: {error}", hint="correct it") from None
    return table.TARGETS if names is None else targets_named(names, _KEY)


def targets_named(names: Iterable[str], where: str) -> tuple[Target, ...]:
    """Return targets in the order of the table. Raises Unusable for a name of none, or no name."""
    chosen = {named_target(name, table.TARGETS, where).name for name in names}
    if not chosen:
        every = ", ".join(target.name for target in table.TARGETS)
        raise Unusable(f"{where} names no target", hint=f"name some of {every}")
    return tuple(target for target in table.TARGETS if target.name in chosen)


def named_target(name: str, among: Collection[Target], where: str = "") -> Target:
    """Find a target by its name. Raises Unusable."""
    targets = {target.name: target for target in among}
    if name in targets:
        return targets[name]
    if name in {target.name for target in table.TARGETS}:
        hint = f"it is not among {_KEY}: add it there"
        raise Unusable(f"this project has no target {name!r}", hint=hint)
    told = f"{where}: " if where else ""
    raise Unusable(f"{told}there is no target {visible(name)!r}", hint=did_you_mean(name, targets))


def _names(data: dict[str, Any]) -> list[str] | None:
    """Return the names of targets in the data of a file; None where it has none."""
    own = data.get("tool", {}).get("framegen", {})
    names = own.get("targets") if isinstance(own, dict) else own
    if names is None:
        return None
    if not isinstance(names, list) or not all(isinstance(each, str) for each in names):
        raise Unusable(f"{_KEY} is no list of names", hint='write it as targets = ["python"]')
    return names
