"""What a guess has decided, held to the spec of the protocol that was recorded."""

from collections.abc import Iterator

from framegen.guess.guess import Guess
from framegen.guess.hidden import HiddenFit
from framegen.model.envelope import Envelope
from framegen.model.model import Model
from framegen.model.slots import Constant

# More bytes than a frame has around its fields.
_SIZE = 40


def wrong(guess: Guess, model: Model) -> list[str]:
    """Return the conclusions that are decided, and right for no envelope of the protocol."""
    return [
        f"{each.about}: {each.says}"
        for each in guess.conclusions
        if each.is_decided
        and not any(_agrees(each.about, guess, model, frame) for frame in model.envelopes.values())
    ]


def _agrees(about: str, guess: Guess, model: Model, frame: Envelope) -> bool:
    reading = guess.reading
    if about == "frames":
        # Frames are right where all else is; that they are is tested by what the spec explains.
        return True
    if about == "constants":
        known = [(slot.at, slot.data) for slot in _constant(frame)]
        # Envelopes may differ in the last of their constant bytes.
        headers = [each.header for each in model.envelopes.values()]
        first = next(
            size for size in range(len(headers[0]), -1, -1) if len({h[:size] for h in headers}) == 1
        )
        return _constants(guess) in (known, [(0, headers[0][:first])])
    if about == "length":
        length, part = reading.length, frame.length_part
        if length is None or part is None:
            return False
        order = "" if part.size == 1 else part.order
        fit = (length.at, length.kind.size, length.kind.order, length.uncounted)
        return fit == (part.at, part.size, order, frame.uncounted)
    if about == "checksum":
        return any(_checksums(guess) == known for known in _known_checksums(frame))
    if about == "ids":
        return set(reading.ids.offsets) <= {slot.at for slot in frame.ids}
    raise AssertionError(about)


def _constant(frame: Envelope) -> Iterator[Constant]:
    return (slot for slot in frame.slots if isinstance(slot, Constant) and slot.role == "constant")


def _constants(guess: Guess) -> list[tuple[int, bytes]]:
    """Return the constants at both ends; what is the same in between is said, but not claimed."""
    parts = guess.reading.layout.named("constant")
    return [(part.at, part.data) for part in parts if part.at <= 0]


def _checksums(guess: Guess) -> tuple[str, int, str, set[int]]:
    check = guess.reading.check
    assert check is not None
    if isinstance(check, HiddenFit):
        covered = {*range(check.first, _SIZE - check.size)}
        return check.method, -check.size, check.order, covered
    end = _SIZE - check.behind - check.size
    return check.method, end - _SIZE, check.order, {*check.offsets, *range(check.front, end)}


def _known_checksums(frame: Envelope) -> Iterator[tuple[str, int, str, set[int]]]:
    for part in frame.checksums:
        covered: set[int] = set()
        for piece in frame.covered(part, {hidden.name: 0 for hidden in frame.unsent}).pieces:
            if isinstance(piece, tuple):
                covered |= {*range(_SIZE)[piece[0] : piece[1]]}
        yield part.method, part.at, "" if part.size == 1 else part.order, covered
