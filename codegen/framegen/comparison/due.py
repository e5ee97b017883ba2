"""Which bump of the version is due, and whether a version has it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, TypeAlias

from framegen.language.version import NoVersion, Version

if TYPE_CHECKING:
    from collections.abc import Iterable

    from framegen.comparison.changes.change import Change
    from framegen.comparison.effect import Effect
    from framegen.reading.yamltree import KeyPath

Bump: TypeAlias = Literal["major", "minor", "patch"]

_WHAT: dict[Bump, str] = {
    "major": "something breaks",
    "minor": "something is new or deprecated",
    "patch": "something is worded otherwise",
}


def due(effects: Iterable[Effect], changes: Iterable[Change]) -> Bump | None:
    """Return the bump that is due, None where nothing changed.

    What breaks anybody is major, accepted and uncertain or not; what anybody notices besides, such
    as a new message or the warning for one that is deprecated, is minor. A change without any
    effect is documentation, and a patch; the version itself and what the history says of it are
    none.
    """
    breaks = [effect.breaks for effect in effects]
    found = [change for change in changes if not tells_versions(change.path)]
    if any(breaks):
        return "major"
    if breaks or any(warns(change) for change in found):
        return "minor"
    return "patch" if found else None


def warns(change: Change) -> bool:
    """Tell whether users of a library are warned, though nothing became of their programs."""
    return change.rule == "message-deprecated"


def tells_versions(path: KeyPath) -> bool:
    """Tell whether a place of a spec is about its versions, and not about the protocol."""
    return path[:2] == ("protocol", "version") or path[:1] == ("history",)


def next_version(old: str, bump: Bump) -> str:
    """Return the lowest version that a bump leads to. Raises NoVersion.

    While the major number is 0, the minor one says that something breaks. What comes next after an
    alpha, a beta or a release candidate is the version that it leads up to.
    """
    return str(_next(Version.parse(old), bump))


def version_finding(old: str, new: str, bump: Bump | None) -> str | None:
    """Return what is wrong with a new version where a bump is due; None where it is right."""
    try:
        was, now = Version.parse(old), Version.parse(new)
    except NoVersion as error:
        return f"{error}: {error.hint}"
    if now < was:
        return f"the version went back from {was} to {now}"
    if bump is None:
        return None
    wanted, what = _next(was, bump), f"{_WHAT[bump]} since {was}"
    if now == was:
        return f"{what}, and the version is still that: {wanted} is due"
    # An alpha of a version promises what that version will.
    if was.is_final and now.final < wanted:
        return f"{what}, so the version {now} is too low: {wanted} is due"
    return None


def _next(old: Version, bump: Bump) -> Version:
    if not old.is_final:
        return old.final
    if bump == "patch":
        return Version(old.major, old.minor, old.patch + 1)
    if bump == "minor" or old.major == 0:
        return Version(old.major, old.minor + 1)
    return Version(old.major + 1)
