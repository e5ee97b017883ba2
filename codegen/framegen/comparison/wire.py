"""The wire: what each end makes of the frames of another that has the other edition.

Every message of either edition is encoded with the reference codec of its own, at the edges of
both, and read with that of the other.
"""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass, field
from itertools import islice
from typing import TYPE_CHECKING, Any

from framegen.comparison.edges import MOST, Edges
from framegen.comparison.effect import OUTCOMES, Effect, Witness
from framegen.comparison.meaning import differences, translated
from framegen.comparison.pair import shape
from framegen.model.codec import Unencodable, encode, values_of
from framegen.model.stream import ReferenceDecoder
from framegen.model.verdict import weigh_whole

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

    from framegen.comparison.effect import Outcome, Which
    from framegen.comparison.meaning import Difference
    from framegen.comparison.pair import Pair
    from framegen.language.values import Direction
    from framegen.model.layout import MessageLayout

# So many frames of all messages together are tried out at most where two values are varied.
_MOST_OF_ALL = 100_000
_OTHER: dict[Which, Which] = {"old": "new", "new": "old"}


@dataclass
class Trials:
    """What became of the frames of one message that one edition sends and the other reads.

    `counts` says how many had which outcome. `breaking` and `adding` hold the worst frame that
    breaks something, and the worst that only says what is new to its receiver. `all_tried` is
    False where there would have been more to try.
    """

    sender: Which
    message: MessageLayout
    way: Direction
    counts: dict[Outcome, int] = field(default_factory=dict)
    breaking: Witness | None = None
    adding: Witness | None = None
    all_tried: bool = True

    def add(self, witness: Witness, *, breaks: bool) -> None:
        """Count a frame, and keep it if it is the worst so far."""
        self.counts[witness.outcome] = self.counts.get(witness.outcome, 0) + 1
        if witness.outcome == "same":
            return
        worst = self.breaking if breaks else self.adding
        if worst is None or _rank(witness) > _rank(worst):
            if breaks:
                self.breaking = witness
            else:
                self.adding = witness


def try_out(pair: Pair) -> list[Trials]:
    """Try out every message of either edition on an end that has the other one."""
    both: tuple[Which, Which] = ("old", "new")
    return [trial.run() for sender in both for trial in trials_of(pair, sender)]


def wire_effects(pair: Pair, trials: list[Trials]) -> Iterator[Effect]:
    """Yield an effect for each message of each edition that is not read alike."""
    for each in trials:
        for witness, breaks in ((each.breaking, True), (each.adding, False)):
            if witness is not None:
                yield _effect(pair, each, witness, breaks=breaks)


def _effect(pair: Pair, trials: Trials, witness: Witness, *, breaks: bool) -> Effect:
    here = ("messages", trials.message.name)
    pairing = pair.messages if trials.sender == "old" else pair.messages.flipped
    name = pairing.to_new.get(trials.message.name)
    there = None if name is None else ("messages", name)
    old, new = (here, there) if trials.sender == "old" else (there, here)
    way, receiver = trials.way, _OTHER[trials.sender]
    ends = f"{trials.sender} {way.sender}, {receiver} {way.receiver}"
    text = f"{trials.message.name}: {witness.reading}"
    certain = witness.outcome != "uncertain"
    return Effect("wire", witness.outcome, old, new, text, ends, breaks, certain, witness)


