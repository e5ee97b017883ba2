"""Specs in which every word that Python has taken is the name of something."""

from collections.abc import Iterator, Sequence
from itertools import count
from typing import Any, TypeVar

from framegen.targets.python.reserved import RESERVED

from tests.factories import Data, small_spec

Word = TypeVar("Word")
# More fields than that, and a method has more arguments than linters like.
FIELDS = 6
# One as a number of each type that there is in a crowd.
_ONE = {"u8": [1], "u32": [1, 0, 0, 0]}


def taken(kind: str) -> list[str]:
    """Return the words that no name of a kind can be, in alphabetical order."""
    return sorted({word for row in RESERVED if row.kind == kind for word in row.words})


def taken_names() -> Data:
    """Return every taken word but those of elements, as a name of the kind it is taken for."""
    crowd = Crowd("taken_words", "any", "noise")
    for at, words in enumerate(in_parts(taken("field"))):
        crowd.command(f"Sent{at}", words)
        crowd.report(f"Received{at}", words)
    for at, words in enumerate(in_parts(taken("field of an element"))):
        crowd.command(f"Listed{at}", [], listed=f"list{at}", element=f"Listed{at}Each", of=words)
    # A field of an element may be called as one of its message, as its list, or as what counts it.
    crowd.command("AsField", ["angle"], listed="vents", element="Vent", of=["angle"])
    crowd.command("AsList", [], listed="angle", element="Angle", of=["angle"])
    crowd.command("AsCount", [], listed="vents", counter="angle", element="Slat", of=["angle"])
    for name in ("X", "HTTP", "A1B2", "Struct2", "NoisyStreams"):
        crowd.command(name, [])
    for at, word in enumerate(["class", "latest", "reply", "replies", "self", "kind", "each"]):
        crowd.report(f"Answer{at}", [word])
        crowd.command(f"Ask{at}", [word], reply=f"Answer{at}", method=f"ask{at}({word}) -> {word}")
        crowd.command(f"Many{at}", ["id"], counter=f"{word}_count", listed=word)
        crowd.command(f"Counted{at}", [], counter=word, listed="counted")
        crowd.command(f"Lasting{at}", [word], lasts=word)
    # Two that differ only in capitals are refused: those all in capitals stand in the pose.
    for name in taken("message"):
        if not _shouted(name):
            crowd.report(name, [])
    for at, word in enumerate(taken("method")):
        crowd.command(f"Call{at}", [], method=f"{word}()")
    for at, word in enumerate(taken("strategy")):
        # A method of its own, since these are taken for strategies.
        name = "".join(part.capitalize() for part in word.split("_"))
        crowd.command(name, [], method=f"make{at}()")
    named = {"values": {"name": {"value": 1, "about": "Nobody."}}}
    crowd.command("Vendor", ["vendor"], more_of={"vendor": named})
    crowd.command("Reckon", ["id", "signed_id"], signed="id")
    crowd.command("ReckonMany", ["id"], signed="id", listed="signed_id")
    return crowd.data


def taken_elements() -> Data:
    """Return every taken word of elements as the name of one."""
    crowd = Crowd("taken_elements", "host", "either")
    for at, name in enumerate(taken("element")):
        if not _shouted(name):
            crowd.report(f"Received{at}", [], listed="items", element=name, of=["id"])
    return crowd.data


def taken_pose() -> Data:
    """Return all other messages, and a pose with names that the client has already."""
    crowd = Crowd("pose", "host", "arm")
    crowd.report("Places", [], listed="found", element="Place", of=["id", "position"])
    asked: Data = {"reply": "Places", "echoed": {"targets": "found.id"}}
    crowd.command("PlacesRead", [], listed="targets", method="read(targets) -> found", **asked)
    pair = ["id", "position"]
    crowd.command("Move", ["reply"], listed="goals", element="Goal", of=pair, lasts="reply")
    crowd.command("Release", [], listed="targets")
    for name in filter(_shouted, taken("message")):
        crowd.report(name, [])
    of_messages = {"read": "PlacesRead", "move": "Move", "release": "Release", "ids": "1..250"}
    crowd.data["pose"] = {**of_messages, "hold": "close", "present": "int", "targets": "lambda"}
    return crowd.data


