"""A trial of a program: asks every question, compares, and shrinks the first difference."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from framegen.conformance.comparison import Difference, compare, unsupported
from framegen.conformance.shrinking import shrink

if TYPE_CHECKING:
    from collections.abc import Iterable

    from framegen.conformance.language import Question
    from framegen.conformance.program import Program
    from framegen.model.model import Model

# A program is started anew so often, and no more; one that hangs costs its time each time.
_CRASHES, _HANGS = 30, 3
# A difference is shrunk in so many tries.
_TRIES, _HANGING_TRIES = 2_000, 40


@dataclass(frozen=True, slots=True)
class Smallest:
    """The first difference, as small as it could be made, and in how many tries.

    `alone` is false where a program that was asked nothing before answers as the reference does;
    `behind` is then the question that was asked before it.
    `last_words` is what the program printed on its error stream when it was asked this alone.
    """

    difference: Difference
    tries: int
    alone: bool
    behind: str = ""
    last_words: str = ""


@dataclass(slots=True)
class Trial:
    """The questions and how they were answered; `stopped` says why not all were asked.

    `last_words` is what the program had printed on its error stream when it first gave no answer.
    """

    questions: int = 0
    agreed: int = 0
    unsupported: Counter[str] = field(default_factory=Counter)
    differences: list[Difference] = field(default_factory=list)
    smallest: Smallest | None = None
    stopped: str = ""
    last_words: str = ""

    @property
    def conforms(self) -> bool:
        """Whether everything was answered as by the reference, except what is unsupported."""
        return bool(self.agreed) and not self.differences


def hold(model: Model, program: Program, questions: Iterable[tuple[str, Question]]) -> Trial:
    """Ask every question, each with a title. Raises Unusable if the program cannot be started."""
    trial = Trial()
    failures: Counter[bool] = Counter()
    before = behind = ""
    for title, question in questions:
        reply = program.ask(question.line)
        trial.questions += 1
        before, previous = question.line, before
        if unsupported(reply):
            trial.unsupported[question.verb] += 1
            continue
        difference = compare(model, title, question, reply)
        if difference is None:
            trial.agreed += 1
            continue
        if not trial.differences:
            behind = previous
        trial.differences.append(difference)
        if reply.failure:
            trial.last_words = trial.last_words or program.last_words
            failures[reply.hangs] += 1
            trial.stopped = _enough(failures, answered=trial.questions > len(trial.differences))
            if trial.stopped:
                break
    if trial.differences:
        trial.smallest = _smallest(model, program, trial.differences[0], behind)
    return trial


def _enough(failures: Counter[bool], *, answered: bool) -> str:
    """Return why no more is asked of a program that fails too often; empty to go on."""
    if not answered:
        return "it never answered"
    if failures[True] >= _HANGS:
        return f"it did not answer in time {_HANGS} times"
    return f"it ended {_CRASHES} times" if failures[False] >= _CRASHES else ""


def _smallest(model: Model, program: Program, first: Difference, behind: str) -> Smallest:
    """Shrink the first difference; keep it as it is where the program alone shows none."""

    def ask(question: Question, timeout: float | None = None) -> Difference | None:
        reply = program.ask(question.line, timeout)
        return None if unsupported(reply) else compare(model, first.title, question, reply)

    program.close()
    if ask(first.question) is None:
        return Smallest(first, 0, alone=False, behind=behind)
    # What hangs is given less time; whether it does is asked again in the end.
    timeout, most = (program.timeout / 10, _HANGING_TRIES) if first.hangs else (None, _TRIES)

    def differs(smaller: Question) -> bool:
        found = ask(smaller, timeout)
        return found is not None and found.kind == first.kind

    question, tries = shrink(model, first.question, differs, most)
    program.close()
    found = ask(question)
    program.close()
    return Smallest(found or first, tries, alone=True, last_words=program.last_words)
