"""What is known besides the messages: errata, unknowns and look-alikes."""

from __future__ import annotations

from .explain import explained

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import Any

    from ..codec.protocol_codec import ProtocolCodec
    from ..explain.protocol import Lookalike, Protocol
    from .sheet import Sheet


def errata(sheet: Sheet, model: Protocol, _codec: ProtocolCodec) -> None:
    """Print where the documents are wrong, and what they leave open."""
    sheet.heading("Errata")
    if not model.said["errata"]:
        sheet.line("No errata are known.")
    for number, erratum in enumerate(model.said["errata"], 1):
        sheet.line()
        erratum_lines(sheet, model, number, erratum)
    if model.said["unknowns"]:
        sheet.heading("Not known")
        for unknown in model.said["unknowns"]:
            unknown_line(sheet, unknown)


def erratum_lines(sheet: Sheet, model: Protocol, number: int, erratum: Any) -> None:
    """Print an erratum."""
    sheet.paragraph(f"{number}. {erratum['title']}", 2)
    concerns = ", ".join(filter(None, (erratum["message"], erratum["concerns"])))
    source, kind = model.source(erratum["cite"])
    rows = [
        ("concerns:", concerns),
        ("the document says:", erratum["document"]),
        ("the bytes say:", erratum["bytes"]),
        ("here:", erratum["here"]),
        ("why:", erratum["why"]),
        ("source:", f"{source} [{kind}]" if kind else source),
    ]
    sheet.columns([(f"   {label}", text) for label, text in rows])


def unknown_line(sheet: Sheet, unknown: Any) -> None:
    """Print a question that no source answers."""
    concerns = ", ".join(filter(None, (unknown["message"], unknown["concerns"])))
    sheet.paragraph(f"{concerns}: {unknown['what']}", 2)


def lookalikes(sheet: Sheet, model: Protocol, codec: ProtocolCodec) -> None:
    """Print which protocols are easily taken for this one, and how to tell them."""
    if not model.lookalikes:
        sheet.line("No look-alikes are known.")
    for other in model.lookalikes.values():
        sheet.heading(other.title)
        sheet.paragraph(other.said["about"])
        source, kind = model.source(other.said["cite"])
        sheet.paragraph(f"Source: {source} [{kind}]" if kind else f"Source: {source}")
        _lookalike(sheet, model, other, codec)


def _lookalike(sheet: Sheet, model: Protocol, other: Lookalike, codec: ProtocolCodec) -> None:
    if "frame" in other.said:
        parts = [(slot.name, slot.role) for slot in other.frame.slots]
        sheet.line()
        sheet.columns([("part", "role"), *parts])
    for example in other.said["examples"]:
        sheet.line()
        sheet.paragraph(example["title"], 2)
        sheet.paragraph(example["hex"], 4)
        refusals = explained(model, bytes.fromhex(example["hex"]), codec).refusals
        for refusal in refusals:
            sheet.paragraph(f"{refusal.direction}: {refusal.reason}: {refusal.expected}", 4)
    if other.commands:
        sheet.line()
        here = {
            number: [name for name, each in model.messages.items() if each.ids == (number,)]
            for number in other.commands
        }
        name = "id" if model.frame.id is None else model.frame.id.name
        sheet.columns(
            [
                (name, "there it", "here it is"),
                *(
                    (str(number), meaning, ", ".join(here[number]) or "unknown")
                    for number, meaning in other.commands.items()
                ),
            ]
        )


TOPICS: dict[str, Callable[[Sheet, Protocol, ProtocolCodec], None]] = {
    "errata": errata,
    "lookalikes": lookalikes,
}
