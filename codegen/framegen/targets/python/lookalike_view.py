"""What the templates show of the look-alikes: where the parts of their frames stand."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framegen.language.spec import BodyPart, ChecksumPart, ConstantPart, IdPart, LengthPart
from framegen.model.envelope import part_size
from framegen.targets.python.escape import Bracketed, Part, Text

if TYPE_CHECKING:
    from collections.abc import Iterable

    from framegen.language.spec import FramePart, Lookalike, Spec

_Place = tuple[int, int]


@dataclass(frozen=True, slots=True)
class LookalikeView:
    """A look-alike, with the frame that it has of its own, or else that of the protocol."""

    lookalike: Lookalike
    spec: Spec

    @property
    def frame(self) -> dict[str, FramePart]:
        return self.spec.frame if self.lookalike.frame is None else self.lookalike.frame

    @property
    def entry(self) -> Bracketed:
        """The call that describes it."""
        places = self._places()
        counted = next(part.counts for part in self.frame.values() if isinstance(part, LengthPart))
        sizes = {name: part_size(part) for name, part in self.frame.items()}
        uncounted = sum(size for name, size in sizes.items() if name not in counted)
        commands = [str(code) for code in sorted(self.lookalike.commands)]
        described: list[Part] = [
            Bracketed("constants=(", self._constants(places), ")", lone=","),
            f"length={_slice(places[self._only(LengthPart)])}",
            f"uncounted={uncounted}",
            f"least={sum(sizes.values())}",
            f"command={_slice(places[self._only(IdPart)])}",
            Bracketed("commands=(", commands, ")", lone=","),
            Bracketed("checksums=(", self._checksums(places), ")", lone=","),
        ]
        items = [Text(self.lookalike.title), *described]
        return Bracketed("Lookalike(", items, ")")

    def _only(self, kind: type[FramePart]) -> str:
        return next(name for name, part in self.frame.items() if isinstance(part, kind))

    def _places(self) -> dict[str, _Place]:
        """Where each part begins and ends: from the front, and behind the body from the end."""
        places: dict[str, _Place] = {}
        at = 0
        for name, part in self.frame.items():
            if isinstance(part, BodyPart):
                rest = list(self.frame)[list(self.frame).index(name) + 1 :]
                end = -sum(part_size(self.frame[each]) for each in rest)
                places[name] = (at, end)
                at = end
            else:
                places[name] = (at, at + part_size(part))
                at += part_size(part)
        return places

    def _constants(self, places: dict[str, _Place]) -> list[Bracketed]:
        return [
            Bracketed("(", [_slice(places[name]), byte_literal(part.bytes_)], ")")
            for name, part in self.frame.items()
            if isinstance(part, ConstantPart)
        ]

    def _checksums(self, places: dict[str, _Place]) -> list[Bracketed]:
        return [
            Bracketed(
                "(",
                [
                    _slice(places[name]),
                    Bracketed(
                        "(",
                        [_slice(each) for each in _joined(places[each] for each in part.covers)],
                        ")",
                        lone=",",
                    ),
                ],
                ")",
            )
            for name, part in self.frame.items()
            if isinstance(part, ChecksumPart)
        ]


def _joined(places: Iterable[_Place]) -> list[_Place]:
    """The places, those that follow each other as one."""
    joined: list[_Place] = []
    for start, end in places:
        if joined and joined[-1][1] == start != 0:
            joined[-1] = (joined[-1][0], end)
        else:
            joined.append((start, end))
    return joined


def _slice(place: _Place) -> str:
    """A place as code; 0 for an end is the end of the frame."""
    start, end = place
    return f"slice({start}, {end or None})"


def byte_literal(data: bytes) -> str:
    """Bytes as a literal, each as an escape."""
    return 'b"' + "".join(f"\\x{byte:02x}" for byte in data) + '"'
