"""A second opinion: a judge of editions, whose libraries talk, and who knows the author's map.

It shares no code with framegen's comparison. What an end makes of a frame is what the library of
its edition makes of it; who is who, the author has told.
"""

import warnings
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from types import ModuleType
from typing import Any

from framegen.language.values import Direction
from framegen.model.layout import MessageLayout

from tests.contract.comparison.quantities import judge_numbers, said_again
from tests.factories import Data
from tests.mutations.authors import parts_of
from tests.mutations.mutations import Editions
from tests.mutations.things import (
    Match,
    arguments_of,
    match_bits,
    match_fields,
    match_messages,
    worked_out,
)
from tests.protocols.libraries import direction_of, made_of, values_in

ORDER = ("same", "in part", "uncertain", "refused", "misread")


@dataclass(frozen=True, slots=True)
class Judgement:
    """What becomes of a frame, whether something is lost by it, and as what it is read."""

    outcome: str
    breaks: bool
    message: str = ""
    values: Mapping[str, Any] | None = None
    reason: str = ""


@dataclass(frozen=True, eq=False)
class Oracle:
    """One end of a line with the library `ours`, and another with the library `theirs`.

    `editions` are turned so that the sender has the old one; `sender` says which it really is.
    """

    editions: Editions
    ours: ModuleType
    theirs: ModuleType
    sender: str

    @cached_property
    def messages(self) -> Match:
        return match_messages(self.editions)

    def way(self, direction: Direction) -> Any:
        ends = self.ends
        sender, receiver = ends.get(direction.sender), ends.get(direction.receiver)
        if sender is None or receiver is None:
            return None
        return type(direction)(sender, receiver)

    @cached_property
    def _found(self) -> dict[Any, Any]:
        return {}

    def _matched(self, before: Data, after: Data, key: str = "") -> Match:
        """Match fields, or with a `key` named values or bits; each once."""
        asked = id(before), id(after)
        if asked not in self._found:
            match = match_bits(before, after, key) if key else match_fields(before, after)
            # What is kept here keeps its id.
            self._found[asked] = match, before, after
        found: tuple[Match, Data, Data] = self._found[asked]
        return found[0]

    @cached_property
    def ends(self) -> Mapping[str, str]:
        return self.editions.author.ends.to_new

    def judge(self, layout: MessageLayout, values: Mapping[str, Any]) -> Judgement:
        """Encode a message with the one library, and judge what the other makes of it."""
        data = self.encoded(self.ours, layout, values)
        assert data is not None
        way = self.way(layout.direction)
        if way is None:
            return Judgement("refused", self._lost(layout, values))
        return self.judge_data(layout, values, data, way)

    def judge_data(
        self, layout: MessageLayout, values: Mapping[str, Any], data: bytes, way: Direction
    ) -> Judgement:
        events = self.heard(way, data)
        said = [event for event in events if isinstance(event, self.theirs.Message)]
        if not said:
            reason = "no message goes this way"
            if self._has_any(way):
                reason = events[0].reason.value if events else ""
            return Judgement("refused", self._lost(layout, values), reason=reason)
        name = type(said[0]).__name__
        if len(events) > 1 or name != self.messages.to_new.get(layout.name):
            return Judgement("misread", True, ", ".join(type(each).__name__ for each in said))
        other = self.editions.new.model.messages[name]
        read = values_in(other, said[0])
        outcomes = [*self._compared(layout.name, name, values, read)]
        if layout.name in self.messages.guessed:
            outcomes.append(("uncertain", True))
        worst = max((each for each, _ in outcomes), key=ORDER.index, default="same")
        return Judgement(worst, any(breaks for _, breaks in outcomes), name, read)

    def _has_any(self, way: Direction) -> bool:
        """Tell whether the receiver has any message that goes this way."""
        name = f"{way.sender}_to_{way.receiver}".upper()
        return any(each.DIRECTION.name == name for each in self.theirs.MESSAGES)

    def heard(self, way: Direction, data: bytes) -> list[Any]:
        known = {each.name for each in self.theirs.Direction}
        if f"{way.sender}_to_{way.receiver}".upper() not in known:
            return []
        decoder = self.theirs.StreamDecoder(direction_of(self.theirs, way))
        return [*decoder.feed(data), *decoder.flush()]

    def encoded(
        self, made: ModuleType, layout: MessageLayout, values: Mapping[str, Any]
    ) -> bytes | None:
        """Return the frame of a message, None where the library refuses the values."""
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", DeprecationWarning)
            try:
                data: bytes = made_of(made, layout, dict(values)).encode()
            except (made.EncodeError, TypeError, OverflowError):
                return None
        return data

    # What is lost.

    def _lost(self, layout: MessageLayout, values: Mapping[str, Any]) -> bool:
        """Tell whether a refused frame says what was understood when both had the old edition."""
        if self.sender == "old":
            return True
        name = self.messages.to_new.get(layout.name)
        if name is None:
            return False
        client = next(iter(self.editions.old.spec.endpoints))
        if layout.direction.sender != client:
            return self._was_asked(layout.name, name, values)
        again = self._said_again(layout.name, name, values)
        other = self.editions.new.model.messages[name]
        return again is not None and self.encoded(self.theirs, other, again) is not None

    def _was_asked(self, ours: str, theirs: str, values: Mapping[str, Any]) -> bool:
        """Tell whether the other library has any devices with the address in these values."""
        one, other = (
            next((name for name, each in fields.items() if each.get("is") == "address"), None)
            for fields in self._descriptions(ours, theirs)
        )
        if one is None or other is None:
            return True
        layout = self.editions.new.model.messages[theirs]
        example = layout.message.examples[0].values
        return self.encoded(self.theirs, layout, {**example, other: values[one]}) is not None

    def _said_again(
        self, ours: str, theirs: str, values: Mapping[str, Any]
    ) -> dict[str, Any] | None:
        """Return what the other edition would send to say the same; None where it cannot."""
        before, after = self._descriptions(ours, theirs)
        match = self._matched(before, after)
        there = arguments_of(after)
        said: dict[str, Any] = {name: _anything(each) for name, each in there.items()}
        for name, field in arguments_of(before).items():
            other = match.to_new.get(name)
            if other not in there:
                always = after.get(str(other), {}).get("always")
                if always is not None and values[name] != int(str(always), 0):
                    return None
                if values[name] is not None and field.get("optional"):
                    return None
                continue
            again = _again(field, there[other], values[name])
            if again is None and values[name] is not None:
                return None
            said[other] = again
        return said

    def _descriptions(self, ours: str, theirs: str) -> tuple[Data, Data]:
        if (ours, theirs) not in self._found:
            author = self.editions.author
            found = _described(author.old, ours), _described(author.new, theirs)
            self._found[ours, theirs] = found
        before, after = self._found[ours, theirs]
        return before, after

    # What is read.

    def _compared(
        self, ours: str, theirs: str, sent: Mapping[str, Any], read: Mapping[str, Any]
    ) -> Iterator[tuple[str, bool]]:
        before, after = self._descriptions(ours, theirs)
        yield from self._fields(before, after, sent, read)

    def _fields(
        self, before: Data, after: Data, sent: Mapping[str, Any], read: Mapping[str, Any]
    ) -> Iterator[tuple[str, bool]]:
        match = self._matched(before, after)
        ours, theirs = arguments_of(before), arguments_of(after)
        known = {match.to_new[name] for name in ours if match.to_new.get(name) in theirs}
        told, heard = worked_out(before, sent), worked_out(after, read)
        back = {new: old for old, new in match.to_new.items()}
        for name, field in ours.items():
            other = match.to_new.get(name)
            if other in heard:
                yield ("same", False) if sent[name] == heard[other] else ("misread", True)
                continue
            if other not in theirs:
                if sent[name] is not None:
                    yield "in part", self.sender == "old"
                continue
            for outcome in self._values(field, theirs[other], sent[name], read[other]):
                yield outcome if isinstance(outcome, tuple) else (outcome, outcome != "same")
            if name in match.guessed:
                yield "uncertain", True
        for name in theirs:
            if back.get(name) in told:
                yield ("same", False) if told[back[name]] == read[name] else ("misread", True)
            elif name not in known and read[name] is not None:
                yield "in part", self.sender == "new"

    def _values(self, ours: Data, theirs: Data, sent: Any, read: Any) -> Iterator[Any]:
        if sent is None and read is None:
            return
        if sent is None or read is None:
            yield "misread"
        elif isinstance(sent, str) or isinstance(read, str):
            yield "same" if _letters(sent) == _letters(read) else "misread"
        elif isinstance(sent, list) != isinstance(read, list):
            yield "misread"
        elif not isinstance(sent, list):
            yield judge_numbers(ours, theirs, sent, read)
            yield from self._named(ours, theirs, sent, read)
        else:
            yield from self._lists(ours, theirs, sent, read)

    def _lists(self, ours: Data, theirs: Data, sent: list[Any], read: list[Any]) -> Iterator[Any]:
        """Judge lists: elements that are one number each are the numbers."""
        several = zip(sent, read, strict=False)
        one, other = _number_of(ours), _number_of(theirs)
        if len(sent) != len(read):
            yield "misread"
        elif "element" in ours and "element" in theirs:
            for said, heard in several:
                yield from self._fields(ours["fields"], theirs["fields"], said, heard)
        elif one is None or other is None:
            yield "misread"
        else:
            for said, heard in several:
                yield from self._values(one, other, _bare(said), _bare(heard))

    def _named(self, ours: Data, theirs: Data, sent: float, read: float) -> Iterator[str]:
        """Judge a number by the names that it has, and its bits by theirs."""
        values, others = ours.get("values"), theirs.get("values")
        if values and others:
            match = self._matched(values, others, "value")
            for name, other in match.to_new.items():
                is_said = values[name]["value"] == sent
                if is_said != (others[other]["value"] == read):
                    yield "misread"
                elif is_said and name in match.guessed:
                    yield "uncertain"
        bits, others = ours.get("bits"), theirs.get("bits")
        if bits and others:
            match = self._matched(bits, others, "at")
            for name, other in match.to_new.items():
                if _taken(bits[name]["at"], sent) != _taken(others[other]["at"], read):
                    yield "misread"
                elif name in match.guessed:
                    yield "uncertain"


