"""Rows of what needs no line: events of streams, errors of frames and of values, and messages."""

from __future__ import annotations

import copy
import json
import pickle
from collections import defaultdict
from typing import TYPE_CHECKING, Any

from tests.characterised.texts import chance, lines, outcome, told, ways

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from random import Random
    from types import ModuleType

    from tests.characterised.texts import Rows

# How many rows of random streams there are of each direction, and how many streams in each.
GROUPS, STREAMS = 4, 25
# What no field takes, or only few do.
ODD: tuple[Any, ...] = (None, "x", "", 1.5, -1, 256, 10**12, True, [], [None], (1, 2), {}, b"\0")


def frames_of(vectors: dict[str, Any]) -> list[bytes]:
    """Return the published frames."""
    return [bytes.fromhex(each["hex"]) for each in vectors["valid"]]


def by_message(made: ModuleType, vectors: dict[str, Any]) -> dict[str, list[Any]]:
    """Return the messages of the published frames, by the name of each."""
    found: dict[str, list[Any]] = defaultdict(list)
    for each in vectors["valid"]:
        message = made.decode(bytes.fromhex(each["hex"]), made.Direction(each["direction"]))
        found[type(message).__name__].append(message)
    return found


def event_rows(made: ModuleType, vectors: dict[str, Any]) -> Rows:
    frames = frames_of(vectors)
    for way in ways(made):
        label = "any" if way is None else way.value
        for name, messages in by_message(made, vectors).items():
            whole = b"".join(each.encode() for each in messages)
            noisy = b"\x55\x00".join([b"\xff", *(each.encode() for each in messages), b"\xff\x0a"])
            texts = (_decoded(made.StreamDecoder(way), [each]) for each in (whole, noisy))
            yield f"events/{label}-published-{name}", lines(texts)
        for group in range(GROUPS):
            texts = (
                _hostile(made, way, frames, chance(label, group, number))
                for number in range(STREAMS)
            )
            yield f"events/{label}-random-{group}", lines(texts)
    published: dict[str, list[str]] = defaultdict(list)
    for each in vectors["streams"]:
        decoder = made.StreamDecoder(made.Direction(each["direction"]), each["max_frame"])
        parts = [None if part == "quiet" else bytes.fromhex(part) for part in each["parts"]]
        published[each["title"].partition(":")[0]].append(_decoded(decoder, parts))
    for title, streams in published.items():
        yield f"events/vectors-{title.replace(' ', '-')}", lines(streams)


def _decoded(decoder: Any, parts: Sequence[bytes | None]) -> str:
    """Return the events of each part, and what is held behind it; None is a quiet line."""
    texts = []
    for part in [*parts, None]:
        events = decoder.flush() if part is None else decoder.feed(part)
        texts.append(f"{told(events)} {decoder.held.hex()} {decoder.missing}")
    return lines(texts)