def trials_of(pair: Pair, sender: Which) -> Iterator[Trial]:
    """Yield a trial for each message that one edition sends."""
    alike = _same_lines(pair)
    messages = pair.edition(sender).model.messages.values()
    both = len(pair.old.model.messages) + len(pair.new.model.messages)
    for message in messages:
        yield Trial(pair, sender, message, alike, min(MOST, _MOST_OF_ALL // both))


def _same_lines(pair: Pair) -> frozenset[str]:
    """Return the old names of messages whose frames look the same in both editions."""
    found: set[str] = set()
    for name, other in pair.messages.to_new.items():
        old, new = pair.old.model.messages[name], pair.new.model.messages[other]
        if [*map(shape, old.slots)] == [*map(shape, new.slots)] and old.ids == new.ids:
            found.add(name)
    return frozenset(found)


class Trial:
    """One message that one edition sends, and the other edition, which reads it."""

    def __init__(
        self,
        pair: Pair,
        sender: Which,
        message: MessageLayout,
        alike: frozenset[str],
        most: int = MOST,
    ) -> None:
        self.most = most
        self.cut_short = False
        self.pair = pair
        self.sender = sender
        self.message = message
        self.theirs = pair.edition(_OTHER[sender]).model
        self.pairing = pair.messages if sender == "old" else pair.messages.flipped
        turn = pair.way_in_new if sender == "old" else pair.way_in_old
        self.way = turn(message.direction)
        name = self.pairing.to_new.get(message.name)
        self.other = None if name is None else self.theirs.messages[name]
        old_name = message.name if sender == "old" else name
        self.pairs = old_name not in alike
        # What a client sends, a program decided to send; a device sends what it will.
        self.chosen = message.direction.sender == pair.edition(sender).model.roles.client

    def run(self) -> Trials:
        """Try out the message at its edges."""
        return self.found_in(self.frames())

    def found_in(self, frames: Iterable[tuple[Witness, bool]]) -> Trials:
        """Return what became of these frames of the message."""
        found = Trials(self.sender, self.message, self.message.direction)
        for witness, breaks in frames:
            found.add(witness, breaks=breaks)
        found.all_tried = not self.cut_short
        if self.other is not None and found.counts.keys() == {"refused"}:
            # Nothing at all of what both ends know is understood.
            found.breaking, found.adding = found.breaking or found.adding, None
        return found

    def frames(self) -> Iterator[tuple[Witness, bool]]:
        """Yield what becomes of each frame that is tried, and whether that breaks anything."""
        names = {} if self.other is None else self._fields(self.other).to_new
        edges = Edges(self.message, self.other, names)
        outcomes: set[Outcome] = set()
        tried = 0
        for witness, breaks in self._become(islice(edges.single(), MOST)):
            outcomes.add(witness.outcome)
            tried += 1
            yield witness, breaks
        if not self.pairs or "misread" in outcomes or outcomes == {"refused"}:
            # There is nothing worse, or nothing but chance lets a frame through.
            return
        left = max(0, self.most - tried)
        pairs = edges.pairs()
        yield from self._become(islice(pairs, left))
        self.cut_short = next(pairs, None) is not None

    def _become(self, several: Iterator[dict[str, Any]]) -> Iterator[tuple[Witness, bool]]:
        for values in several:
            # A tolerated edition may have messages that none of its frames can carry.
            with suppress(Unencodable, OverflowError):
                yield self.of(values)

    def of(self, values: Mapping[str, Any]) -> tuple[Witness, bool]:
        """Return what becomes of a frame with these values, and whether that breaks anything."""
        data = encode(self.message, values)

        def witness(outcome: Outcome, reading: str, *read_as: str) -> Witness:
            name = self.message.name
            return Witness(self.sender, data, name, values, outcome, reading, read_as)

        if self.way is None:
            return witness("refused", "there is no such end"), self._was_understood(values)
        if not self.theirs.sent(self.way):
            return witness("refused", "no message goes this way"), self._was_understood(values)
        verdict = weigh_whole(self.theirs, [self.way], data)
        if verdict.message is None:
            inside = self._read_inside(self.way, data)
            if inside:
                rest = ", with noise beside it" if inside == self._other_name else ""
                return witness("misread", f"is read as {', '.join(inside)}{rest}", *inside), True
            return witness("refused", f"is refused, {verdict.refusal}"), self._was_understood(
                values
            )
        read = values_of(verdict.message, data)
        if self.other is None or verdict.message is not self.other:
            other = verdict.message.name
            return witness("misread", f"is read as {other}", other), True
        outcome, reading, breaks = self._compared(self.other, values, read)
        return witness(outcome, reading), breaks

    def _compared(
        self, other: MessageLayout, values: Mapping[str, Any], read: Mapping[str, Any]
    ) -> tuple[Outcome, str, bool]:
        """Return the worst that differs between what is sent and what is read, in words too."""
        worst: tuple[Outcome, str] = ("same", "is read alike")
        if self.message.name in self.pairing.guessed:
            worst = ("uncertain", f"is read as {other.name}, which may be another message")
        breaks = worst[0] == "uncertain"
        for each in differences(self._fields(other), self.message, other, values, read):
            if OUTCOMES.index(each.outcome) > OUTCOMES.index(worst[0]):
                worst = (each.outcome, each.text)
            breaks |= self._breaks(each)
        return *worst, breaks

    def _breaks(self, difference: Difference) -> bool:
        """Tell whether what is known to one end alone was known before: then it is lost."""
        if difference.known_to is None:
            return True
        knows = self.sender if difference.known_to == "sender" else _OTHER[self.sender]
        return knows == "old"

    def _was_understood(self, values: Mapping[str, Any]) -> bool:
        """Tell whether a refused frame says something that ends understood in the old edition."""
        if self.sender == "old":
            return True
        if self.other is None:
            return False
        if not self.chosen:
            return self._was_asked(self.other, values)
        said = translated(self._fields(self.other), self.message, self.other, values)
        if said is None:
            return False
        try:
            encode(self.other, said)
        except Unencodable:
            return False
        return True

    def _was_asked(self, other: MessageLayout, values: Mapping[str, Any]) -> bool:
        """Tell whether ends of the old edition talk to a device with the address in a frame."""
        ours, theirs = self.message.frame.address, other.frame.address
        return ours is None or theirs is None or theirs.holds(values[ours.name])

    def _read_inside(self, way: Direction, data: bytes) -> list[str]:
        """Return the messages that the other end finds in a frame that it refuses as a whole."""
        events = ReferenceDecoder(self.theirs, [way]).decode(data)
        found = [each.message.name for each in events if each.message is not None]
        return [*dict.fromkeys(found)]

    @property
    def _other_name(self) -> list[str]:
        return [] if self.other is None else [self.other.name]

    def _fields(self, other: MessageLayout) -> Any:
        if self.sender == "old":
            return self.pair.fields(self.message, other)
        return self.pair.fields(other, self.message).flipped


def _rank(witness: Witness) -> tuple[int, int]:
    """Rank witnesses: the worst is kept, and of equals the shortest, which is read best."""
    return OUTCOMES.index(witness.outcome), -len(witness.data)
