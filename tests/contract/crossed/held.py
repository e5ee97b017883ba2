"""A spec held four ways: reference, library, JavaScript and tables say the same of the same bytes.

What is wrong is returned in words, one text for each fault; nothing is raised.
"""

import json
import math
import random
import traceback
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from importlib import import_module
from itertools import islice
from types import ModuleType
from typing import Any

from framegen.conformance.comparison import compare
from framegen.conformance.dice import Dice, random_values
from framegen.conformance.further import further
from framegen.conformance.language import Question, Stream
from framegen.conformance.program import Reply
from framegen.conformance.questions import questions
from framegen.explain import explain
from framegen.language.values import Direction
from framegen.model.apart import begun
from framegen.model.codec import encode, values_of
from framegen.model.model import Model
from framegen.model.stream import ReferenceDecoder
from framegen.model.verdict import weigh_whole
from framegen.targets.python.names import names_of
from hypothesis import given

from tests.contract.crossed.scripts import Scripts
from tests.factories import library, library_files
from tests.handed import answers_of, explanations_of
from tests.lines.every_method import converse
from tests.mutations.crossed import Crossed
from tests.protocols.libraries import direction_of, values_in
from tests.unit.runtime.tables.rows import places_of_reference, rows_in_tables, rows_of_decoder

Asked = list[tuple[str, Question]]

# Of the published questions of a spec so many are asked, and so many that nobody published: most
# are like those of others. So many lines are read as tables, with one of these sizes of a block.
PUBLISHED, FURTHER, LINES = 400, 100, 6
BLOCKS = (1, 7, 64, 600, None)
# So many messages are read again: as many as it takes to meet what a byte of a checksum lets pass.
THEMSELVES = 600
# More differences of one kind would say nothing else.
FEW = 3


def faults(crossed: Crossed, scripts: Scripts) -> list[str]:
    """Return what is wrong with what is made of a spec."""
    model = crossed.compiled.model
    chance = random.Random(f"held {crossed.seed}")  # noqa: S311 - no secret
    asked = _asked(model, crossed.seed, chance)
    looks: dict[str, Callable[[], Iterator[str]]] = {
        "reference": lambda: _themselves(model, crossed.seed),
        "JavaScript": lambda: _answers(model, asked, scripts.of(model)),
        "library": lambda: _of_library(crossed, asked, chance),
    }
    return [fault for who, look in looks.items() for fault in _guarded(who, look)]


def _asked(model: Model, seed: int, chance: random.Random) -> Asked:
    published = [*questions(model)]
    some = chance.sample(published, min(PUBLISHED, len(published)))
    return [*some, *islice(further(model, seed), FURTHER)]


def _guarded(who: str, look: Callable[[], Iterator[str]]) -> Iterator[str]:
    """Yield the faults that a look finds, what it raises among them."""
    try:
        for fault in look():
            yield f"{who}: {fault}"
    except Exception as error:  # noqa: BLE001 - whatever it is, it is reported with the spec
        *_, last = traceback.extract_tb(error.__traceback__)
        place = f"{last.filename.rpartition('/')[2]}:{last.lineno}, {last.line}"
        notes = "".join(f"\n{note}" for note in getattr(error, "__notes__", ()))
        yield f"{who}: {type(error).__name__}: {error} ({place}){notes}"


def _themselves(model: Model, seed: int) -> Iterator[str]:
    """Yield messages that do not read as themselves; what all agree in is as wrong."""
    dice, messages = Dice(seed), [*model.messages.values()]
    for _ in range(THEMSELVES):
        message = dice.pick(messages)
        values = random_values(dice, message)
        frame = encode(message, values)
        read = weigh_whole(model, [message.direction], frame)
        if read.message is not message:
            yield f"{message.name} {values} is {frame.hex(' ')}, {read.refusal}"
        elif encode(message, values_of(message, frame)) != frame:
            yield f"{message.name} {values} is {frame.hex(' ')}, with other values"


def _answers(model: Model, asked: Asked, answer: Callable[[str], Sequence[str]]) -> Iterator[str]:
    """Yield the questions that are answered otherwise than by the reference."""
    number = 0
    for title, question in asked:
        found = compare(model, title, question, Reply(tuple(answer(question.line))))
        if found is not None and (number := number + 1) <= FEW:
            pairs = found.expected[found.at :][:2], found.answered[found.at :][:2]
            yield f"{title}\n{question.line}\ndue {pairs[0]}\nnot {pairs[1]}"


def _of_library(crossed: Crossed, asked: Asked, chance: random.Random) -> Iterator[str]:
    model = crossed.compiled.model
    with library(library_files(crossed.compiled)) as made:
        answer = answers_of(made.__name__)
        looks: dict[str, Callable[[], Iterator[str]]] = {
            "answers": lambda: _answers(model, asked, answer),
            "messages": lambda: _Messages(made, model).faults(),
            "tables": lambda: _tables(made, model, asked, chance),
            "client": lambda: _conversation(made, model),
        }
        for what, look in looks.items():
            yield from _guarded(what, look)


