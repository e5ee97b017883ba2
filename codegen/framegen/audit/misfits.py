"""What does not fit a spec: unknown frames, values outside what is documented, and noise."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

from framewire.explain.lookalikes import recognise

from framegen.model.slots import Constant, Items, Number, Packed

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from framegen.audit.sighting import Reader, Sighting
    from framegen.model.layout import MessageLayout

Kind: TypeAlias = Literal["unknown command", "undocumented value", "noise"]

# Of what does not fit in the same way, so many are shown.
SHOWN = 3


@dataclass
class Misfit:
    """What does not fit in one way: how often, how many bytes, and the first examples.

    `what` tells it from others of its kind. `examples` are places with their bytes, and `why` says
    what was expected at the first.
    """

    kind: Kind
    what: str
    why: str
    times: int = 0
    size: int = 0
    examples: list[tuple[str, bytes]] = field(default_factory=list)

    def add(self, sighting: Sighting) -> None:
        """Count another."""
        self.times += 1
        self.size += len(sighting.data)
        if len(self.examples) < SHOWN:
            self.examples.append((sighting.place, sighting.data))


class Misfits:
    """All that does not fit, grouped one sighting after the other."""

    def __init__(self, reader: Reader) -> None:
        self._reader = reader
        self._found: dict[tuple[str, str], Misfit] = {}

    def add(self, sighting: Sighting) -> None:
        """Group what is no message of the spec."""
        if sighting.undocumented and sighting.message is not None:
            ours = self._reader.model.messages[sighting.message.name]
            for path, why in outside(ours, sighting.message, sighting.values):
                self._add("undocumented value", path, why, sighting)
        elif sighting.message is None:
            verdict = self._reader.verdict(sighting)
            expected = verdict.expected + self._elsewhere(sighting.data)
            likely = self._reader.likely(sighting)
            if sighting.unknown:
                self._add("unknown command", self._id(sighting), expected, sighting)
            elif verdict.reason == sighting.reason:
                self._add(
                    "noise", f"{sighting.reason}{likely and f' in {likely}'}", expected, sighting
                )
            else:
                self._add("noise", sighting.reason, "as it was recorded", sighting)

    @property
    def sorted(self) -> list[Misfit]:
        """The groups, the most serious kind first, and the most frequent first in each."""
        order = ["unknown command", "undocumented value", "noise"]
        return sorted(
            self._found.values(), key=lambda each: (order.index(each.kind), -each.size, each.what)
        )

    def _id(self, sighting: Sighting) -> str:
        sender = sighting.stretch.sender
        ids = ", ".join(f"{name} {value}" for name, value in self._reader.ids(sighting).items())
        return f"{ids} from {sender}" if sender else ids

    def _elsewhere(self, data: bytes) -> str:
        """Say which look-alike has this frame, and what it means there."""
        found = recognise(self._reader.model.protocol, data)
        if found is None:
            return ""
        meaning = f", where it {found.meaning}" if found.meaning else ""
        title = found.lookalike.title.removeprefix("The ")
        return f"; it is a frame of the {title}{meaning}"

    def _add(self, kind: Kind, what: str, why: str, sighting: Sighting) -> None:
        misfit = self._found.get((kind, what))
        if misfit is None:
            misfit = self._found[kind, what] = Misfit(kind, what, why)
        misfit.add(sighting)


def outside(
    ours: MessageLayout, seen: MessageLayout, values: Mapping[str, Any]
) -> Iterator[tuple[str, str]]:
    """Yield the path of each field that says what is not documented, and how.

    `ours` is the message as the spec has it, and `seen` the same without its bounds.
    """
    # A part of the frame may be called like a field.
    slots = {slot.name: slot for slot in (*ours.body, *ours.frame.given)}
    for slot in seen.arguments:
        said, value = slots[slot.name], values[slot.name]
        if value is None:
            continue
        path = f"{ours.name}.{slot.name}"
        match said:
            case Items():
                yield from _in_list(said, path, value)
            case Packed():
                for number in value:
                    if not said.low <= number <= said.high:
                        yield path, f"{number}, outside {said.low}..{said.high}"
                        break
            case Number() | Constant():
                why = _wrong(said, value)
                if why:
                    yield path, why


def _in_list(said: Items, path: str, value: Any) -> Iterator[tuple[str, str]]:
    count = len(value)
    if not said.is_fixed and not said.low <= count <= said.high:
        yield path, f"{count} elements, outside {said.low}..{said.high}"
    for inner in said.slots:
        wrong = [_wrong(inner, item) for item in _numbers(inner.name, value)]
        each = f"{path}.{inner.name}" if said.element else path
        yield from ((each, why) for why in dict.fromkeys(filter(None, wrong)))


def _numbers(name: str, items: Any) -> list[Any]:
    if isinstance(items, str):
        return [ord(each) for each in items]
    return [item.get(name, 0) if isinstance(item, dict) else item for item in items]


def _wrong(said: Any, value: Any) -> str:
    if isinstance(said, Constant):
        if said.role == "reserved" or said.field is None or said.field.always is None:
            return ""
        numbers = value if isinstance(value, list) else [value]
        always = said.field.always
        return "" if all(each == always for each in numbers) else f"{value}, and not {always}"
    if isinstance(said, Number) and not said.holds(value):
        return f"{value}, outside {said.low}..{said.high}"
    return ""
