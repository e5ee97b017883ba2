"""Sequence diagrams: who sends what to whom, and in which order, as SVG coordinates."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from framegen.language.values import Direction
    from framegen.model.model import Model

_WIDTH = 360
_MARGIN = 48
_TOP, _STEP, _BOTTOM = 46, 40, 16
_HEAD = 7


@dataclass(frozen=True, slots=True)
class Arrow:
    """One message on its way; `due` is a request, or the reply that it is due."""

    message: str
    note: str
    start: int
    end: int
    y: int
    due: bool

    @property
    def head(self) -> str:
        """The corners of the arrow head."""
        back = self.end + (-_HEAD if self.end > self.start else _HEAD)
        return f"{self.end},{self.y} {back},{self.y - 4} {back},{self.y + 4}"

    @property
    def middle(self) -> int:
        """The centre of the label."""
        return (self.start + self.end) // 2


@dataclass(frozen=True, slots=True)
class Lifeline:
    """One endpoint, as a line down the picture."""

    name: str
    x: int


@dataclass(frozen=True, slots=True)
class Drawing:
    """One sequence; `caption` says in words what the picture shows."""

    id: str
    title: str
    caption: str
    lifelines: list[Lifeline]
    arrows: list[Arrow]

    @property
    def width(self) -> int:
        """The width of the picture, in its own units."""
        return _WIDTH

    @property
    def height(self) -> int:
        """The height of the picture, in its own units."""
        return _TOP + _STEP * len(self.arrows) + _BOTTOM


def drawing(model: Model, name: str) -> Drawing | None:
    """Draw what follows a message; None for a reply or a report."""
    message = model.messages[name]
    kind = model.kind(name)
    if kind not in ("query", "command"):
        return None
    steps = [(name, "", True)]
    if message.message.reply is not None:
        steps.append((message.message.reply, "reply", True))
    if message.message.refusal is not None:
        steps.append((message.message.refusal, "or its refusal", False))
    steps += [(report, "may follow", False) for report in message.message.reports]
    return _drawn(model, name, steps, _caption(model, name))


def interruption(model: Model) -> Drawing | None:
    """Draw a report that comes between a request and its reply, where the protocol has both."""
    reports = {name: message for name, message in model.messages.items() if _is_report(model, name)}
    for name, message in model.messages.items():
        reply = message.message.reply
        if reply is None:
            continue
        way = model.messages[reply].direction
        arriving = [report for report, sent in reports.items() if sent.direction == way]
        if arriving:
            report, *others = arriving
            steps = [(name, "", True), (report, "report", False), (reply, "reply", True)]
            caption = (
                f"{report}{', like any other report,' if others else ''} may arrive at any time, "
                f"also between {name} and {reply}: whoever waits for {reply} must look at what "
                "arrived, not only that something did."
            )
            return _drawn(model, "interruption", steps, caption)
    return None


def _is_report(model: Model, name: str) -> bool:
    return model.kind(name) == "report" and name not in model.refuses


def _caption(model: Model, name: str) -> str:
    message = model.messages[name].message
    sender, receiver = message.direction.sender, message.direction.receiver
    if message.reply is not None:
        return f"{_question(model, name)}{_refusal(model, name)}"
    acknowledged = message.acknowledged
    known = "" if acknowledged is None else f" {acknowledged} says that {name} was taken."
    if message.lasts is not None:
        known = f" What it starts goes on for {message.lasts}; nothing says when it is over."
    if message.reports:
        listed = ", then perhaps ".join(message.reports)
        may = f"sooner or later the {receiver} may report {listed}."
        return f"The {sender} sends {name}; {may}{known}"
    silent = "Nothing that comes back tells whether it was understood."
    return f"The {sender} sends {name}. {silent}{known}"


def _question(model: Model, name: str) -> str:
    message = model.messages[name].message
    sender, receiver = message.direction.sender, message.direction.receiver
    asked = f"The {sender} sends {name}; the {receiver} answers with {message.reply}."
    address = model.messages[name].frame.address
    if address is None or not address.silent:
        return asked
    silent = " or ".join(map(str, sorted(address.silent)))
    return f"{asked} Nobody answers at {address.name} {silent}."


def _refusal(model: Model, name: str) -> str:
    """Say how the reply shows that it was not done."""
    message = model.messages[name].message
    reply = model.messages[message.reply or name].message
    found = f" If it refuses, {message.refusal} comes instead." if message.refusal else ""
    if reply.failure:
        field, good = reply.failure.field, reply.failure.good
        found += f" Where {field} in {message.reply} is not {good}, it has failed."
    return found


def _drawn(model: Model, id_: str, steps: list[tuple[str, str, bool]], caption: str) -> Drawing:
    ways = [model.messages[name].direction for name, _, _ in steps]
    at = _places(ways)
    arrows = [
        Arrow(name, note, at[way.sender], at[way.receiver], _TOP + _STEP * index + 24, due)
        for index, ((name, note, due), way) in enumerate(zip(steps, ways, strict=True))
    ]
    lines = [Lifeline(name, x) for name, x in at.items()]
    title = "A report between request and reply" if id_ == "interruption" else id_
    return Drawing(f"sequence-{id_}", title, caption, lines, arrows)


def _places(ways: list[Direction]) -> dict[str, int]:
    names = list(dict.fromkeys(end for way in ways for end in (way.sender, way.receiver)))
    between = (_WIDTH - 2 * _MARGIN) // max(1, len(names) - 1)
    return {name: _MARGIN + between * index for index, name in enumerate(names)}
