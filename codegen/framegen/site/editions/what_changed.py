"""What changed from version to version: the author's words, and what was worked out beside them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from framewire.command.console import visible
from framewire.frame.pluralize import pluralize

from framegen.comparison.explained import is_documentation
from framegen.comparison.report.titles import fate_of
from framegen.comparison.report.verdict import AXES, STANDING_WORDS, standing
from framegen.comparison.report.view import rule_of
from framegen.comparison.report.words import between, call_of, effect_text, hex_of
from framegen.language.version import Version
from framegen.site.spec_listing import nearest_anchor

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from framegen.comparison.changes.change import Change
    from framegen.comparison.edition import Edition
    from framegen.comparison.effect import Effect
    from framegen.comparison.report.verdict import Verdict
    from framegen.comparison.report.view import Section, View
    from framegen.language.spec import Release
    from framegen.site.editions.reference_editions import ReferenceEditions

# As many lines of one list; `framegen diff` shows all.
_MOST = 100


@dataclass(frozen=True, slots=True)
class NamedLink:
    """A name, and the page that it leads to, below the root of the site; "" where it has none."""

    name: str
    path: str


@dataclass(frozen=True, slots=True)
class ChangeLine:
    """What became of one thing, where that stands in the spec, and the rule that tells of it.

    The reason and the advice of a rule are given once in a version.
    """

    text: str
    spec: str
    rule: NamedLink
    why: str = ""
    do: str = ""


@dataclass(frozen=True, slots=True)
class EffectLine:
    """What users notice: how it counts, on which axis, between whom, with a frame as proof."""

    standing: str
    word: str
    axis: str
    between: str
    text: str
    hex: str
    call: str
    accepted: str


@dataclass(frozen=True, slots=True)
class ChangeSection:
    """What became of one message, or of several alike; those of all messages have no names."""

    names: Sequence[NamedLink]
    fate: str
    changes: Sequence[ChangeLine]
    effects: Sequence[EffectLine]


@dataclass(frozen=True, slots=True)
class VerdictLine:
    """How much breaks on an axis, between two ends."""

    axis: str
    between: str
    text: str
    breaks: bool


@dataclass(frozen=True)
class VersionChanges:
    """One version: what its author says of it, and what was worked out."""

    editions: ReferenceEditions
    version: str
    entry: Release | None
    edition: Edition | None
    rules: Mapping[str, str]

    @cached_property
    def view(self) -> View | None:
        """What was worked out; None where there is nothing to compare it with."""
        return None if self.edition is None else self.editions.versions.changes(self.edition)

    @property
    def waits(self) -> bool:
        """Whether it has yet to be released."""
        return self.edition is not None and self.editions.versions.waits(self.edition)

    @property
    def anchor(self) -> str:
        """What its heading is called in addresses."""
        return "unreleased" if self.waits and self.entry is None else f"v{self.version}"

    @property
    def path(self) -> str:
        """The start of its reference, below the root of the site; "" where it is not kept."""
        return "" if self.edition is None else f"{self.editions.root(self.edition)}index.html"

    @property
    def since(self) -> str:
        """The version that it is compared with, if any."""
        return "" if self.view is None else self.view.old.version

    @cached_property
    def verdicts(self) -> list[VerdictLine]:
        """The verdicts; an axis on which nobody notices anything has one."""
        if self.view is None:
            return []
        found: list[VerdictLine] = []
        for axis in AXES:
            verdicts = [each for each in self.view.verdicts if each.axis == axis]
            if any(each.effects for each in verdicts):
                found += map(_verdict, verdicts)
            else:
                found.append(VerdictLine(axis, "", "works as before", breaks=False))
        return found

    @property
    def broken(self) -> list[str]:
        """The axes on which anything breaks, be it on purpose."""
        verdicts = [] if self.view is None else self.view.verdicts
        return [*dict.fromkeys(each.axis for each in verdicts if each.breaks)]

    @property
    def upgrade(self) -> str:
        """Which end is upgraded first; "" where that does not matter."""
        return "" if self.view is None else self.view.order

    @cached_property
    def sections(self) -> list[ChangeSection]:
        """What users notice, message by message."""
        if self.view is None:
            return []
        told: set[str] = set()
        return [self._section(self.view, group, told) for group in self.view.groups]

    @property
    def unnoticed(self) -> list[ChangeLine]:
        """The changes of facts that nobody notices."""
        return [] if self.view is None else self._lines(self.view, self.view.tried_in_vain)

    @property
    def documentation(self) -> list[ChangeLine]:
        """The changes of words, sources and examples."""
        return [] if self.view is None else self._lines(self.view, self.view.documentation)

    @cached_property
    def addresses(self) -> dict[str, str]:
        """The page of each message that is named, below the root of the site."""
        if self.edition is None:
            return {}
        editions = [self.edition] if self.view is None else [self.view.old, self.edition]
        return {
            name: f"{self.editions.root(each)}{path}"
            for each in editions
            for name, path in self.editions.views[each].addresses.items()
        }

    def _lines(self, view: View, changes: Sequence[Change]) -> list[ChangeLine]:
        found = [self._change(view, each) for each in changes[:_MOST]]
        if len(changes) > _MOST:
            more = f"and {pluralize(len(changes) - _MOST, 'change')} more"
            found.append(ChangeLine(more, "", NamedLink("", "")))
        return found

    def _section(self, view: View, group: Sequence[Section], told: set[str]) -> ChangeSection:
        first = group[0]
        names = [NamedLink(each.title, self._page(view, each.title)) for each in group]
        fate = fate_of(view, first.title) if len(group) == 1 and first.title else ""
        changes = [self._change(view, each, told) for each in first.changes]
        return ChangeSection(
            names if first.title else [], fate, changes, [*_effects(first.effects, first.title)]
        )

    def _page(self, view: View, name: str) -> str:
        """Return the page of a message; of one that is gone, that in the edition before."""
        edition = view.new if name in view.new.spec.messages else view.old
        address = self.editions.views[edition].addresses.get(name)
        return "" if address is None else f"{self.editions.root(edition)}{address}"

    def _change(self, view: View, change: Change, told: set[str] | None = None) -> ChangeLine:
        edition = view.old if change.new is None else view.new
        anchor = nearest_anchor(edition.compiled.tree, change.path)
        spec = f"{self.editions.root(edition)}spec.html{f'#{anchor}' if anchor else ''}"
        rule = rule_of(change)
        link = NamedLink(change.rule, self.rules.get(change.rule, ""))
        if rule is None or told is None or rule.id in told or is_documentation(change):
            return ChangeLine(visible(change.text), spec, link)
        told.add(rule.id)
        return ChangeLine(visible(change.text), spec, link, rule.why, rule.do)


def what_changed(
    editions: ReferenceEditions, edition: Edition, rules: Mapping[str, str]
) -> list[VersionChanges]:
    """Return every version that an edition knows of, the newest first.

    Those of its history whose text was not kept have its words alone. `rules` are the pages about
    kinds of changes, by their rule.
    """
    versions = editions.versions
    shown = versions.editions[versions.editions.index(edition) :]
    entries = {each.version: each for each in edition.spec.history}
    # Where changes wait for their release, the history tells of the release alone.
    last = {each.version: each for each in reversed(shown)} | {
        each.version: each for each in versions.older if each in shown
    }
    found = [
        VersionChanges(
            editions,
            each.version,
            entries.get(each.version) if last[each.version] is each else None,
            each,
            rules,
        )
        for each in shown
    ]
    found += [
        VersionChanges(editions, version, entry, None, rules)
        for version, entry in entries.items()
        if version not in last
    ]
    return sorted(found, key=_age)


def _age(version: VersionChanges) -> tuple[bool, tuple[int, ...]]:
    """Return what is the less the newer a version is; what is not released comes first."""
    number = Version.parse_or_none(version.version) or Version(0)
    parts = (number.major, number.minor, number.patch, *number.stage)
    return not version.waits, tuple(-part for part in parts)


def _verdict(verdict: Verdict) -> VerdictLine:
    ends = "" if verdict.ends is None else str(verdict.ends)
    return VerdictLine(verdict.axis, ends, str(verdict), verdict.breaks)


def _effects(effects: Sequence[Effect], title: str) -> Iterator[EffectLine]:
    """Yield the effects; a frame that one before has shown is not repeated."""
    frames: set[bytes] = set()
    for effect in effects[:_MOST]:
        witness = effect.witness
        shown = witness is not None and witness.data not in frames
        if witness is not None:
            frames.add(witness.data)
        yield EffectLine(
            standing(effect),
            STANDING_WORDS[standing(effect)],
            effect.axis,
            between(effect).replace("->", "→"),
            effect_text(effect, title),
            hex_of(witness.data) if witness is not None and shown else "",
            call_of(witness) if witness is not None and shown else "",
            visible(effect.accepted),
        )
