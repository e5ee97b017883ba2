"""The rules by which a stream is decoded, as far as a protocol needs them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framewire.explain.words import listed

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.model.envelope import Envelope
    from framegen.model.model import Model


@dataclass(frozen=True, slots=True)
class Rule:
    """A rule: its gist, and the rest of it, which may go on with its sentence."""

    gist: str
    text: str

    @property
    def rest(self) -> str:
        """The text as it follows the gist."""
        return self.text if self.gist[-1] != "." else f" {self.text}"


_COSTS_A_BYTE = """The search goes on at the next byte, so that the frame behind it is found."""
_SILENCE = Rule(
    "Silence decides.",
    "The decoder waits for the rest of a frame; when the line has gone quiet, it is flushed, and "
    "searches the bytes that it held back.",
)
_NOTHING_LOST = Rule(
    "Nothing is lost.",
    "The bytes of all messages and all noise, in order, are the bytes that came.",
)
_BORROWED = (
    "Where values may be anything, a frame that lost bytes on the way can borrow them from the "
    "frame behind it, and still agree with itself. A reading that makes no sense is worth asking "
    "for again."
)


@dataclass(frozen=True)
class StreamRules:
    """How a stream of a protocol is decoded."""

    model: Model

    @property
    def gist(self) -> str:
        """What there is to believe a frame by, without the full stop."""
        start = "header" if self._has_headers else "start of a frame"
        if self.proven:
            sums = [part.name for frame in self._envelopes for part in frame.checksums]
            named = listed([*dict.fromkeys(sums)])
            return f"A {start} is believed only while everything after it agrees, the {named} last"
        none = not any(frame.proven for frame in self._envelopes)
        sums_there = "There is no checksum" if none else "Not every frame has a checksum"
        return f"{sums_there}. A {start} is believed only while everything after it agrees"

    @property
    def start(self) -> str:
        """What a frame begins with, as it is called when it is refused."""
        return "header" if self._has_headers else "start"

    @property
    def proven(self) -> bool:
        """Whether every frame proves by a checksum that it is one."""
        return all(frame.proven for frame in self._envelopes)

    @property
    def rules(self) -> list[Rule]:
        """The rules, in the order in which they are applied."""
        return [*self._rules()]

    @property
    def limits(self) -> str:
        """What no decoder can see."""
        if not self.proven:
            return _BORROWED
        bits = min(8 * sum(part.size for part in frame.checksums) for frame in self._envelopes)
        return (
            f"A checksum of {bits} bits agrees by chance with one of {1 << bits} damaged frames. A "
            "reading that makes no sense is worth asking for again."
        )

    @property
    def _envelopes(self) -> list[Envelope]:
        return [*self.model.envelopes.values()]

    @property
    def _has_headers(self) -> bool:
        return all(frame.header for frame in self._envelopes)

    def _rules(self) -> Iterator[Rule]:
        if not self._has_headers:
            yield self._beginnings()
        yield Rule("Early refusal.", self._early())
        sized = [frame.length.name for frame in self._envelopes if frame.length_part is not None]
        never = f", never the {sized[0]} that it claimed. " if sized else ". "
        yield Rule(f"A refused {self.start} costs one byte", never + _COSTS_A_BYTE)
        yield from self._unknown()
        yield _SILENCE
        yield _NOTHING_LOST

    def _beginnings(self) -> Rule:
        """Say where to look for frames that begin with no constant."""
        names = [frame.slots[0].name for frame in self._envelopes if not frame.header]
        return Rule(
            "Every byte may begin a frame",
            f" that can be its {' or '.join(dict.fromkeys(names))}: nothing else shows where one "
            "begins.",
        )

    def _early(self) -> str:
        """Say what is refused before the whole of a frame is there."""
        frame = self._envelopes[0]
        usual = all(
            each.length_part is not None and each.id_part is not None for each in self._envelopes
        )
        if usual and frame.address is None and not self.proven and len(frame.ids) == 1:
            length, id_ = frame.length.name, frame.id.name
            return (
                f"After the header, a {length} that no frame can have is refused at once; then one "
                f"that this {id_} cannot have; then a count that disagrees with the {length}."
            )
        ids = [
            part.name for each in self._envelopes for part in each.ids if part not in each.unsent
        ]
        parts = [
            *(f"the {each.address.name} of no device" for each in self._envelopes if each.address),
            *(
                f"a {each.length.name} that no frame has"
                for each in self._envelopes
                if each.length_part
            ),
            *(f"a {name} that no message has" for name in ids),
            "a value that is out of range",
        ]
        last = " The checksum is the last test." if self.proven else ""
        named = listed([*dict.fromkeys(parts)], "or")
        return f"What no frame can have is refused as soon as it is there: {named}.{last}"

    def _unknown(self) -> Iterator[Rule]:
        """Say what becomes of frames of unknown ids."""
        for frame in self._envelopes:
            if frame.id_part is None:
                continue
            name, where = frame.id.name, f" in a frame of {frame.name}"
            place = where if len(self._envelopes) > 1 else ""
            if frame.proves_unknown:
                yield Rule(
                    f"An unknown {name}{place} with a right checksum is certain.",
                    "It is reported as an unknown frame, whatever is in it; with a wrong one, it "
                    "costs one byte.",
                )
            elif frame.length_part is None or frame.proven:
                yield Rule(
                    f"An unknown {name}{place} costs one byte.",
                    "Nothing proves where its frame would end.",
                )
            else:
                yield Rule(
                    f"An unknown {name}{place} is shown, not trusted.",
                    "If nothing in it turns out to be a frame, it is reported as an unknown frame; "
                    "otherwise the frame in it wins.",
                )
