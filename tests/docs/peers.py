"""Python's side of every comparison with the decoder in the page: what the library says."""

from __future__ import annotations

import json
import random
import sys
from importlib import import_module
from typing import TYPE_CHECKING, Any

from framegen.targets import python, vectors

from tests.docs.reference import Reference, reference

if TYPE_CHECKING:
    from pathlib import Path
    from types import ModuleType

Event = list[Any]


def library(name: str, folder: Path) -> ModuleType:
    """The generated library of a reference: the committed one, or one written to `folder`."""
    if name == "busservo":
        return import_module("busservo")
    site = reference(name)
    for path, text in python.render(site.compiled, {}).items():
        file = folder / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")
    sys.path.insert(0, str(folder / "generated"))
    try:
        return import_module(name)
    finally:
        sys.path.remove(str(folder / "generated"))


def vectors_of(site: Reference) -> dict[str, Any]:
    """The test vectors of a reference, as they are published."""
    (text,) = vectors.render(site.compiled, {}).values()
    document: dict[str, Any] = json.loads(text)
    return document


def python_events(module: ModuleType, data: bytes, direction: str | None) -> list[Event]:
    """What the library's StreamDecoder makes of `data` and the silence after it."""
    way = None if direction is None else module.Direction(direction)
    decoder = module.StreamDecoder(way)
    return [_plain(module, event) for event in [*decoder.feed(data), *decoder.flush()]]


def _plain(module: ModuleType, event: Any) -> Event:
    if isinstance(event, module.Noise):
        kind = "unknown" if isinstance(event, module.UnknownFrame) else "noise"
        return [kind, event.data.hex(), event.reason.value]
    return ["message", event.encode().hex(), type(event).__name__]


def python_verdict(module: ModuleType, data: bytes, direction: str | None) -> Event:
    """What the library makes of `data` as one frame: its name, or the reason and the byte."""
    way = None if direction is None else module.Direction(direction)
    try:
        return ["message", type(module.decode(data, way)).__name__]
    except module.DecodeError as error:
        return [error.reason.value, error.offset]


def noisy_lines(site: Reference, seed: int, number: int) -> list[bytes]:
    """Lines on which frames were cut and spoilt, with noise between them that looks like frames."""
    chance = random.Random(seed)  # noqa: S311 - the same noise in every run
    frames = [bytes.fromhex(each["hex"]) for each in vectors_of(site)["valid"]]
    frames = [frame for frame in frames if len(frame) < 60]
    return [_line(chance, frames, site.model.frame.header) for _ in range(number)]


def _line(chance: random.Random, frames: list[bytes], header: bytes) -> bytes:
    line = b""
    for _ in range(chance.randrange(1, 7)):
        frame = chance.choice(frames)
        match chance.randrange(8):
            case 0:
                line += chance.randbytes(chance.randrange(6))
            case 1:
                line += frame[: chance.randrange(len(frame))]
            case 2:
                at = chance.randrange(len(frame))
                line += frame[:at] + bytes([chance.randrange(256)]) + frame[at + 1 :]
            case 3:
                line += header[: chance.randrange(1, len(header) + 1)] * chance.randrange(1, 4)
            case 4:
                tail = bytes(chance.choices([*header, 0, 2, 3, 5, 7, 255], k=chance.randrange(9)))
                line += header + tail
            case _:
                line += frame
    return line
