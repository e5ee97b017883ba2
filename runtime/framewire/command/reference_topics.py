"""What is known besides the messages: errata, unknowns and look-alikes."""

from __future__ import annotations

from .explain import explained

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable

    from ..codec.protocol_codec import ProtocolCodec
    from ..protocol.protocol import Lookalike, Protocol
    from ..protocol.words import Erratum, Unknown
    from .sheet import Sheet


def errata(sheet: Sheet, model: Protocol, _codec: ProtocolCodec) -> None:
    """Print where the documents are wrong, and what they leave open."""
    sheet.heading("Errata")
    if not model.errata:
        sheet.line("No errata are known.")
    for number, erratum in enumerate(model.errata, 1):
        sheet.line()
        erratum_lines(sheet, model, number, erratum)
    if model.unknowns:
        sheet.heading("Not known")
        for unknown in model.unknowns:
            unknown_line(sheet, unknown)


def erratum_lines(sheet: Sheet, model: Protocol, number: int, erratum: Erratum) -> None:
    """Print an erratum."""
    sheet.paragraph(f"{number}. {erratum.title}", 2)
    concerns = ", ".join(filter(None, (erratum.message, erratum.concerns)))
    source, kind = model.source(erratum.cite)
    rows = [
        ("concerns:", concerns),
        ("the document says:", erratum.document),
        ("the bytes say:", erratum.bytes),
        ("here:", erratum.here),
        ("why:", erratum.why),
        ("source:", f"{source} [{kind}]" if kind else source),
    ]
    sheet.columns([(f"   {label}", text) for label, text in rows])


def unknown_line(sheet: Sheet, unknown: Unknown) -> None:
    """Print a question that no source answers."""
    concerns = ", ".join(filter(None, (unknown.message, unknown.concerns)))
    sheet.paragraph(f"{concerns}: {unknown.what}", 2)


def lookalikes(sheet: Sheet, model: Protocol, codec: ProtocolCodec) -> None:
    """Print which protocols are easily taken for this one, and how to tell them."""
    if not model.lookalikes:
        sheet.line("No look-alikes are known.")
    for other in model.lookalikes.values():
        sheet.heading(other.title)
        sheet.paragraph(other.about)
        source, kind = model.source(other.cite)
        sheet.paragraph(f"Source: {source} [{kind}]" if kind else f"Source: {source}")
        _lookalike(sheet, model, other, codec)


def _lookalike(sheet: Sheet, model: Protocol, other: Lookalike, codec: ProtocolCodec) -> None:
    if other.envelope is not None:
        parts = [(slot.name, slot.role) for slot in other.envelope.slots]
        sheet.line()
        sheet.columns([("part", "role"), *parts])
    for example in other.examples:
        sheet.line()
        sheet.paragraph(example.title, 2)
        sheet.paragraph(example.hex, 4)
        refusals = explained(model, bytes.fromhex(example.hex), codec).refusals
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
