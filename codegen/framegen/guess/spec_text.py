"""A guess as a spec to begin from, with what is undecided in its comments."""

from __future__ import annotations

from collections import defaultdict
from textwrap import wrap
from typing import TYPE_CHECKING

from framewire.explain.words import listed

from framegen.guess.framing import read_number
from framegen.guess.hidden import HiddenFit

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from framegen.guess.framing import Order
    from framegen.guess.guess import Guess
    from framegen.guess.parts import Part

_ABOUT = {
    "header": "What every frame begins with.",
    "trailer": "What every frame ends with.",
    "constant": "The same in every frame of the recording.",
    "length": "How long the frame is.",
    "id": "What the frame says.",
    "address": "Unknown, it may be an address, a running number or anything else.",
    "counter": "Unknown, it may be a running number or anything else.",
    "reserved": "Unknown.",
    "body": "What was not looked into.",
    "checksum": "What proves the frame.",
}
# A list that may go on for longer than any that was recorded.
_LONGEST = 1024
_WIDTH = 96


def spec_text(guess: Guess, name: str, explained: str = "") -> str:
    """Return the text of a spec; `name` is what was recorded, `explained` is how much of it."""
    return "\n".join(_Writer(guess).lines(name, explained)) + "\n"


class _Writer:
    def __init__(self, guess: Guess) -> None:
        self.guess = guess
        self.reading = guess.reading
        self.layout = guess.reading.layout
        self.order = self._order()

    def lines(self, name: str, explained: str) -> Iterator[str]:
        yield "# yaml-language-server: $schema=framegen.schema.json"
        yield "#"
        yield from _comment(f"A spec to begin from, guessed from {name}. {explained}".rstrip())
        for decided, title in ((True, "Decided:"), (False, "Undecided:")):
            found = [each for each in self.guess.conclusions if each.is_decided is decided]
            yield from ("#", f"# {title}") if found else ()
            for each in found:
                yield from _comment(f"{each.about}: {each.says}", "#   ")
                for other in each.others:
                    yield from _comment(f"or else: {other}", "#     ")
        yield from _FRONT.splitlines()
        yield ""
        order = self.order or "little"
        yield f"byte_order: {order}" + ("" if self.order else "  # undecided")
        yield ""
        yield "frame:"
        for part in self.layout.parts:
            yield from self._part(part)
        if isinstance(self.reading.check, HiddenFit):
            yield "  seed:"
            yield from ("    is: id", "    type: u8", "    sent: false")
            yield "    about: A byte that both ends know by the message, and that is only covered."
        yield ""
        yield "# Who sends what, a recording of one line does not say."
        yield "messages:"
        yield from self._messages()

    def _order(self) -> Order:
        """Return the order of the first number that shows it."""
        length, check = self.reading.length, self.reading.check
        orders: list[Order] = [
            "" if length is None else length.kind.order,
            "" if check is None else check.order,
        ]
        return next((order for order in orders if order), "")

    def _part(self, part: Part) -> Iterator[str]:
        yield f"  {part.name}:"
        yield f"    is: {part.is_}"
        if part.is_ in ("constant", "reserved"):
            yield f"    bytes: {_quoted(part.data)}"
        elif part.is_ != "body":
            yield f"    type: u{8 * part.size}"
        if part.is_ == "length" and self.reading.length is not None:
            counts, *others = self.layout.counted(self.reading.length)
            yield f"    counts: [{', '.join(counts)}]"
            for other in others:
                yield from _comment(f"The same on the wire: [{', '.join(other)}]", "    # ")
            yield from self._own_order(self.reading.length.kind.order)
        check = self.reading.check
        if part.is_ == "checksum" and check is not None:
            yield f"    method: {check.method}"
            covers = [*self.layout.covered(check), *self._seed()]
            yield f"    covers: [{', '.join(covers)}]"
            yield from self._own_order(check.order)
        yield f"    about: {_ABOUT[part.name.split('_')[0]]}"

    def _seed(self) -> list[str]:
        return ["seed"] if isinstance(self.reading.check, HiddenFit) else []

    def _own_order(self, order: str) -> Iterator[str]:
        if order and order != self.order:
            yield f"    byte_order: {order}"

    def _messages(self) -> Iterator[str]:
        for ids, frames in sorted(self._by_id().items()):
            by_size: dict[int, list[bytes]] = defaultdict(list)
            for frame in frames:
                by_size[len(frame)].append(frame)
            name = "Message" + "".join(f"{each:02X}" for each in ids)
            if self.reading.length is not None or len(by_size) == 1:
                yield from self._message(name, ids, frames)
                continue
            if self.reading.check is None:
                # The shorter ones could be the beginning of the longer ones.
                usual = max(by_size, key=lambda size: len(by_size[size]))
                others = listed([str(size) for size in sorted(by_size) if size != usual])
                yield from _comment(
                    f"Nothing found in frames of {others} bytes tells them from those of {usual}: "
                    "look for an id, a constant or a range in each before you add them.",
                    "  # ",
                )
                by_size = {usual: by_size[usual]}
            for size, those in sorted(by_size.items()):
                yield from self._message(f"{name}Of{size}", ids, those)

    def _by_id(self) -> dict[tuple[int, ...], list[bytes]]:
        found: dict[tuple[int, ...], list[bytes]] = defaultdict(list)
        for frame in self.reading.sound:
            found[tuple(frame[part.at] for part in self.layout.named("id"))].append(frame)
        return found

    def _message(self, name: str, ids: tuple[int, ...], frames: Sequence[bytes]) -> Iterator[str]:
        yield f"  {name}:"
        yield from self._ids(ids, frames[0])
        yield "    direction: device -> host"
        yield f"    summary: {'Unknown' if ids else 'What every frame is'}."
        yield "    cite: recording"
        sizes = sorted({len(frame) - self.layout.fixed for frame in frames})
        length, fixed = self.reading.length, self.layout.fixed
        uncounted = 0 if length is None else length.uncounted
        if len(sizes) == 1:
            yield f"    length: {sizes[0] + fixed - uncounted}"
        else:
            yield f"    length: data + {fixed - uncounted}"
        if sizes != [0]:
            yield "    fields:"
            yield "      data:"
            yield "        type: u8"
            if len(sizes) > 1:
                yield "        sized_by: length"
                yield f"        count: {self._count(sizes)}"
            elif sizes[0] > 1:
                yield f"        count: {sizes[0]}"
            yield "        about: Unknown."
        yield "    examples:"
        for frame in {len(frame): frame for frame in frames[:2]}.values():
            yield from self._example(frame, single=sizes == [1])
        yield ""

    def _ids(self, ids: tuple[int, ...], frame: bytes) -> Iterator[str]:
        numbers = dict(zip((part.name for part in self.layout.named("id")), ids, strict=True))
        check = self.reading.check
        if isinstance(check, HiddenFit):
            numbers["seed"] = check.hidden(frame) or 0
        if len(numbers) == 1:
            yield f"    id: {next(iter(numbers.values()))}"
        elif numbers:
            yield f"    id: {{{', '.join(f'{name}: {each}' for name, each in numbers.items())}}}"

    def _count(self, sizes: Sequence[int]) -> str:
        """Return how many there may be: as many as the length can say, if that is not too much."""
        length = self.reading.length
        if length is not None and length.kind.size == 1:
            least = max(0, length.uncounted - self.layout.fixed)
            return f"{least}.."
        return f"0..{max(_LONGEST, sizes[-1])}"

    def _example(self, frame: bytes, *, single: bool) -> Iterator[str]:
        yield "      - title: As recorded"
        yield f"        hex: {_quoted(frame)}"
        values = []
        for part in (*self.layout.named("address"), *self.layout.named("counter")):
            number = read_number(frame[part.at : part.end], self.order or "little")
            values.append(f"{part.name}: {number}")
        behind = self.layout.fixed - self.layout.body.at
        data = frame[self.layout.body.at : len(frame) - behind]
        if single:
            values.append(f"data: {data[0]}")
        elif data:
            values.append(f"data: [{', '.join(map(str, data))}]")
        elif self._varies(frame):
            values.append("data: []")
        yield f"        values: {{{', '.join(values)}}}"
        yield "        cite: recording"

    def _varies(self, frame: bytes) -> bool:
        """Return whether the message of a frame has frames of other sizes."""
        key = tuple(frame[part.at] for part in self.layout.named("id"))
        sizes = {len(each) for each in self._by_id()[key]}
        return self.reading.length is not None and len(sizes) > 1


_FRONT = """
framegen: 2

protocol:
  name: guessed
  title: A protocol that was guessed
  version: "0.1.0"
  authority: recording
  summary: Frames of a recording.

sources:
  recording:
    title: A recording of the line
    kind: observation

endpoints:
  host: The one end.
  device: The other end.

link:
  baud: 9600  # unknown"""


def _comment(text: str, indent: str = "# ") -> Iterable[str]:
    plain = "".join(each if each.isprintable() else "?" for each in text)
    return wrap(plain, _WIDTH, initial_indent=indent, subsequent_indent=indent)


def _quoted(data: bytes) -> str:
    """Return hex that YAML takes for text: one byte alone may be a number."""
    text = data.hex(" ").upper()
    return text if len(data) > 1 else f'"{text}"'