def _hostile(made: ModuleType, way: Any, frames: list[bytes], by: Random) -> str:
    stream = b"".join(_piece(frames, by) for _ in range(by.randrange(1, 7)))
    largest = by.choice([None, None, None, max(map(len, frames)) // 2 + 4])
    parts: list[bytes | None] = []
    while stream:
        size = by.choice([1, 2, 5, 20, 1000])
        parts += [stream[:size], *([None] if by.random() < 0.1 else [])]
        stream = stream[size:]
    try:
        decoder = made.StreamDecoder(way, largest)
    except ValueError as error:
        return told(error)
    return _decoded(decoder, parts)


def _piece(frames: list[bytes], by: Random) -> bytes:
    frame, other = by.choice(frames), by.choice(frames)
    at = by.randrange(len(frame) + 1)
    changed = bytearray(frame)
    changed[by.randrange(len(frame))] ^= by.choice([0xFF, 1, 0x80, 1 << by.randrange(8)])
    some = bytes(by.randrange(256) for _ in range(by.randrange(12)))
    return by.choice(
        [frame, frame, frame[:at], frame[at:], frame[:at] + other, bytes(changed), some]
    )


def error_rows(made: ModuleType, vectors: dict[str, Any]) -> Rows:
    refused: dict[str, list[str]] = defaultdict(list)
    for each in vectors["invalid"]:
        way = made.Direction(each["direction"])
        data = bytes.fromhex(each["hex"])
        refused[each["title"].partition(":")[0]].append(outcome(made.decode, data, way))
    for title, texts in refused.items():
        yield f"errors/vectors-{title.replace(' ', '-')}", lines(texts)
    for name, messages in by_message(made, vectors).items():
        own = _mutated(messages[0].encode())
        texts = [outcome(made.decode, data, way) for data in own for way in made.Direction]
        texts += [outcome(type(messages[0]).decode, data) for data in own[:20]]
        yield f"errors/decode-{name}", lines(texts)
        kind, usual = type(messages[0]), messages[0].to_dict()
        given = {each: getattr(messages[0], each) for each in kind.__match_args__}
        texts = [outcome(kind), outcome(kind.from_dict, {}), outcome(kind, **given, qqq=1)]
        texts += [outcome(kind.from_dict, it) for it in (None, [1], "x", usual | {"qqq": 1})]
        texts += [outcome(kind, **(given | {each: odd})) for each in given for odd in ODD]
        texts += [outcome(kind.from_dict, usual | {each: odd}) for each in usual for odd in ODD]
        yield f"errors/values-{name}", lines(texts)
    unencodable: dict[str, list[str]] = defaultdict(list)
    for each in vectors["unencodable"]:
        its = getattr(made, each["message"], None)
        if its is not None:
            known, given = its.__match_args__, each["fields"]
            given = {name if name in known else f"{name}_": it for name, it in given.items()}
            texts = [outcome(its, **given), outcome(its.from_dict, given)]
            unencodable[each["message"]] += texts
    for title, texts in unencodable.items():
        yield f"errors/unencodable-{title}", lines(texts)


def _mutated(frame: bytes) -> list[bytes]:
    """Return a frame cut short, grown, and changed at each of its first bytes and its last."""
    places = [*range(min(len(frame), 12)), len(frame) - 1]
    changed = [
        frame[:at] + bytes([frame[at] ^ bits]) + frame[at + 1 :]
        for at in places
        for bits in (1, 255)
    ]
    return [frame[:-1], frame[: len(frame) // 2], frame + b"\0", frame * 2, *changed]


def message_rows(made: ModuleType, vectors: dict[str, Any]) -> Rows:
    for name, messages in by_message(made, vectors).items():
        yield f"messages/{name}", lines(line for each in messages for line in _message(each))
        yield f"messages/{name}-html", lines(each._repr_html_() for each in messages)
    noise = made.StreamDecoder(None)
    pieces = [
        each
        for data in frames_of(vectors)
        for each in noise.feed(bytes([*data[:-1], data[-1] ^ 1])) + noise.flush()
        if isinstance(each, made.Noise)
    ]
    yield "messages/noise", lines(f"{told(each)} {each._repr_html_()}" for each in pieces[:100])


def _message(message: Any) -> Iterator[str]:
    kind, data = type(message), message.to_dict()
    yield told(message)
    yield json.dumps(data)
    yield told(kind.from_dict(data))
    given = {each: getattr(message, each) for each in kind.__match_args__}
    yield repr(given)
    again = [kind(**given), copy.deepcopy(message), message.__replace__(**given)]
    again.append(pickle.loads(pickle.dumps(message)))  # noqa: S301 - it is our own
    yield repr([each == message and hash(each) == hash(message) for each in again])
    yield repr([message != message.encode(), message == kind.from_dict(data), {message: 1} != {}])
    for each in kind.__match_args__:
        yield outcome(setattr, message, each, 0)
    yield outcome(getattr, message, "nothing")