class Crowd:
    """A spec that grows by one message at a time, each with an example of all ones."""

    def __init__(self, name: str, client: str, device: str) -> None:
        self._ids = count(1)
        self._ends = client, device
        frame = {
            "header": {"is": "constant", "bytes": "AA 55"},
            "command": {"is": "id", "type": "u16"},
            "length": {"is": "length", "type": "u8", "counts": ["parameters"]},
            "parameters": {"is": "body"},
        }
        self.data = small_spec(name, frame, {}, ends=f"{client} {device}")

    def command(self, name: str, fields: list[str], **more: Any) -> None:
        self._add(name, " -> ".join(self._ends), fields, **more)

    def report(self, name: str, fields: list[str], **more: Any) -> None:
        self._add(name, " -> ".join(reversed(self._ends)), fields, **more)

    def send(self, name: str, sender: str, receiver: str) -> None:
        """Add a message without fields from one end to another, which may be new."""
        self.data["endpoints"] |= {sender: "An end.", receiver: "An end."}
        self._add(name, f"{sender} -> {receiver}", [])

    def framed(self, name: str, frame: str, parts: list[str]) -> None:
        """Add a message in a frame of its own, with all parts but the header called like these."""
        reserved, station, counter, first, length, second, body, sum_, end = parts
        head = (0xA000 + next(self._ids)).to_bytes(2, "big")
        number: Data = {"type": "u8", "about": "A number."}
        self.data.pop("frame", None)
        self.data.setdefault("frames", {})[frame] = {
            "the_header_of_it": {"is": "constant", "bytes": head.hex(" ").upper()},
            reserved: {"is": "reserved", "bytes": "07", "about": "Nothing."},
            station: {"is": "address", "range": "1..9", **number},
            counter: {"is": "counter", **number},
            first: {"is": "id", **number},
            length: {"is": "length", "counts": [body], **number},
            second: {"is": "id", **number},
            body: {"is": "body"},
            sum_: {"is": "checksum", "method": "xor", "covers": [first, body], **number},
            end: {"is": "constant", "bytes": "0A"},
        }
        data = bytes([7, 1, 1, 3, 1, 4, 5, 3 ^ 5, 0x0A])
        self.data["messages"][name] = {
            **self._said(" -> ".join(reversed(self._ends))),
            "frame": frame,
            "id": {first: 3, second: 4},
            "length": "1",
            "fields": {"level_of_it": number},
            "examples": [_example(head + data, {station: 1, counter: 1, "level_of_it": 5})],
        }

    def odd(self) -> None:
        """Add a message of a number that makes frames no plain ones."""
        number = {"type": "f32", "about": "A number."}
        self.report("TheOddOne", [])
        self.data["messages"]["TheOddOne"] |= {"length": "4", "fields": {"level_of_it": number}}
        example = self.data["messages"]["TheOddOne"]["examples"][0]
        head = bytes.fromhex(example["hex"])[:-1]
        example |= {"hex": (head + bytes([4, 0, 0, 0x80, 0x3F])).hex(" ")}
        example["values"] = {"level_of_it": 1.0}

    def _said(self, direction: str) -> Data:
        return {"direction": direction, "summary": "Say something.", "cite": "manual"}

    def _add(
        self,
        name: str,
        direction: str,
        fields: list[str],
        *,
        listed: str = "",
        counter: str = "number_of",
        element: str = "",
        of: list[str] | None = None,
        signed: str = "",
        more_of: dict[str, Data] | None = None,
        **more: Any,
    ) -> None:
        number = {"type": "u8", "about": "A number."}
        declared: Data = {field: number | (more_of or {}).get(field, {}) for field in fields}
        example: Data = dict.fromkeys(fields, 1)
        body = [byte for each in declared.values() for byte in _ONE[each["type"]]]
        length = str(len(body))
        if listed:
            inner = of or []
            declared[counter] = dict(number)
            declared[listed] = {"counted_by": counter, "about": "Numbers.", "count": "0..8"}
            if element:
                of_each = {field: dict(number) for field in inner}
                declared[listed] |= {"element": element, "fields": of_each}
                example[listed] = [dict.fromkeys(inner, 1)]
            else:
                declared[listed]["type"] = "u8"
                example[listed] = [1]
            length = f"{len(inner) or 1} * {counter} + {len(body) + 1}"
            body += [1] + [1] * (len(inner) or 1)
        if "lasts" in more:
            declared[more["lasts"]]["unit"] = "ms"
        id_ = next(self._ids)
        examples = [_example(_frame(id_, body), example)]
        if signed:
            declared[signed]["signed_as"] = "i8"
            below = [255 if field == signed else 1 for field in fields]
            below += [1] * (len(body) - len(below))
            examples.append(_example(_frame(id_, below), example | {signed: 255}))
        self.data["messages"][name] = {
            **self._said(direction),
            "id": id_,
            "length": length,
            "fields": declared,
            "examples": examples,
            **more,
        }


def _frame(id_: int, body: list[int]) -> bytes:
    return bytes([0xAA, 0x55]) + id_.to_bytes(2, "little") + bytes([len(body)]) + bytes(body)


def _example(frame: bytes, values: Data) -> Data:
    said = {"title": "An example", "constructed": "From nothing."}
    return {**said, "hex": frame.hex(" "), "values": values}


def _shouted(name: str) -> bool:
    return name.isupper() and len(name) > 1


def in_parts(words: Sequence[Word], most: int = FIELDS) -> Iterator[list[Word]]:
    for at in range(0, len(words), most):
        yield [*words[at : at + most]]
