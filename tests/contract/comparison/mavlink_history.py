"""The verdicts tried on a history that others made: that of MAVLink's common messages.

    python -m tests.contract.comparison.mavlink_history CLONE        each commit that changed them
    python -m tests.contract.comparison.mavlink_history CLONE A B C  these, each with the next

CLONE is the git directory of a clone of mavlink/mavlink. Each edition becomes a spec, and is
compared with the one before it. Beside every verdict stands what MAVLink says itself: the byte of
a definition, CRC_EXTRA, is another one exactly where ends no longer understand each other; and
what a plain look at the two definitions finds.
"""

import json
import resource
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any
from xml.etree import ElementTree as ET

from framegen.comparison.edition import Edition
from framegen.comparison.pair import Pair
from framegen.comparison.wire import Trials, try_out
from framegen.compile import compile_spec
from framegen.reading.source import Source

from tests.contract.comparison.mavlink_definitions import (
    Definitions,
    Message,
    crc_extra,
    definitions,
    in_camel_case,
    spec_of,
)

FOLDER = "message_definitions/v1.0"
FILES = ("minimal.xml", "standard.xml", "common.xml")
WORDS = ("about", "summary")
# Where an edition would have no message, it has this one, which was never removed.
ANCHOR = "HEARTBEAT"


@dataclass(frozen=True)
class Revision:
    """A commit, with the definitions that it has."""

    clone: str
    commit: str
    subject: str

    @cached_property
    def definitions(self) -> Definitions:
        """What common.xml and the files that it includes define."""
        return definitions("common.xml", self._read)

    def _read(self, name: str) -> str:
        return _git(self.clone, "show", f"{self.commit}:{FOLDER}/{name}")


@dataclass
class Step:
    """Two revisions in a row, and how the messages that differ are read across them."""

    old: Revision
    new: Revision
    differ: set[str] = field(default_factory=set)
    trials: list[Trials] = field(default_factory=list)
    seconds: float = 0.0

    def verdicts(self) -> Iterator[tuple[str, str, str]]:
        """Yield a message, what breaks (`old: all refused`) or is new, and the worst reading."""
        for each in self.trials:
            vendor = each.message.message.vendor_name
            for witness, kind in ((each.breaking, ""), (each.adding, "new, ")):
                if witness is not None:
                    every = "all " if each.counts[witness.outcome] == each.tried else ""
                    yield vendor, f"{each.sender}: {kind}{every}{witness.outcome}", witness.reading


def _git(clone: str, *arguments: str) -> str:
    return subprocess.run(
        ["git", "-C", clone, *arguments],  # noqa: S607
        capture_output=True,
        check=True,
        encoding="utf-8",
    ).stdout


def revisions(clone: str, chosen: list[str]) -> Iterator[Revision]:
    """Yield the revisions chosen, or each that changed the messages, the oldest first."""
    paths = [f"{FOLDER}/{name}" for name in FILES]
    which = (
        ["--no-walk=unsorted", *chosen, "--"]
        if chosen
        else ["--first-parent", "--reverse", "HEAD", "--", *paths]
    )
    for line in _git(clone, "log", "--format=%h %cs %s", *which).splitlines():
        commit, _, subject = line.partition(" ")
        yield Revision(clone, commit, subject)


def edition(found: Definitions, names: set[str] | None, label: str) -> Edition:
    """Return the edition with these messages: as a model, though none has an example."""
    compiled = compile_spec(Source(label, json.dumps(spec_of(found, names))))
    if compiled.read is None or compiled.derived is None:
        raise ValueError(f"{label}: {compiled.findings[0].message}")
    return Edition(label, compiled, compiled.read, compiled.derived)


def compared(old: Revision, new: Revision, *, whole: bool = False) -> Step:
    """Compare two revisions: their messages that differ in more than words, or all of them."""
    step = Step(old, new)
    before, after = _without_words(old.definitions), _without_words(new.definitions)
    step.differ = {name for name in {*before, *after} if before.get(name) != after.get(name)}
    if step.differ:
        names = None if whole else {ANCHOR, *step.differ}
        begun = time.process_time()
        pair = Pair(
            edition(old.definitions, names, old.commit), edition(new.definitions, names, new.commit)
        )
        step.trials = try_out(pair)
        step.seconds = time.process_time() - begun
    return step


def _without_words(found: Definitions) -> dict[str, Any]:
    return {each["vendor_name"]: _bare(each) for each in spec_of(found)["messages"].values()}


def _bare(value: Any) -> Any:
    if isinstance(value, dict):
        # The order of fields counts, that of named values does not.
        kept = {key: _bare(each) for key, each in value.items() if key not in WORDS}
        return {**kept, "fields": [*kept["fields"].items()]} if "fields" in kept else kept
    return value


