"""Judgement of a device's answers: by the reference, against what was requested."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Literal, TypeAlias

from framewire.explain.refusals import TOO_SHORT
from framewire.frame.pluralize import pluralize

from framegen.conformance.device.step import Malformed, data_of, excess, requests_of
from framegen.conformance.language import fields
from framegen.language.values import to_hex
from framegen.model.codec import values_of
from framegen.model.verdict import weigh

if TYPE_CHECKING:
    from collections.abc import Iterable

    from framegen.conformance.device.receiver import Received
    from framegen.conformance.device.session import Transcript
    from framegen.conformance.device.step import Request
    from framegen.model.model import Model

# What is a fault of a device; the words of the report.
FaultKind: TypeAlias = Literal[
    "silence", "no frame", "late reply", "wrong reply", "wrong order", "unsolicited reply"
]
# More bytes of noise than this are not shown in a line.
_SHOWN = 16


@dataclass(frozen=True, slots=True)
class Fault:
    """Something that a device did wrong."""

    kind: FaultKind
    text: str


@dataclass(slots=True)
class Judgement:
    """The faults in an answer, what else arrived, and how long each reply took.

    `has_echo` says that the line returned what was sent.
    """

    faults: list[Fault] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    seconds: list[float] = field(default_factory=list)
    has_echo: bool = False


def judge(model: Model, transcript: Transcript) -> Judgement:
    """Judge the answer to one burst."""
    return _Judge(model, transcript).judged()


def judge_reports(model: Model, transcript: Transcript, seconds: float) -> Judgement:
    """Judge what a device sends that nobody asks."""
    found, counted = Judgement(), Counter[str]()
    events = [each.event for each in transcript.received]
    # The last frame may not be over.
    if events and events[-1].reason == TOO_SHORT:
        events.pop()
    for event in events:
        if event.message is not None:
            counted[event.message.name] += 1
        elif event.kind == "unknown":
            found.notes.append(f"unknown frame: {_shown(event.data)}")
        elif counted:
            refusal = weigh(model, [model.roles.received], event.data).refusal
            what = f"{_shown(event.data)} came between frames: {refusal}"
            found.faults.append(Fault("no frame", what))
        else:
            found.notes.append(f"before the first frame: {_shown(event.data)}")
    if not counted:
        kind: FaultKind = "no frame" if events else "silence"
        found.faults.append(Fault(kind, f"no report within {seconds:g} s"))
    found.notes += [f"{name} came {pluralize(times, 'time')}" for name, times in counted.items()]
    return found


def _shown(data: bytes) -> str:
    dots = " ..." if len(data) > _SHOWN else ""
    return f"{pluralize(len(data), 'byte')}, {to_hex(data[:_SHOWN])}{dots}"


class _Judge:
    """One pass through a transcript, event by event."""

    def __init__(self, model: Model, transcript: Transcript) -> None:
        self.model = model
        self.transcript = transcript
        self.found = Judgement()
        requests = requests_of(transcript.burst)
        self.queries = [each for each in requests if each.reply is not None]
        limits = zip(requests, transcript.limits, strict=True)
        self.pending = [(each, limit) for each, limit in limits if each.reply is not None]
        # The request that was answered last, of those that have been answered.
        self.latest: Request | None = None
        self.noise: list[Received] = []
        self.reported: set[str] = set()

    def judged(self) -> Judgement:
        """Judge what arrived, in its order, then what did not arrive."""
        for received in self.transcript.received:
            message = received.event.message
            if message is None:
                self._noise(received)
            elif self.model.kind(message.name) == "reply" or message.name in self.model.refuses:
                self._reply(received)
            else:
                self.reported.add(message.name)
                self.found.notes.append(f"report: {message.name} after {self._after(received)}")
        for request, limit in self.pending:
            self._missing(request, limit)
        for request in requests_of(self.transcript.burst):
            acknowledged = request.exchange.acknowledged
            if acknowledged is not None and acknowledged not in self.reported:
                self.found.notes.append(f"no {acknowledged} came for {request.message.name}")
        return self.found

    def _after(self, received: Received) -> str:
        return f"{received.at - self.transcript.at:.3f} s"

    def _reply(self, received: Received) -> None:
        message = received.event.message
        due = [index for index, (each, _) in enumerate(self.pending) if message in each.answers]
        if message is None or not due:
            self._unsolicited(received)
            return
        values = values_of(message, received.event.data)
        fitting = [at for at in due if self.pending[at][0].answered_by(message, values)]
        index = (fitting or due)[0]
        request, limit = self.pending.pop(index)
        seconds = received.at - self.transcript.at
        self.found.seconds.append(seconds)
        if not fitting:
            self._wrong(request, received)
        self._in_order(request, message.name)
        if seconds > limit:
            took = f"{message.name} came after {seconds:.3f} s, and was due within {limit:.3f} s"
            self._fault("late reply", took)
        self._refused(request, received)
        self._left_out(request, received)

    def _in_order(self, request: Request, name: str) -> None:
        latest = self.latest
        if latest is not None and self._place(request) < self._place(latest):
            later = latest.message.name
            self._fault(
                "wrong order", f"{name} came after the reply to {later}, which was requested later"
            )
        else:
            self.latest = request

    def _place(self, request: Request) -> int:
        return next(at for at, each in enumerate(self.queries) if each is request)

    def _wrong(self, request: Request, received: Received) -> None:
        message = received.event.message
        if message is None:
            return
        values = values_of(message, received.event.data)
        other, part = request.other_device(message, values), request.exchange.address
        if other is not None and part is not None:
            asked = f"{message.name} comes from {part.name} {other}"
            what = f"{asked}, and {request.values[part.name]} was asked"
            self._fault("wrong reply", what)
            return
        for requested, reported in request.exchange.echoed:
            beyond = excess(request, requested, reported, values)
            if beyond:
                these = ", ".join(map(str, beyond[:_SHOWN]))
                what = f"{message.name} reports {reported} {these}, which was not requested"
                self._fault("wrong reply", what)
        counted = request.exchange.counted
        if counted is not None and request.exchange.miscounts(request.values, values):
            held, wanted = len(values[counted.name]), request.exchange.asked(request.values)
            what = f"{message.name} holds {held} {counted.name}, and {wanted} were asked for"
            self._fault("wrong reply", what)

    def _refused(self, request: Request, received: Received) -> None:
        """Note what a device does not do, which it says in a reply of the right form."""
        message = received.event.message
        if message is None:
            return
        values = values_of(message, received.event.data)
        if message != request.reply:
            said = " ".join([message.name, *fields(message, values)])
            self.found.notes.append(f"{request.message.name} is refused: {said}")
        elif (failure := request.exchange.failure) and request.exchange.has_failed(values):
            said = f"{failure.name} {values[failure.name]}"
            self.found.notes.append(f"{request.message.name} failed: {said}")

    def _left_out(self, request: Request, received: Received) -> None:
        """Note how much of the request a reply omits, which is allowed."""
        message = received.event.message
        items = request.message.items
        if message is None or message != request.reply or message.items is None:
            return
        if items is None or not request.exchange.most:
            return
        values = values_of(message, received.event.data)
        reported, requested = len(values[message.items.name]), len(request.values[items.name])
        if reported < requested:
            self.found.notes.append(f"{message.name} reports {reported} of {requested}")

    def _unsolicited(self, received: Received) -> None:
        message = received.event.message
        if message is None:
            return
        what = f"{message.name} came once more than it was requested"
        if not any(message in each.answers for each in self.queries):
            what = f"{message.name} came unsolicited"
        if any(isinstance(piece, Malformed) for piece in self.transcript.burst):
            what += ": does it answer what is no frame?"
        self._fault("unsolicited reply", what)

    def _noise(self, received: Received) -> None:
        event = received.event
        data = event.data
        sent = data_of(self.transcript.burst)
        if data.startswith(sent):
            self.found.has_echo = True
            self.found.notes.append("the line gives back what is sent")
            return
        self.noise.append(received)
        kind = "unknown frame" if event.kind == "unknown" else f"noise, {event.reason}"
        self.found.notes.append(f"{kind}: {_shown(data)}")

    def _missing(self, request: Request, limit: float) -> None:
        name = "" if request.reply is None else request.reply.name
        broken = self._broken(self.noise)
        waited = f"no {name} within {limit:.3f} s"
        if broken:
            self._fault("no frame", f"{waited}; what came is none: {broken}")
        elif self.noise:
            size = sum(len(each.event.data) for each in self.noise)
            problem = f"{pluralize(size, 'byte')} came without any header: is the baud rate right?"
            self._fault("silence", f"{waited}; {problem}")
        else:
            self._fault("silence", waited)

    def _broken(self, noise: Iterable[Received]) -> str:
        """Return why the first noise with a header is no frame; empty without such noise."""
        way = [self.model.roles.received]
        frames = [each.frame for each in self.model.candidates(way)]
        for each in noise:
            data = each.event.data
            if each.event.kind == "noise":
                for at in range(len(data)):
                    if any(frame.begins(data[at:]) for frame in frames):
                        return weigh(self.model, way, data[at:]).refusal
        return ""

    def _fault(self, kind: FaultKind, text: str) -> None:
        self.found.faults.append(Fault(kind, text))
