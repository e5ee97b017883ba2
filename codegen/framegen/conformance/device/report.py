"""The report of a run on a device: a line for each step, and the first failure with its bytes."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from framewire.frame.pluralize import pluralize

from framegen.conformance.device.step import Request
from framegen.conformance.language import fields
from framegen.language.values import to_hex
from framegen.model.codec import values_of
from framegen.model.verdict import weigh

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from framegen.conformance.device.judgement import Judgement
    from framegen.conformance.device.permission import Permission
    from framegen.conformance.device.receiver import Received
    from framegen.conformance.device.session import Transcript
    from framegen.conformance.device.step import Piece, Step
    from framegen.model.model import Model

# A line of bytes is cut from here on, where the whole of it stands in a recording.
_MOST_BYTES = 32


@dataclass(slots=True)
class Result:
    """The result of one step, burst by burst; or why nothing of it was sent."""

    step: Step
    bursts: list[tuple[Transcript, Judgement]] = field(default_factory=list)
    not_sent: str = ""
    notes: list[str] = field(default_factory=list)

    @property
    def has_passed(self) -> bool:
        """Whether there are no faults."""
        return not any(judgement.faults for _, judgement in self.bursts)

    @property
    def said(self) -> list[str]:
        """Remarks on the step: what arrived unsolicited, and what was left out."""
        return [*(note for _, judgement in self.bursts for note in judgement.notes), *self.notes]

    @property
    def faults(self) -> list[str]:
        """The faults of all bursts."""
        return [
            f"{each.kind}: {each.text}" for _, judgement in self.bursts for each in judgement.faults
        ]


@dataclass(slots=True)
class Report:
    """A run: its port, what may be sent, what was tried, and the results."""

    model: Model
    port: str
    baud: int
    permission: Permission
    unsolicited: list[Received] = field(default_factory=list)
    results: list[Result] = field(default_factory=list)
    stopped: str = ""

    @property
    def has_passed(self) -> bool:
        """Whether the device passed every step."""
        tried = any(result.bursts for result in self.results)
        return tried and not self.stopped and all(result.has_passed for result in self.results)


def opening(report: Report, steps: Iterable[Step]) -> Iterator[str]:
    """Yield what is reported before anything is sent."""
    link, permission = report.model.spec.link, report.permission
    frames = f"{link.data_bits}{link.parity[0].upper()}{link.stop_bits}"
    device = report.model.roles.device
    place = f"{report.port}, {report.baud} {frames}"
    if permission.address is not None and permission.device is not None:
        place += f", {permission.address.name} {permission.device}"
    yield f"{report.model.spec.protocol.title}: {device} at {place}"
    yield f"will send: {_names_of(permission.allowed)}"
    pieces = [piece for step in steps for burst in step.bursts for piece in burst]
    for piece in pieces:
        if isinstance(piece, Request) and piece.reply is None:
            yield f"  {piece.text}: {to_hex(piece.frame)}"
    for piece in pieces:
        if not isinstance(piece, Request):
            yield f"  {piece.about}: {to_hex(piece.frame)} ({piece.reason})"
    if permission.refused:
        yield f"will not send: {_names_of(permission.refused)} (--allow NAME sends its examples)"


def unsolicited(report: Report) -> Iterator[str]:
    """Yield what the device sent before anything was sent to it."""
    for received in report.unsolicited:
        yield f"before anything was sent came {_event(report.model, received)}"


def line_of(result: Result) -> Iterator[str]:
    """Yield a line for a step, and further ones for its remarks."""
    if result.not_sent:
        yield f"skipped  {result.step.title}: not sent: {result.not_sent}"
        return
    seconds = [each for _, judgement in result.bursts for each in judgement.seconds]
    took = f" ({', '.join(f'{each:.3f} s' for each in seconds)})" if seconds else ""
    yield f"{'ok  ' if result.has_passed else 'FAIL'}     {result.step.title}{took}"
    yield from (f"         {fault}" for fault in result.faults)
    yield from (f"         note: {note}" for note in result.said)


def closing(report: Report) -> Iterator[str]:
    """Yield the first failed step with its bytes, and the number of failures."""
    failed = [result for result in report.results if not result.has_passed]
    if failed:
        yield ""
        yield f"The first that failed, {failed[0].step.title}:"
        yield from (f"  {line}" for line in _transcribed(report.model, failed[0]))
        yield ""
    tried = [result for result in report.results if not result.not_sent]
    if report.stopped:
        yield f"stopped: {report.stopped}"
    passed = len(tried) - len(failed)
    skipped = len(report.results) - len(tried)
    yield f"{passed} of {pluralize(len(tried), 'step')} passed" + (
        f", {skipped} skipped" if skipped else ""
    )


def _transcribed(model: Model, result: Result) -> Iterator[str]:
    """Yield all traffic of a step, with seconds from its beginning."""
    began = result.bursts[0][0].at
    width = max(len(model.roles.client), len(model.roles.device))
    for transcript, _ in result.bursts:
        lines = [
            (transcript.at, model.roles.client, piece.frame, _sent(piece))
            for piece in transcript.burst
        ]
        lines += [
            (each.at, model.roles.device, each.event.data, _event(model, each))
            for each in transcript.received
        ]
        for at, who, data, what in lines:
            yield f"{at - began:7.3f} s  {who:<{width}}  {_bytes(data)}"
            yield f"{'':{width + 13}}{what}"
        if not transcript.received:
            yield f"{'':11}{model.roles.device:<{width}}  nothing"
    yield from result.faults


def _sent(piece: Piece) -> str:
    return piece.text if isinstance(piece, Request) else f"{piece.about} ({piece.reason})"


def _event(model: Model, received: Received) -> str:
    event = received.event
    if event.message is not None:
        values = values_of(event.message, event.data)
        return " ".join([event.message.name, *fields(event.message, values)])
    if event.kind == "unknown":
        return "a frame of unknown id"
    return f"noise, {weigh(model, [model.roles.received], event.data).refusal}"


def _bytes(data: bytes) -> str:
    if len(data) <= _MOST_BYTES:
        return to_hex(data)
    return f"{to_hex(data[:_MOST_BYTES])} ... ({len(data)} bytes)"


def _names_of(names: Iterable[str]) -> str:
    return ", ".join(names) or "nothing"


def as_json(report: Report) -> dict[str, Any]:
    """Return the whole run, with every byte."""
    model, permission = report.model, report.permission
    return {
        "protocol": model.spec.protocol.name,
        "version": model.spec.protocol.version,
        "device": model.roles.device,
        "port": report.port,
        "baud": report.baud,
        "address": permission.device,
        "will_send": permission.allowed,
        "will_not_send": permission.refused,
        "passed": report.has_passed,
        "stopped": report.stopped or None,
        "unsolicited": [_received_json(model, each) for each in report.unsolicited],
        "steps": [_step_json(model, result) for result in report.results],
    }


def _step_json(model: Model, result: Result) -> dict[str, Any]:
    return {
        "title": result.step.title,
        "malformed": result.step.is_malformed,
        "passed": result.has_passed and not result.not_sent,
        "not_sent": result.not_sent or None,
        "faults": [
            {"kind": each.kind, "text": each.text}
            for _, judgement in result.bursts
            for each in judgement.faults
        ],
        "notes": result.said,
        "bursts": [_burst_json(model, *each) for each in result.bursts],
    }


def _burst_json(model: Model, transcript: Transcript, judgement: Judgement) -> dict[str, Any]:
    return {
        "at": round(transcript.at, 6),
        "sent": [{"hex": to_hex(each.frame), "what": _sent(each)} for each in transcript.burst],
        "received": [_received_json(model, each) for each in transcript.received],
        "reply_seconds": [round(each, 6) for each in judgement.seconds],
    }


def _received_json(model: Model, received: Received) -> dict[str, Any]:
    return {
        "at": round(received.at, 6),
        "kind": received.event.kind,
        "hex": to_hex(received.event.data),
        "what": _event(model, received),
    }
