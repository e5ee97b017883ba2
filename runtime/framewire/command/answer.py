"""The verb `answer`: a library at the end of a pipe, for programs in any language."""

from __future__ import annotations

import sys
from functools import cached_property
from warnings import catch_warnings, simplefilter

from ..codec.hextext import HexError, read_hex
from ..codec.noise import Noise, UnknownFrame
from ..frame.errors import DecodeError, EncodeError
from .console import visible
from .encode import message_named
from .exit_codes import DONE, UNUSABLE
from .numerals import whole
from .usage_error import UsageError
from .values import EMPTY, as_word, fields_from_text

TYPE_CHECKING = False
if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace
    from collections.abc import Iterator
    from typing import Any

    from ..client.library import Library
    from ..frame.direction import Direction
    from ..frame.message import Message
    from .program import Program

ENDS = {UNUSABLE: "a question could not be understood; its answer says why"}


def about(program: Program) -> str:
    """Return what it answers, in full."""
    ways = " or ".join(way.value for way in program.library.codec.directions)
    return f"""\
Questions are read from standard input, a line each, and answered at once:

    decode WAY HEX              message NAME HEX FIELDS...  or  refused REASON OFFSET
    encode NAME FIELDS...       frame HEX  or  refused
    stream WAY LARGEST PARTS... what a line says, an event in each line

and a line `end` after each answer. WAY is {ways}.
PARTS are chunks in hex, and `quiet` where the line goes quiet; no frame of more than LARGEST bytes
is taken. Events are `message NAME HEX FIELDS...`, `unknown HEX`, `noise REASON HEX` and `quiet`."""


def add_arguments(_parser: ArgumentParser, _program: Program) -> None:
    """Declare the arguments of the verb: none."""


def run(_arguments: Namespace, program: Program) -> int:
    """Answer until the input ends; continue after a question that makes no sense."""
    status = DONE
    answerer = Answerer(program.library)
    for question in _questions():
        try:
            said = answerer.answer(question)
        except UsageError as error:
            said, status = [f"error {visible(str(error))}"], UNUSABLE
        print(*said, "end", sep="\n", flush=True)
    return status


def _questions() -> Iterator[str]:
    try:
        for line in sys.stdin.buffer:
            question = line.decode("utf-8", "replace").strip()
            if question:
                yield question
    except OSError as error:
        why = error.strerror or error
        raise UsageError(f"standard input cannot be read: {why}") from None


class Answerer:
    """What answers questions about the messages of a library."""

    def __init__(self, library: Library) -> None:
        self._library = library
        self._codec = library.codec

    @cached_property
    def _classes(self) -> dict[str, str]:
        """The class of each message by its name in the specification, which others use."""
        return self._library.protocol().classes

    @cached_property
    def _names(self) -> dict[str, str]:
        return {kind: name for name, kind in self._classes.items()}

    def answer(self, question: str) -> list[str]:
        """Return the lines of an answer, without the `end`. Raises UsageError."""
        verb, *words = question.split()
        if verb == "encode" and words:
            return [self._encoded(words[0], words[1:])]
        if verb == "decode" and words:
            return [self._decoded(self._way(words[0]), _bytes(" ".join(words[1:])))]
        if verb == "stream" and len(words) > 1:
            return self._streamed(self._way(words[0]), words[1], words[2:])
        raise UsageError("ask `decode WAY HEX`, `encode NAME FIELDS` or `stream WAY LARGEST PARTS`")

    def _encoded(self, name: str, words: list[str]) -> str:
        kind = message_named(self._classes.get(name, name), self._codec)
        # A field that is called like a word of Python has another name here.
        bent = {name.rstrip("_"): name for name in kind.__match_args__}
        pairs = [word.partition("=") for word in words]
        bare = [f"{bent.get(name, name)}={text}" for name, _, text in pairs]
        given = fields_from_text(kind, bare)
        try:
            with catch_warnings():
                # Nothing here is a program that could heed a warning.
                simplefilter("ignore", DeprecationWarning)
                return f"frame {kind(**given).encode().hex()}"
        except EncodeError:
            return "refused"

    def _decoded(self, way: Direction, data: bytes) -> str:
        try:
            return self._event(self._codec.decode(data, way))
        except DecodeError as error:
            return f"refused {_dashed(error.reason.value)} {error.offset}"

    def _streamed(self, way: Direction, largest: str, words: list[str]) -> list[str]:
        try:
            decoder = self._codec.decoder(way, whole(largest))
        except ValueError as error:
            raise UsageError(f"{largest}: {error}") from None
        said: list[str] = []
        for word in words:
            if word == "quiet":
                said += [*map(self._event, decoder.flush()), "quiet"]
            else:
                said += map(self._event, decoder.feed(_bytes(word)))
        return said

    def _event(self, event: Message | Noise) -> str:
        if isinstance(event, UnknownFrame):
            return f"unknown {event.data.hex()}"
        if isinstance(event, Noise):
            return f"noise {_dashed(event.reason.value)} {event.data.hex()}"
        given = event.to_dict().items()
        shown = [(name.rstrip("_"), value) for name, value in given if value is not None]
        fields = [f"{name}={_text(value)}" for name, value in shown]
        name = self._names[type(event).__name__]
        return " ".join(["message", name, event.encode().hex(), *fields])

    def _way(self, word: str) -> Direction:
        directions = self._codec.directions
        try:
            return directions(word)
        except ValueError:
            ways = " and ".join(way.value for way in directions)
            raise UsageError(f"there is no way {word[:40]!r}; there are {ways}") from None


def _text(value: Any) -> str:
    """Return the text of a value, or of a list of values or of mappings of values."""
    if not isinstance(value, list):
        return as_word(value)
    elements = [each.values() if isinstance(each, dict) else [each] for each in value]
    return ",".join(":".join(as_word(each) or EMPTY for each in element) for element in elements)


def _bytes(digits: str) -> bytes:
    try:
        # Programs write digits alone, of which 0b begins a byte like another.
        return bytes.fromhex(digits)
    except ValueError:
        pass
    try:
        return read_hex(digits)
    except HexError as error:
        raise UsageError(str(error)) from None


def _dashed(reason: str) -> str:
    return reason.replace(" ", "-")
