"""The report on an audit, in sections: each a title, a sentence, a table and a block of YAML."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framewire.frame.pluralize import pluralize

from framegen.audit.words import described, documented, shown
from framegen.language.values import to_hex

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from framegen.audit.audit import Audit
    from framegen.audit.conversation import Conversation
    from framegen.audit.coverage import MessageCoverage
    from framegen.audit.evidence import Fact
    from framegen.audit.misfits import Misfit

# More bytes of a frame, more values and more examples than these are not shown.
_BYTES, _VALUES, _EXAMPLES = 16, 5, 8
_NOUNS = {"unknown command": "frame", "undocumented value": "frame", "noise": "piece"}


@dataclass(frozen=True)
class Section:
    """A section: what it is about, a sentence or more, a table with a head, and YAML."""

    title: str
    text: str = ""
    head: tuple[str, ...] = ()
    rows: Sequence[tuple[str, ...]] = ()
    yaml: str = ""


def summary(audit: Audit) -> str:
    """Say in a line what the recordings hold."""
    seen = sum(bool(each.seen) for each in audit.coverage.messages.values())
    parts = [
        pluralize(audit.size, "byte"),
        pluralize(audit.seen, "message"),
        f"{seen} of {pluralize(len(audit.coverage.messages), 'kind')} seen",
    ]
    for kind, words in (("unknown command", "of unknown commands"), ("undocumented value", "")):
        times = sum(each.times for each in audit.misfits if each.kind == kind)
        if times:
            what = words or "with undocumented values"
            parts.append(f"{pluralize(times, 'frame')} {what}")
    parts.append(f"{pluralize(audit.noise, 'byte')} of noise")
    return ", ".join(parts)


def verdict(audit: Audit) -> str:
    """Say whether all fits."""
    protocol = audit.model.spec.protocol
    what = f"{protocol.name} {protocol.version}"
    if not audit.fits:
        return f"not all of it fits {what}"
    tolerated = f", but for {pluralize(audit.noise, 'byte')} of noise that is tolerated"
    return f"all of it fits {what}{tolerated if audit.noise else ''}"


def sections(audit: Audit) -> Iterator[Section]:
    """Yield the sections that have something to say."""
    if audit.misfits:
        head = ("what", "how often", "where", "bytes", "why it does not fit")
        yield Section("What does not fit", "", head, [_misfit(each) for each in audit.misfits])
    yield from _messages(audit)
    remarks = [*_remarks(audit)]
    if remarks:
        yield Section("Worth a look", "", ("what", "seen"), remarks)
    yield from _conversations(audit)
    yield from _examples(audit)
    if audit.questions:
        asked = pluralize(len(audit.questions), "open question")
        of = len(audit.model.spec.unknowns)
        yield Section(
            "Open questions",
            f"It speaks of {asked} of {of}. Whether that settles one is yours to say.",
            ("about", "the question", "what was seen"),
            [(each.about, each.unknown.what, "; ".join(each.seen)) for each in audit.questions],
        )
    yield from _raised(audit)


def _misfit(misfit: Misfit) -> tuple[str, ...]:
    place, data = misfit.examples[0]
    often = pluralize(misfit.times, _NOUNS[misfit.kind])
    size = f", {pluralize(misfit.size, 'byte')}" if misfit.kind == "noise" else ""
    return f"{misfit.kind}: {misfit.what}", f"{often}{size}", place, hex_of(data), misfit.why


def hex_of(data: bytes) -> str:
    """Write the first bytes of a frame as hex."""
    return to_hex(data[:_BYTES]) + (" ..." if len(data) > _BYTES else "")


def _messages(audit: Audit) -> Iterator[Section]:
    covered = [each for each in audit.coverage.messages.values() if each.seen]
    never = [each.name for each in audit.coverage.messages.values() if not each.seen]
    text = f"Never seen: {', '.join(never)}." if never else "Every message was seen."
    rows = [row for each in covered for row in _message(each)]
    yield Section("Coverage", text, ("seen", "what", "values", "documented") if rows else (), rows)


def _message(covered: MessageCoverage) -> Iterator[tuple[str, ...]]:
    yield str(covered.seen), covered.name, f"from {covered.layout.direction.sender}", ""
    for path, values in covered.values.items():
        what = described(values) if values.seen else "never there"
        yield str(values.seen), f"  {path}", what, documented(values)


def _remarks(audit: Audit) -> Iterator[tuple[str, str]]:
    for name, covered in audit.coverage.messages.items():
        for path, values in covered.values.items():
            what = f"{name}.{path}"
            if values.unnamed:
                yield f"{what} has no name for", _counted(values.unnamed)
            if values.unknown_bits:
                bits = [str(bit) for bit in range(64) if values.unknown_bits >> bit & 1]
                yield f"{what} has no name for", f"bit {', '.join(bits)}"
            if values.beyond_limits:
                yield f"{what} is beyond its usual limits", _counted(values.beyond_limits)
    unsure = audit.unsure
    if unsure:
        several = " or ".join(each.name for each in audit.coverage.messages.values() if each.unsure)
        yield "may be of either end; --direction says whose", f"{unsure} times {several}"
    if audit.malformed:
        yield "was malformed on purpose", pluralize(audit.malformed, "time")
    if audit.backward:
        often = pluralize(len(audit.backward), "time")
        yield "times run backwards", f"{often}, first at {audit.backward[0]}"


def _counted(counts: dict[int, int]) -> str:
    values = sorted(counts, key=lambda each: (-counts[each], each))
    text = ", ".join(
        f"{shown(each)} ({pluralize(counts[each], 'time')})" for each in values[:_VALUES]
    )
    return f"{text} and {len(values) - _VALUES} more" if len(values) > _VALUES else text


def _conversations(audit: Audit) -> Iterator[Section]:
    if not audit.conversations.has_both_ends:
        return
    found = [
        each
        for each in audit.conversations.by_request.values()
        if each.requests or each.unsolicited
    ]
    head = ("request", "sent", "answered", "no reply", "no request", "seconds to the reply")
    yield Section("Requests and replies", "", head, [_conversation(each) for each in found])


def _conversation(found: Conversation) -> tuple[str, ...]:
    answered = str(found.answered)
    for number, how in ((found.refused, "refused"), (found.failed, "failed")):
        answered += f", {number} {how}" if number else ""
    times = ""
    if found.median is not None:
        low, high = min(found.seconds), max(found.seconds)
        times = f"{low:.4f}"
        if f"{high:.4f}" != times:
            times += f" to {high:.4f}, half of them within {found.median:.4f}"
    return (
        found.name,
        str(found.requests),
        answered,
        _placed(found.unanswered, found.unanswered_at),
        _placed(found.unsolicited, found.unsolicited_at),
        times,
    )


def _placed(number: int, places: list[str]) -> str:
    return f"{number} ({places[0]})" if places else str(number)


def _examples(audit: Audit) -> Iterator[Section]:
    all_of = sum(len(each.examples) for each in audit.coverage.messages.values())
    unseen = [
        (name, example.title)
        for name, each in audit.coverage.messages.items()
        for example in each.unseen_examples
    ]
    if not unseen:
        return
    text = f"{len(unseen)} of {pluralize(all_of, 'example')} were never seen as they stand."
    if len(unseen) > _EXAMPLES:
        text += f" The first {_EXAMPLES}:"
    yield Section("Examples", text, ("message", "example"), unseen[:_EXAMPLES])


def _raised(audit: Audit) -> Iterator[Section]:
    facts = sum(len(each.facts) for each in audit.raised)
    if not facts:
        return
    known = audit.evidence
    text = (
        f"If a real board was on the line, it shows {pluralize(facts, 'fact')} that the spec has "
        f"from elsewhere: {known.seen + facts} of {len(known.facts)} would then be seen on "
        f"hardware, and not {known.seen}."
    )
    if not any(each.kind == "observation" for each in audit.model.spec.sources.values()):
        text += " The spec has no source of the kind `observation` yet: add one."
    rows = [(each.message.name, ", ".join(map(_name, each.facts))) for each in audit.raised]
    lines: list[str] = []
    for each in audit.raised:
        lines += [f"  {each.message.name}:", "    examples:", each.yaml]
    yield Section("Evidence from hardware", text, ("message", "facts"), rows, "\n".join(lines))


def _name(fact: Fact) -> str:
    return "the message" if fact.what == "message" else fact.name
