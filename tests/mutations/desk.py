"""The desk of an author: a spec that is changed, and places in it that are drawn by lot."""

import random
import re
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from itertools import product
from typing import Any, TypeVar

from tests.factories import Data
from tests.mutations.authors import MARK, kinds_of, parts_of

T = TypeVar("T")


class Inapplicable(Exception):  # noqa: N818 - says what the mutation is
    """A mutation for which there is no place in a spec."""


@dataclass(frozen=True)
class Spot:
    """A field and the fields among which it is; `message` has them, or the list that it is in."""

    message: Data
    fields: Data
    name: str
    inner: bool

    @property
    def field(self) -> Any:
        return self.fields[self.name]


@dataclass(frozen=True)
class Desk:
    """A marked spec, which mutations change, and the chance that chooses where."""

    spec: Data
    chance: random.Random

    def pick(self, things: Iterable[T]) -> T:
        """Return one of some things, the same in each run: a set has another order in each."""
        found = sorted(things, key=str) if isinstance(things, set) else list(things)
        if not found:
            raise Inapplicable
        return self.chance.choice(found)

    def one_of(self, things: Data) -> Any:
        """Return one of some things that have names."""
        return things[self.pick(things)]

    def fresh(self, stem: str) -> str:
        text = repr(self.spec)
        return next(name for at in range(1, 99) if (name := f"{stem}{at}") not in text)

    @property
    def messages(self) -> Any:
        return self.spec["messages"]

    @property
    def kinds(self) -> dict[str, Data]:
        return kinds_of(self.spec)

    def parts_of(self, message: Data) -> Data:
        return parts_of(self.spec, message)

    def spots(self) -> Iterator[Spot]:
        for message in self.messages.values():
            for name, field in message["fields"].items():
                yield Spot(message, message["fields"], name, inner=False)
                for inner in field.get("fields", ()):
                    yield Spot(message, field["fields"], inner, inner=True)

    def spot(self, fits: Callable[[Spot], Any]) -> Spot:
        return self.pick(spot for spot in self.spots() if fits(spot))

    def number(self, fits: Callable[[Data], Any] = lambda _: True) -> Spot:
        """Return some number that a user gives, also one of an element."""
        return self.spot(lambda spot: is_number(spot) and fits(spot.field))

    def part(self, fits: Callable[[Data], Any]) -> tuple[Data, str]:
        """Return the parts of some kind of frame, and the name of one that fits."""
        parts = ((each, name) for each in self.kinds.values() for name in each)
        return self.pick((each, name) for each, name in parts if fits(each[name]))

    def rename_field(self, spot: Spot, new: str, *, said: bool) -> None:
        old = spot.name
        renamed_in(spot.fields, old, new, said=said)
        if not spot.inner:
            for field, key in product(spot.fields.values(), ("counted_by", "sized_by")):
                if field.get(key) == old:
                    field[key] = new
            for key in ("method", "lasts", "failure", "asks_for"):
                if key in spot.message:
                    spot.message[key] = in_words(spot.message[key], old, new)

    def rename_part(self, parts: Data, old: str, new: str) -> None:
        renamed_in(parts, old, new)
        for part, key in product(parts.values(), ("counts", "covers")):
            if key in part:
                part[key] = [new if each == old else each for each in part[key]]

    def rename_message(self, old: str, new: str, *, said: bool) -> None:
        renamed_in(self.messages, old, new, said=said)
        for each in self.messages.values():
            for key in ("reply", "refusal", "acknowledged"):
                if each.get(key) == old:
                    each[key] = new
            if "reports" in each:
                each["reports"] = [new if name == old else name for name in each["reports"]]


def in_words(text: str, old: str, new: str) -> str:
    return re.sub(rf"\b{re.escape(old)}\b", new, text)


def renamed_in(things: Data, old: str, new: str, *, said: bool = False) -> None:
    """Give a thing another name, in its place; `said` writes the old one down there."""
    _put(things, {new if name == old else name: each for name, each in things.items()})
    if said:
        before = things[new].get("was", [])
        names = [old, *([before] if isinstance(before, str) else before)]
        things[new] = {**things[new], "was": names if before else old}


def other_order(desk: Desk, thing: Data) -> None:
    order = thing.get("byte_order", desk.spec["byte_order"])
    thing["byte_order"] = "little" if order == "big" else "big"


def _put(around: Data, things: Data) -> None:
    """Put other things in the place of those that are there."""
    around.clear()
    around.update(things)


def reordered(around: Data, names: Iterable[str]) -> None:
    """Put things into another order; those that are not named are dropped."""
    _put(around, {name: around[name] for name in [*names]})


def inserted(around: Data, at: int, name: str, thing: Data) -> None:
    items = [*around.items()]
    _put(around, dict([*items[:at], (name, thing), *items[at:]]))


def copied(thing: Any) -> Any:
    """Return a copy of a thing that is another thing: without marks."""
    if isinstance(thing, dict):
        return {key: copied(each) for key, each in thing.items() if key not in (MARK, "was")}
    return [copied(each) for each in thing] if isinstance(thing, list) else thing


def is_single(field: Data) -> bool:
    """Tell whether a field is one number or a constant, no list and no text."""
    return "type" in field and not {"count", "counted_by", "sized_by", "text"} & field.keys()


def is_constant(field: Data) -> bool:
    """Tell whether a field is no argument."""
    return "always" in field or "reserved" in field


def is_counter(spot: Spot) -> bool:
    """Tell whether a field says how long a list is."""
    others = spot.fields.values()
    return any(spot.name in (each.get("counted_by"), each.get("sized_by")) for each in others)


def is_number(spot: Spot) -> bool:
    """Tell whether a field is one number that a user gives."""
    return is_single(spot.field) and not is_constant(spot.field) and not is_counter(spot)


def is_whole(field: Data) -> bool:
    return field["type"][0] in "ui"


def varies(field: Data) -> bool:
    return "counted_by" in field or "sized_by" in field


def bounds_of(field: Data) -> tuple[int, int]:
    """Return the lowest and the highest value of a whole number."""
    bits, signed = int(field["type"][1:]), field["type"][0] == "i"
    low, high = (-(1 << bits - 1), (1 << bits - 1) - 1) if signed else (0, (1 << bits) - 1)
    if "range" in field:
        bottom, _, top = str(field["range"]).partition("..")
        return int(bottom, 0), int(top, 0) if top else high
    return low, high