def _conversation(made: ModuleType, model: Model) -> Iterator[str]:
    import_module(f"{made.__name__}.device")
    converse(made, names_of(model).library)
    yield from ()


# ---------------------------------------------------------------------------- messages


@dataclass(frozen=True)
class _Messages:
    """Messages as the strategies of a library make them, and what becomes of each."""

    made: ModuleType
    model: Model

    @cached_property
    def drawn(self) -> list[Any]:
        """Some messages, all of which the strategies of the library make."""
        strategies: Any = import_module(f"{self.made.__name__}.strategies")
        found: list[Any] = []

        @given(strategies.messages())
        def draw(message: Any) -> None:
            found.append(message)

        draw()
        return found

    def faults(self) -> Iterator[str]:
        """Yield what is wrong with messages alone, and behind each other on a line."""
        seen: set[type] = set()
        for message in self.drawn:
            yield from self._of_one(message)
            # What is shown for people takes its time.
            if type(message) not in seen:
                seen.add(type(message))
                yield from self._shown(message)
        # Where a frame may begin with another by chance, so may two of them.
        if next(begun(self.model), None) is None:
            for way in self.model.directions:
                yield from self._of_a_line(way)

    def _of_one(self, message: Any) -> Iterator[str]:
        frame = message.encode()
        read = self.made.decode(frame, message.DIRECTION)
        if read != message:
            yield f"reads itself as {read!r}: {message!r} is {frame.hex(' ')}"
        layout = self._layouts[type(message).__name__]
        right = encode(layout, values_in(layout, message))
        if right != frame:
            yield f"{message!r} is {right.hex(' ')}, and is written {frame.hex(' ')}"
        if type(message).from_dict(json.loads(json.dumps(message.to_dict()))) != message:
            yield f"is another behind to_dict: {message!r}"

    @cached_property
    def _layouts(self) -> dict[str, Any]:
        return dict(names_of(self.model).library.messages)

    def _shown(self, message: Any) -> Iterator[str]:
        names = {name: getattr(self.made, name) for name in self.made.__all__}
        names |= {"inf": math.inf}
        if eval(repr(message), names) != message:  # noqa: S307 - it is our own
            yield f"is another behind repr: {message!r}"
        yield from self._in_a_notebook(message)
        frame = message.encode()
        here = explain(self.model, frame, self.model.directions)
        there = explanations_of(self.made.__name__)(frame)
        if repr(here) != repr(there):
            yield f"is explained as {there}, not {here}"

    def _in_a_notebook(self, message: Any) -> Iterator[str]:
        parts = import_module("framewire.frame.parts")
        frame = message.encode()
        cells = [*parts.message_parts(message)]
        if b"".join(data for data, _, _ in cells) != frame:
            yield f"has a strip of other bytes: {message!r}"
        layout = self._layouts[type(message).__name__]
        head = [(slot, *cell) for slot, cell in zip(layout.frame.head, cells, strict=False)]
        for slot, data, name, says in head:
            due = "" if slot.role in ("constant", "reserved") else str(slot.read(data))
            if name != slot.name or (says != due and not (due and says.startswith(f"{due} "))):
                yield f"says {name} is {says!r} in its strip, not {slot.name} {due!r}: {message!r}"
        assert message._repr_html_()

    def _of_a_line(self, way: Direction) -> Iterator[str]:
        direction = direction_of(self.made, way)
        sent = [each for each in self.drawn if each.DIRECTION is direction]
        decoder = self.made.StreamDecoder(direction)
        read = [*decoder.feed(b"".join(each.encode() for each in sent)), *decoder.flush()]
        if read != sent:
            pairs = zip(read, sent, strict=False)
            one, other = next(((a, b) for a, b in pairs if a != b), (None, None))
            yield f"come from a line as {one!r}, and were {other!r}"


# ---------------------------------------------------------------------------- tables


def _tables(made: ModuleType, model: Model, asked: Asked, chance: random.Random) -> Iterator[str]:
    """Yield the lines of which the tables hold something else than decoders find."""
    named = names_of(model).library
    streams = [question for _, question in asked if isinstance(question, Stream)]
    for question in chance.sample(streams, min(LINES, len(streams))):
        line = b"".join(part for part in question.parts if part is not None)
        way = chance.choice([question.way, None])
        direction = None if way is None else direction_of(made, way)
        found = rows_in_tables(made, line, direction, block=chance.choice(BLOCKS))
        reference = ReferenceDecoder(named, model.directions if way is None else [way])
        if found != rows_of_decoder(made, line, direction):
            yield f"{line.hex()} is other rows than the decoder finds: {found}"
        right = places_of_reference(reference.decode(line))
        if [row.place for row in found] != right:
            yield f"{line.hex()} is {[row.place for row in found]}, and not {right}"
