"""What a report shows of a comparison, whatever its format."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from framewire.command.console import visible

from framegen.checks.breaks import known_messages, named_message
from framegen.comparison.accepted import accepted_breaks
from framegen.comparison.changes import CHANGE_RULES
from framegen.comparison.due import due, next_version, tells_versions, version_finding
from framegen.comparison.edges import MOST
from framegen.comparison.entry import sentences
from framegen.comparison.explained import explain, is_documentation
from framegen.comparison.report.ends import all_ends, ends_of, upgrade_order
from framegen.comparison.report.titles import shortened_list
from framegen.comparison.report.verdict import AXES, STANDINGS, Verdict, standing
from framegen.language.version import NoVersion
from framegen.reading.findings import did_you_mean

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from framegen.comparison.accepted import Accepted
    from framegen.comparison.changes.change import Change, ChangeRule
    from framegen.comparison.comparison import Comparison
    from framegen.comparison.due import Bump
    from framegen.comparison.edition import Edition
    from framegen.comparison.effect import Effect
    from framegen.comparison.pair import Pair
    from framegen.comparison.report.ends import Ends
    from framegen.reading.yamltree import KeyPath

# What a rule says where there is nothing to do.
NOTHING = "Nothing."


@dataclass(frozen=True)
class Section:
    """What became of one message, or of what all messages share, which has no name."""

    title: str
    changes: Sequence[Change]
    effects: Sequence[Effect]


@dataclass(frozen=True, eq=False)
class View:
    """A comparison, in the order in which it is told."""

    comparison: Comparison

    @property
    def pair(self) -> Pair:
        """Who is who in the two editions."""
        return self.comparison.pair

    @property
    def old(self) -> Edition:
        """The older edition."""
        return self.comparison.old

    @property
    def new(self) -> Edition:
        """The newer edition."""
        return self.comparison.new

    @cached_property
    def effects(self) -> list[Effect]:
        """All effects, the worst first; otherwise in the order of the comparison."""
        return sorted(self.comparison.effects, key=lambda effect: STANDINGS.index(standing(effect)))

    @cached_property
    def verdicts(self) -> list[Verdict]:
        """A verdict for each axis and each two ends, and one for programs."""
        found: list[Verdict] = []
        for axis in AXES:
            effects = [effect for effect in self.effects if effect.axis == axis]
            by_ends: dict[Ends, list[Effect]] = {each: [] for each in all_ends(self.pair)}
            rest: list[Effect] = []
            for effect in effects:
                ends = None if axis == "programs" else ends_of(self.pair, effect)
                (rest if ends is None else by_ends.setdefault(ends, [])).append(effect)
            if axis != "programs":
                found += [Verdict(axis, ends, each) for ends, each in by_ends.items()]
            if rest or axis == "programs":
                found.append(Verdict(axis, None, rest))
        return found

    @property
    def order(self) -> str:
        """Which end is upgraded first; "" where nothing breaks between them for certain."""
        broken = {each.ends for each in self.verdicts if each.ends is not None and each.breaks}
        return upgrade_order(broken) if broken else ""

    @cached_property
    def sections(self) -> list[Section]:
        """What is shared by all, then the messages of the new edition, and those that are gone."""
        titles = ["", *self.new.spec.messages]
        titles += [name for name in self.old.spec.messages if name in self.pair.messages.removed]
        changes: dict[str, list[Change]] = {title: [] for title in titles}
        effects: dict[str, list[Effect]] = {title: [] for title in titles}
        for change in self.comparison.changes:
            if change in self.explaining:
                changes[self._title(change.old, change.new)].append(change)
        for effect in self.effects:
            effects[self._title(effect.old, effect.new)].append(effect)
        every = (Section(title, changes[title], effects[title]) for title in titles)
        return [each for each in every if each.changes or each.effects]

    @cached_property
    def explaining(self) -> frozenset[Change]:
        """The changes that are behind an effect."""
        changes = self.comparison.changes
        return frozenset(each for effect in self.effects for each in explain(effect, changes))

    @property
    def without_effect(self) -> list[Change]:
        """The changes that nobody notices who does not read the documentation."""
        return [
            each
            for each in self.comparison.changes
            if each not in self.explaining and not tells_versions(each.path)
        ]

    @property
    def documentation(self) -> list[Change]:
        """The changes of words alone."""
        return [each for each in self.without_effect if _is_words(each)]

    @property
    def tried_in_vain(self) -> list[Change]:
        """The changes of facts that no effect was found of, and of what is reserved."""
        return [each for each in self.without_effect if not _is_words(each)]

    @property
    def nothing(self) -> bool:
        """Whether the editions say the same."""
        return not self.effects and not self.comparison.changes

    @property
    def capped(self) -> list[str]:
        """The messages of which not all frames were tried out that there would have been."""
        tried = self.comparison.trials
        return [*dict.fromkeys(each.message.name for each in tried if not each.all_tried)]

    @property
    def most_tried(self) -> int:
        """How many frames of a message are tried out at most."""
        return MOST

    @property
    def idle(self) -> list[Accepted]:
        """What the history accepts, and nothing breaks."""
        paths = [(each.old, each.new) for each in self.effects]
        paths += [(each.old, each.new) for each in self.comparison.changes]
        lines = accepted_breaks(self.pair)
        return [each for each in lines if not any(each.covers(*both) for both in paths)]

    def meant(self, line: Accepted) -> str:
        """Return which message was meant where neither edition has the one that is named."""
        name = named_message(line.path)
        known = {**known_messages(self.new.spec), **known_messages(self.old.spec)}
        if name is None or name in known:
            return ""
        hint = did_you_mean(name, known, otherwise=" ").strip()
        return f"; there is no message `{visible(name)}`" + (f", {hint}" if hint else "")

    @cached_property
    def bump(self) -> Bump | None:
        """The part of the version that is to be raised."""
        return due(self.comparison.effects, self.comparison.changes)

    @cached_property
    def version_finding(self) -> str | None:
        """What is wrong with the version of the new edition."""
        return version_finding(self.old.version, self.new.version, self.bump)

    @property
    def next_version(self) -> str:
        """The version of what comes next: that of the new edition, or the one that is due."""
        if self.version_finding is None or self.bump is None:
            return self.new.version
        try:
            return next_version(self.old.version, self.bump)
        except NoVersion:
            return self.new.version

    @property
    def sentences(self) -> list[str]:
        """The changes as the history of the spec tells them; its examples follow them."""
        return sentences(self.comparison, examples=False)

    def remedies(self, effects: Iterable[Effect]) -> list[str]:
        """Return what to do about what breaks and is not accepted: of each kind of change once."""
        told: dict[str, None] = {}
        found: dict[ChangeRule, dict[str, None]] = {}
        for effect in effects:
            if effect.breaks and not effect.accepted:
                if effect.remedy:
                    told[effect.remedy] = None
                    continue
                for change in explain(effect, self.comparison.changes):
                    rule = rule_of(change)
                    if rule is not None and rule.do != NOTHING:
                        found.setdefault(rule, {})[change.text] = None
        of_rules = (f"{shortened_list([*texts])}. {rule.do}" for rule, texts in found.items())
        return [*told, *of_rules]

    def places(self, change: Change) -> str:
        """Return where a change is, in both editions: `old.yaml:9:5 -> spec/new.yaml:9:5`."""
        old = "" if change.old is None else self.old.place(change.old)
        new = "" if change.new is None else self.new.place(change.new)
        return " -> ".join(filter(None, (old, new)))

    def place(self, change: Change) -> str:
        """Return where a change is in the new edition, or in the old where it is gone."""
        if change.new is None:
            return self.old.place(change.path)
        return self.new.place(change.new)

    @property
    def groups(self) -> list[list[Section]]:
        """The sections; together those to which the same happened for the same reason elsewhere."""
        found: dict[object, list[Section]] = {}
        for section in self.sections:
            same = {
                (each.axis, each.outcome, each.ends, standing(each)) for each in section.effects
            }
            key = section.title if section.changes or not section.title else frozenset(same)
            found.setdefault(key, []).append(section)
        return [*found.values()]

    def _title(self, old: KeyPath | None, new: KeyPath | None) -> str:
        """Return the message that a path belongs to; "" for none."""
        if new is not None and new[:1] == ("messages",) and len(new) > 1:
            return str(new[1])
        if old is not None and old[:1] == ("messages",) and len(old) > 1:
            return self.pair.messages.to_new.get(str(old[1]), str(old[1]))
        return ""


def _is_words(change: Change) -> bool:
    return is_documentation(change) and not change.rule.startswith("reserved-")


def rule_of(change: Change) -> ChangeRule | None:
    """Return the rule that found a change."""
    return next((rule for rule in CHANGE_RULES if rule.id == change.rule), None)
