"""The report on a program: as text, as JSON, or as a badge."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING, Any

from framewire.command.console import visible
from framewire.frame.pluralize import pluralize

from framegen.conformance.badge import badge
from framegen.conformance.language import Decode, Encode, Stream
from framegen.conformance.strip import strip

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from framegen.conformance.comparison import Difference
    from framegen.conformance.trial import Smallest, Trial
    from framegen.language.spec import Protocol
    from framegen.model.model import Model

# So many kinds of differences are shown.
_KINDS = 12
# The two sides of a difference.
_COLOURS = {"reference": "green", "program": "red"}
# And so many lines of an error stream.
_LAST_LINES = 8


def as_text(model: Model, trial: Trial, command: Sequence[str]) -> Iterator[str]:
    """Report to a person, line by line."""
    if trial.smallest is not None:
        yield from _first(model, trial.smallest)
        yield ""
        yield from _first_failure(trial)
        yield from _kinds(trial.differences)
        yield ""
    if trial.stopped:
        yield f"stopped after {pluralize(trial.questions, 'question')}: {trial.stopped}"
    yield f"{_short(visible(' '.join(command)))}: {_verdict(model.spec.protocol, trial)}"
    if trial.unsupported:
        verbs = ", ".join(f"{count} {verb}" for verb, count in sorted(trial.unsupported.items()))
        yield f"  not supported, and not counted as wrong: {verbs}"


def colour_of(line: str) -> str:
    """Return the colour of a line of the text on a terminal; empty for none."""
    return _COLOURS.get(line[: line.find("  ", 2)].strip(), "") if line.startswith("  ") else ""


def _verdict(protocol: Protocol, trial: Trial) -> str:
    what = f"{protocol.name} {protocol.version}"
    if trial.conforms:
        return f"conforms to {what}: {pluralize(trial.agreed, 'answer')} as the reference's"
    if not trial.differences:
        return f"supports nothing of {what}: {pluralize(trial.questions, 'question')} not supported"
    answers = pluralize(trial.questions - trial.unsupported.total(), "answer")
    return f"differs from {what} in {len(trial.differences)} of {answers}"


def _first(model: Model, smallest: Smallest) -> Iterator[str]:
    found = smallest.difference
    yield f"the first difference: {found.title}"
    if not smallest.alone:
        yield "  Asked this alone, anew, it answers rightly: it keeps something between questions."
        yield f"  the question before: {_short(smallest.behind)}"
    elif smallest.tries:
        yield f"  shrunk in {pluralize(smallest.tries, 'try', 'tries')}"
    yield f"  question: {_short(found.question.line)}"
    yield ""
    yield from strip(model, found)
    if found.rubbish:
        yield ""
        yield f"  `{_short(found.rubbish)}` is no line of an answer"
    yield from _last_words(smallest.last_words)


def _first_failure(trial: Trial) -> Iterator[str]:
    """Report the first failure to answer, where it was not the first difference."""
    failed = next((found for found in trial.differences if found.failure), None)
    if failed is not None and failed is not trial.differences[0]:
        yield f"the first that it did not answer: {failed.title}"
        yield f"  question: {_short(failed.question.line)}"
        yield f"  {failed.failure}"
        yield from _last_words(trial.last_words)
        yield ""


def _last_words(text: str) -> Iterator[str]:
    lines = text.splitlines()
    if lines:
        yield ""
        yield "  its error stream ended:"
        yield from (f"    {line}" for line in lines[-_LAST_LINES:])


def _short(text: str) -> str:
    return text if len(text) <= 200 else f"{text[:197]}..."


def _kinds(differences: Sequence[Difference]) -> Iterator[str]:
    wrong = sum(found.of_messages or bool(found.failure) for found in differences)
    yield (
        f"{pluralize(len(differences), 'answer')} differ, {wrong or 'none'} of them in a message; "
        "by what the reference says there:"
    )
    kinds = Counter((found.question.verb, found.about) for found in differences)
    for (verb, about), count in kinds.most_common(_KINDS):
        yield f"  {count:>5}  {verb:<6}  {about}"
    if len(kinds) > _KINDS:
        yield f"  and {pluralize(len(kinds) - _KINDS, 'more kind')}"


def as_json(model: Model, trial: Trial, command: Sequence[str], seed: int | None) -> dict[str, Any]:
    """Report as values that JSON has."""
    protocol, smallest = model.spec.protocol, trial.smallest
    return {
        "protocol": protocol.name,
        "version": protocol.version,
        "program": list(command),
        "conforms": trial.conforms,
        "questions": trial.questions,
        "agreed": trial.agreed,
        "differed": len(trial.differences),
        "unsupported": {kind.verb: trial.unsupported[kind.verb] for kind in _QUESTIONS},
        "seed": seed,
        "stopped": trial.stopped,
        "smallest": None
        if smallest is None
        else {
            **_difference_json(smallest.difference),
            "tries": smallest.tries,
            "alone": smallest.alone,
            "behind": smallest.behind,
            "stderr": smallest.last_words,
        },
        "differences": [_difference_json(found) for found in trial.differences],
    }


_QUESTIONS = (Decode, Encode, Stream)


def _difference_json(found: Difference) -> dict[str, Any]:
    return {
        "title": found.title,
        "verb": found.question.verb,
        "about": found.about,
        "question": found.question.line,
        "expected": list(found.expected),
        "answered": list(found.answered),
        "failure": found.failure,
    }


def as_badge(model: Model, trial: Trial) -> str:
    """Draw the badge."""
    protocol = model.spec.protocol
    label = f"{protocol.name} {protocol.version}"
    if not trial.conforms:
        answers = trial.questions - trial.unsupported.total()
        return badge(label, f"{trial.agreed} of {answers}", "bad")
    if trial.unsupported:
        without = ", ".join(f"{count} {verb}" for verb, count in sorted(trial.unsupported.items()))
        return badge(label, f"conforms, {without} not supported", "fair")
    return badge(label, "conforms", "good")
