"""An audit: recordings held against a spec, and all that follows from it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from framegen.audit.conversation import Conversations
from framegen.audit.coverage import Coverage
from framegen.audit.evidence import evidence
from framegen.audit.misfits import Misfits
from framegen.audit.settled import questions, raised
from framegen.audit.sighting import Reader

if TYPE_CHECKING:
    from collections.abc import Sequence

    from framegen.audit.evidence import Evidence
    from framegen.audit.misfits import Misfit
    from framegen.audit.recording import Recording
    from framegen.audit.settled import Question, Raised
    from framegen.language.values import Direction
    from framegen.model.model import Model


@dataclass(frozen=True)
class Audit:
    """What recordings say of a spec. `tolerated` is how many bytes of noise are no finding."""

    model: Model
    recordings: Sequence[Recording]
    coverage: Coverage
    conversations: Conversations
    misfits: list[Misfit]
    tolerated: int
    malformed: int

    @property
    def size(self) -> int:
        """How many bytes the recordings hold."""
        return sum(recording.size for recording in self.recordings)

    @property
    def seen(self) -> int:
        """How many messages they hold, those that may be of either end among them."""
        covered = self.coverage.messages.values()
        return sum(each.seen for each in covered) + self.unsure

    @property
    def unsure(self) -> int:
        """How many of them may be messages of either end."""
        return self.coverage.unsure

    @property
    def noise(self) -> int:
        """How many bytes are noise."""
        return sum(each.size for each in self.misfits if each.kind == "noise")

    @property
    def fits(self) -> bool:
        """Whether all fits, but for noise that is tolerated."""
        others = any(each.kind != "noise" for each in self.misfits)
        return not others and self.noise <= self.tolerated

    @property
    def backward(self) -> list[str]:
        """The places where times run backwards."""
        return [
            f"{stretch.place} of {recording.name}"
            for recording in self.recordings
            for stretch in recording.stretches
            if stretch.backward
        ]

    @cached_property
    def evidence(self) -> Evidence:
        """What the spec is known from now."""
        return evidence(self.model)

    @cached_property
    def questions(self) -> list[Question]:
        """The open questions of the spec of which the recordings show something."""
        return questions(self.model, self.coverage, self.conversations.answered)

    @cached_property
    def raised(self) -> list[Raised]:
        """The messages of which they show facts that no hardware has shown before."""
        devices = {recording.device for recording in self.recordings}
        device = devices.pop() if len(devices) == 1 else ""
        return raised(self.model, self.coverage, self.conversations.answered, device)


def audit(
    model: Model, recordings: Sequence[Recording], ways: Sequence[Direction], tolerated: int = 0
) -> Audit:
    """Hold recordings against a spec; `ways` are the directions of bytes without a sender."""
    reader = Reader(model, ways)
    coverage = Coverage(model, evidence(model).facts)
    conversations, misfits = Conversations(model), Misfits(reader)
    malformed = 0
    for recording in recordings:
        for sighting in reader.read(recording):
            if sighting.stretch.malformed:
                malformed += 1
                continue
            coverage.add(sighting)
            conversations.add(sighting)
            misfits.add(sighting)
        conversations.end()
    return Audit(model, recordings, coverage, conversations, misfits.sorted, tolerated, malformed)
