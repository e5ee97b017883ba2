"""A release: the text of a spec with its next version, and the history that says what changed."""

from __future__ import annotations

from copy import deepcopy
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from framegen.comparison.accepted import places
from framegen.comparison.due import due, next_version, version_finding
from framegen.comparison.entry import sentences
from framegen.comparison.removed import reservations
from framegen.comparison.report.words import between
from framegen.compile import compile_spec
from framegen.language.version import NoVersion, Version
from framegen.reading.source import Source
from framegen.reading.yamledit import NoPlace, YamlEditor
from framegen.reading.yamltext import block
from framegen.reading.yamltree import Unusable, dotted

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence

    from framegen.comparison.comparison import Comparison
    from framegen.comparison.effect import Effect
    from framegen.compile import Compiled
    from framegen.reading.yamltree import KeyPath

# As many breaks are named.
_NAMED = 10
_RENAMED = "; what only has another name says so by `was: OldName`"


@dataclass(frozen=True, slots=True)
class Release:
    """A version that can be released, the text of its spec, and what was written into that."""

    version: str
    text: str
    breaks: dict[str, str]
    reserved: list[dict[str, Any]]


def release(
    new: Compiled,
    comparison: Comparison | None,
    taken: Collection[str],
    version: str | None = None,
    accept: str | None = None,
) -> Release:
    """Write the next version of a spec; without a comparison, the first one.

    `version` is used instead of the one that is due, and `accept` is the reason for all breaks
    that the spec does not accept itself. `taken` are the versions that were released. Raises
    Unusable where that can be no release.
    """
    own = new.spec.protocol.version
    wanted = _version(own, comparison, taken, version)
    breaks = _accepted([] if comparison is None else comparison.effects, accept)
    reserved = [] if comparison is None else [*reservations(comparison, accept)]
    changes = ["The first release."] if comparison is None else sentences(comparison)
    edits = _Edits(new)
    edits.set_version(wanted, rename=own not in taken)
    edits.tell(wanted, changes, breaks)
    edits.reserve(reserved)
    return Release(wanted, edits.text(), breaks, reserved)


def _version(
    own: str, comparison: Comparison | None, taken: Collection[str], version: str | None
) -> str:
    """Return the version to release. Raises Unusable where it is none, or too low."""
    if version is not None:
        try:
            Version.parse(version)
        except NoVersion as error:
            raise Unusable(str(error), hint=error.hint) from None
        if version in taken:
            raise Unusable(f"{version} is released already", hint="take a higher version")
    if comparison is None:
        return own if version is None else version
    old = comparison.old.version
    bump = due(comparison.effects, comparison.changes)
    if bump is None:
        raise Unusable(f"nothing changed since {old}", hint="there is nothing to release")
    try:
        lowest = next_version(old, bump)
    except NoVersion as error:
        raise Unusable(
            f"the last version: {error}", hint="name the next one by --version"
        ) from None
    if version is None and own in taken:
        candidate = Version.parse(own)
        return lowest if candidate.is_final else str(max(candidate.final, Version.parse(lowest)))
    wanted = own if version is None else version
    found = version_finding(old, wanted, bump)
    if found is not None:
        raise Unusable(found, hint=f"use --version {lowest}, or a higher one")
    return wanted


def _accepted(effects: Sequence[Effect], reason: str | None) -> dict[str, str]:
    """Return the breaks to accept. Raises Unusable where there is no reason."""
    left = [each for each in effects if each.breaks and not each.accepted]
    if not left:
        return {}
    first: dict[str, Effect] = {}
    for effect in left:
        for place in places(effect):
            first.setdefault(dotted(place), effect)
    paths = [*first]
    if reason is None or not reason.strip():
        shown = [f"  {path}: {_said(first[path])}" for path in paths[:_NAMED]]
        more = [f"  and {len(paths) - _NAMED} more"] if len(paths) > _NAMED else []
        what = "nothing says why this breaks" if reason is None else "the reason is empty"
        raise Unusable(
            "\n".join([f"{what}:", *shown, *more]),
            hint='give one reason for all, --accept "No board has it.", or one for each in the '
            "`breaks` of the new version in `history`"
            + (_RENAMED if any(map(_may_be_renamed, left)) else ""),
        )
    return {
        path: reason.strip()
        for path in paths
        if not any(path.startswith((f"{other}.", f"{other}[")) for other in paths)
    }


