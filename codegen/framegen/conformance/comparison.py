"""Comparison of an answer with that of the reference."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import zip_longest
from typing import TYPE_CHECKING

from framegen.conformance.fractions import with_plain_fractions
from framegen.conformance.language import QUIET, UNSUPPORTED, Encode, Stream, answer, joined

if TYPE_CHECKING:
    from collections.abc import Sequence

    from framegen.conformance.language import Question
    from framegen.conformance.program import Reply
    from framegen.model.model import Model

# How a line of an answer begins.
_KNOWN = {"message", "refused", "frame", "unknown", "noise", QUIET, UNSUPPORTED}


@dataclass(frozen=True)
class Difference:
    """A question whose answer differs from the reference's; both answers are joined.

    `at` is the first line that differs. `failure` says why the answer never ended, and `hangs` that
    it ran out of time.
    """

    title: str
    question: Question
    expected: tuple[str, ...]
    answered: tuple[str, ...]
    at: int
    failure: str = ""
    hangs: bool = False

    @property
    def about(self) -> str:
        """What the reference says there, without bytes: `message ServoMove`, `noise bad-header`."""
        if self.failure:
            return "(no answer)"
        if isinstance(self.question, Encode):
            return self.question.message.name
        words = self.expected[self.at].split() if self.at < len(self.expected) else []
        if not words:
            return "nothing more"
        return " ".join(words[:2] if words[0] in ("message", "noise", "refused") else words[:1])

    @property
    def kind(self) -> tuple[object, ...]:
        """The kind of error, without bytes: no answer, or how the differing lines begin."""
        if self.failure:
            return ("hangs" if self.hangs else "ends",)
        if self.of_messages:
            return ("messages",)
        lines = (self.expected, self.answered)
        parted = [line for each in lines for line in each[self.at : self.at + 1]]
        return tuple(line.partition(" ")[0] for line in parted)

    @property
    def of_messages(self) -> bool:
        """Whether messages are lost, invented or read otherwise; else only noise differs."""
        ours, theirs = (
            [line for line in lines if line.startswith(("message ", "frame "))]
            for lines in (self.expected, self.answered)
        )
        return ours != theirs

    @property
    def rubbish(self) -> str:
        """The first line of the answer that is not in the line language."""
        return next((line for line in self.answered if line.partition(" ")[0] not in _KNOWN), "")


def unsupported(reply: Reply) -> bool:
    """Tell whether a program answers that it does not support the question."""
    return not reply.failure and reply.lines == (UNSUPPORTED,)


def compare(model: Model, title: str, question: Question, reply: Reply) -> Difference | None:
    """Find where an answer differs from the reference's; None where it does not."""
    expected = joined(answer(model, question))
    answered = [with_plain_fractions(model, line) for line in joined(reply.lines)]
    if not reply.failure and _agree(question, expected, answered):
        return None
    pairs = enumerate(zip_longest(expected, answered))
    at = next((at for at, (one, other) in pairs if one != other), len(expected))
    said = tuple(expected), tuple(answered)
    return Difference(title, question, *said, at, reply.failure, reply.hangs)


def _agree(question: Question, expected: Sequence[str], answered: Sequence[str]) -> bool:
    if expected == answered:
        return True
    if not isinstance(question, Stream):
        return False
    # What comes behind the last quiet may be held for longer, but for messages.
    decided = max((at for at, line in enumerate(expected, 1) if _is_due(line)), default=0)
    last = len(answered) - 1
    return (
        len(answered) <= len(expected)
        and expected[: max(decided, last)] == answered[: max(decided, last)]
        and (last < decided or _begins(expected[last], answered[last]))
    )


def _is_due(line: str) -> bool:
    return line == QUIET or line.startswith("message ")


def _begins(expected: str, answered: str) -> bool:
    return expected == answered or (answered.startswith("noise ") and expected.startswith(answered))