def expected(old: Definitions, new: Definitions) -> Counter[tuple[str, str]]:
    """Return what a plain look at two editions finds, by message and kind of change.

    This knows nothing of frames: it compares the definitions, and CRC_EXTRA.
    """
    found: Counter[tuple[str, str]] = Counter()
    for name in {*old.messages, *new.messages}:
        one, other = (
            each if each is not None and each.is_carried else None
            for each in (old.messages.get(name), new.messages.get(name))
        )
        if one is None:
            found += Counter([(name, "added")] if other is not None else [])
        elif other is None:
            found[name, "removed"] += 1
        elif crc_extra(one) != crc_extra(other):
            found[name, "CRC_EXTRA"] += 1
        elif one.id != other.id:
            found[name, "id"] += 1
        else:
            found += Counter((name, kind) for kind in _meanings(one, other, old, new))
    return found


def _meanings(one: Message, other: Message, old: Definitions, new: Definitions) -> Iterator[str]:
    theirs = {each.name: each for each in other.fields}
    for each in one.fields:
        its = theirs.get(each.name)
        if its is None:
            yield "field renamed"
            continue
        if (each.type, each.count) != (its.type, its.count):
            yield "field retyped"
        if each.unit != its.unit:
            yield "unit" if each.unit and its.unit else "unit documented"
        if each.invalid != its.invalid:
            yield "invalid" if each.invalid and its.invalid else "invalid documented"
        if each.multiplier != its.multiplier:
            yield "multiplier"
        yield from _enums(old.enums.get(each.enum), new.enums.get(its.enum))


def _enums(one: Any, other: Any) -> Iterator[str]:
    before = {} if one is None else {each.name: each.value for each in one.entries}
    after = {} if other is None else {each.name: each.value for each in other.entries}
    if bool(before) != bool(after) or one.name != other.name if one and other else one != other:
        yield "enum given" if not before else "enum taken" if not after else "other enum"
    elif one is not None and one.is_bitmask != other.is_bitmask:
        yield "bitmask"
    for name, value in before.items():
        if name in after and after[name] != value:
            yield "value moved"
        elif name not in after and after:
            yield "value renamed" if value in after.values() else "value removed"
    if before and {*after.values()} - {*before.values()}:
        yield "value added"


def main(clone: str, *chosen: str) -> None:
    """Compare each revision with the next, and print what differs and how often."""
    old: Revision | None = None
    totals: Counter[str] = Counter()
    agreed: Counter[str] = Counter()
    seconds = 0.0
    for new in revisions(clone, [*chosen]):
        totals["editions"] += 1
        try:
            new.definitions  # noqa: B018
        except (ET.ParseError, KeyError, subprocess.CalledProcessError) as error:
            totals["not usable"] += 1
            print(f"# {new.commit} {new.subject}: {error!r}")
            continue
        if old is not None:
            totals["pairs"] += 1
            try:
                step = compared(old, new, whole=bool(chosen))
            except ValueError as error:
                totals["pairs that are no spec"] += 1
                print(f"# {old.commit}..{new.commit} {new.subject}: {error}")
                old = new
                continue
            totals["pairs that differ"] += bool(step.differ)
            totals["messages that differ"] += len(step.differ)
            totals["frames"] += sum(each.tried for each in step.trials)
            seconds += step.seconds
            _print(step, totals, agreed)
        old = new
    for name, number in totals.items():
        print(f"{number:8} {name}")
    for name, number in sorted(agreed.items()):
        print(f"{number:8} {name}")
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss // 1024
    print(f"{seconds:8.1f} seconds of computing, {memory} MiB")


def _print(step: Step, totals: Counter[str], agreed: Counter[str]) -> None:
    looked = expected(step.old.definitions, step.new.definitions)
    kinds: dict[str, list[str]] = {}
    for (name, kind), _ in sorted(looked.items()):
        kinds.setdefault(name, []).append(kind)
    verdicts: dict[str, list[tuple[str, str]]] = {}
    for name, verdict, reading in step.verdicts():
        verdicts.setdefault(name, []).append((verdict, reading))
    if kinds or verdicts:
        print(f"\n{step.old.commit}..{step.new.commit} {step.new.subject} ({step.seconds:.2f} s)")
    for name in sorted({*kinds, *verdicts}):
        kind = ", ".join(kinds.get(name, ["no difference"]))
        found = verdicts.get(name, [])
        worst = ", ".join(verdict for verdict, _ in found) or "same"
        agreed[f"{kind} | {worst}"] += 1
        totals["messages with breaks"] += any(": new" not in verdict for verdict, _ in found)
        print(f"  {name} ({in_camel_case(name)}): {kind} | {worst}")
        for verdict, reading in found:
            print(f"      {verdict}: {reading}")


if __name__ == "__main__":
    main(*sys.argv[1:])