def _described(spec: Data, name: str) -> Data:
    """Return what a spec says of the arguments of a message: address, fields, counter."""
    message = spec["messages"][name]
    parts = parts_of(spec, message)
    around = {
        kind: [(key, each) for key, each in parts.items() if each["is"] == kind]
        for kind in ("address", "counter")
    }
    return dict([*around["address"], *message["fields"].items(), *around["counter"]])


def _number_of(items: Data) -> Data | None:
    """Return what a spec says of the number that each element is; None for other elements."""
    if "element" not in items:
        return None if "text" in items else items
    fields = [*items["fields"].values()]
    return fields[0] if len(fields) == len(arguments_of(items["fields"])) == 1 else None


def _bare(value: Any) -> Any:
    return next(iter(value.values())) if isinstance(value, dict) else value


def _letters(value: Any) -> Any:
    if isinstance(value, str):
        return value.encode("ascii").rstrip(b"\0")
    try:
        return bytes(value).rstrip(b"\0")
    except (TypeError, ValueError):
        return value


def _taken(at: int | str, number: float) -> int:
    low, _, high = str(at).partition("..")
    width = int(high or low) - int(low) + 1
    return int(number) >> int(low) & (1 << width) - 1


def _again(ours: Data, theirs: Data, value: Any) -> Any:
    """Return a value as the other edition says it; None where it cannot."""
    if value is None:
        return None
    if isinstance(value, list):
        one, other = _number_of(ours), _number_of(theirs)
        if "element" in ours and "element" in theirs:
            made = [_again_element(ours, theirs, each) for each in value]
        elif one is None or other is None:
            return None
        else:
            made = [said_again(one, other, _bare(each)) for each in value]
            if "element" in theirs and None not in made:
                made = [dict.fromkeys(theirs["fields"], each) for each in made]
        return None if None in made else made
    return value if isinstance(value, str) else said_again(ours, theirs, value)


def _again_element(ours: Data, theirs: Data, value: Any) -> Any:
    match = match_fields(ours["fields"], theirs["fields"])
    there = arguments_of(theirs["fields"])
    said = {name: _anything(each) for name, each in there.items()}
    for name, field in arguments_of(ours["fields"]).items():
        other = match.to_new.get(name)
        if other in there:
            said[other] = _again(field, there[other], value[name])
    return None if None in said.values() else said


def _anything(field: Data) -> Any:
    """Return some value of a field, the lowest; None for one that may be absent."""
    if field.get("optional"):
        return None
    low = int(str(field["range"]).partition("..")[0], 0) if "range" in field else 0
    if "counted_by" in field or "sized_by" in field or ("count" in field and "text" not in field):
        many = int(str(field.get("count", "0..")).partition("..")[0])
        if "text" in field:
            return " " * many
        if "element" not in field:
            return [low] * many
        inner = arguments_of(field["fields"])
        return [{name: _anything(each) for name, each in inner.items()}] * many
    if "text" in field:
        return ""
    return low