def _may_be_renamed(effect: Effect) -> bool:
    """Tell whether `was` may settle an effect: not where something is reserved no more."""
    return not effect.certain and effect.new is not None


def _said(effect: Effect) -> str:
    """Return what an effect says, without the name that its path ends with, and of which ends."""
    text = effect.text.removeprefix(f"{effect.path[-1]}: " if effect.path else "")
    return f"{between(effect)}: {text}" if effect.editions else text


class _Edits:
    """The edits of one spec, in its text and in its values, which must agree in the end."""

    def __init__(self, compiled: Compiled) -> None:
        self._compiled = compiled
        self._data: dict[str, Any] = deepcopy(compiled.tree.data)
        self._editor = YamlEditor(compiled.source, compiled.tree)
        self._own = compiled.spec.protocol.version
        self._entry: int | None = None
        self._possible = True

    def set_version(self, version: str, *, rename: bool) -> None:
        """Set the version; with `rename`, wherever the spec names its own, which has no release."""
        history = [each["version"] for each in self._data.get("history", ())]
        if rename and self._own in history:
            self._entry = history.index(self._own)
        if version == self._own:
            return
        self._replace(("protocol", "version"), version)
        if self._entry is not None:
            self._replace(("history", self._entry, "version"), version)
        for name, message in self._data["messages"].items() if rename else ():
            if message.get("since") == self._own:
                self._replace(("messages", name, "since"), version)

    def tell(self, version: str, changes: list[str], breaks: dict[str, str]) -> None:
        """Add the version to the history; where it is there, add what that does not say."""
        if self._entry is None:
            entry: dict[str, Any] = {"version": version, "changes": changes}
            if breaks:
                entry["breaks"] = breaks
            self._data["history"] = [entry, *self._data.get("history", ())]
            self._put("put_first", ("history",), [entry])
            return
        here = ("history", self._entry)
        entry = self._data["history"][self._entry]
        if not entry["changes"]:
            self._put("put_first", (*here, "changes"), changes)
            entry["changes"] = changes
        if breaks and entry.get("breaks"):
            self._put("put_in", (*here, "breaks"), breaks)
        elif breaks:
            self._put("put_behind", (*here, "version"), {"breaks": breaks})
        if breaks:
            entry["breaks"] = {**breaks, **entry.get("breaks", {})}

    def reserve(self, reserved: list[dict[str, Any]]) -> None:
        """Add what must not be used again."""
        if reserved:
            self._put("put_first", ("reserved",), reserved)
            self._data["reserved"] = [*reserved, *self._data.get("reserved", ())]

    def text(self) -> str:
        """Return the text, which was read again. Raises Unusable where it says something else."""
        source = self._compiled.source
        text = self._editor.text() if self._possible else ""
        try:
            done = compile_spec(Source(source.name, text, source.path))
        except Unusable:
            raise self._refusal() from None
        if done.tree.data != self._data:
            raise self._refusal()
        if done.findings:
            finding = done.findings[0].render(done.source)
            raise Unusable(f"the release would have a finding:\n{finding}", hint="nothing was done")
        return text

    def _replace(self, path: KeyPath, value: str) -> None:
        around: Any = self._data
        for step in path[:-1]:
            around = around[step]
        around[path[-1]] = value
        self._put("replace", path, value)

    def _put(self, how: str, path: KeyPath, what: object) -> None:
        try:
            getattr(self._editor, how)(path, what)
        except NoPlace:
            self._possible = False

    def _refusal(self) -> Unusable:
        entry = self._data["history"][self._entry or 0]
        shown = "\n".join(block([{**entry}]))
        return Unusable(
            f"{self._compiled.source.name} is laid out in a way that cannot be edited here",
            hint=f"nothing was written; write it by hand, and release that:\n{shown}",
        )
