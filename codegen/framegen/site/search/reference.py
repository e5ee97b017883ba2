"""What can be found of a protocol as a whole: its pages, errata, look-alikes and sources."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.site.escape import anchor
from framegen.site.search.entry import Entry, sentences, spellings
from framegen.site.search.messages import message_entries

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.targets.docs.lookalikes import LookalikeEntry
    from framegen.targets.docs.reference import ReferenceView, ReservedView


def reference_entries(reference: ReferenceView, folder: str) -> Iterator[Entry]:
    """Yield every entry of a reference below `folder`, which ends with a slash."""
    yield from message_entries(reference, folder)
    yield from _pages(reference, folder)
    yield from _errata(reference, folder)
    for other in reference.lookalikes:
        yield from _lookalike(reference, other, folder)
    for reserved in reference.reserved:
        yield _reserved(reference, reserved, folder)
    yield from _facts(reference, folder)


def _pages(reference: ReferenceView, folder: str) -> Iterator[Entry]:
    said = {
        "index": [
            *reference.description,
            *(note.text for note in reference.notes),
            f"{reference.link}, {reference.byte_order}-endian",
            *(board.text for board in reference.hid_boards),
        ],
        "stream": [
            reference.stream.gist,
            *(rule.gist + rule.rest for rule in reference.stream.rules),
        ],
        "sequences": [drawing.caption for drawing in reference.drawings],
    }
    for page in reference.pages:
        yield Entry(
            "page",
            page.title,
            f"{folder}{page.html}",
            "Reference",
            sentences(page.about, *said.get(page.name, [])),
            reference.protocol.name,
            names=(page.label, reference.protocol.name) if page.name == "index" else (page.label,),
        )
    for example in reference.stream_examples:
        yield Entry(
            "page",
            example.title,
            f"{folder}stream.html#{example.id}",
            "How the stream is decoded",
            example.text,
            reference.protocol.name,
        )


def _errata(reference: ReferenceView, folder: str) -> Iterator[Entry]:
    for erratum in reference.errata:
        yield Entry(
            "erratum",
            erratum.title,
            f"{folder}errata.html#erratum-{erratum.number}",
            f"Erratum {erratum.number}, {erratum.message}",
            sentences(erratum.here, erratum.why, f"{erratum.cite.text}, {erratum.concern}"),
            reference.protocol.name,
            names=(f"erratum {erratum.number}",),
        )
    for unknown in reference.unknowns:
        question, _, rest = unknown.what.partition(". ")
        yield Entry(
            "erratum",
            question.rstrip("."),
            f"{folder}errata.html#unknown-{unknown.number}",
            f"Not known of {unknown.message} {unknown.concern}".rstrip(),
            rest,
            reference.protocol.name,
        )


def _lookalike(reference: ReferenceView, other: LookalikeEntry, folder: str) -> Iterator[Entry]:
    path = f"{folder}lookalikes.html#lookalike-{other.key}"
    name = reference.protocol.name
    about = sentences(*other.about, *(f"{each.name}: {each.text}" for each in other.checksums))
    yield Entry("lookalike", other.title, path, "Look-alike", about, name, names=(other.key,))
    for command in other.commands:
        title = f"{command.there[:1].upper()}{command.there[1:]}"
        where = f"Command {command.id} of {other.title}"
        yield Entry("lookalike", title, path, where, "", name, spellings(command.id))
    for frame in other.frames:
        where = f"Frame of {other.title}"
        yield Entry("frame", frame.title, path, where, "", name, hex=frame.hex)


def _reserved(reference: ReferenceView, reserved: ReservedView, folder: str) -> Entry:
    said = reserved.said
    number = None if said.id is None else said.id.one
    what = "" if said.id is None else str(said.id)
    return Entry(
        "lookalike",
        said.why.rstrip("."),
        f"{folder}index.html#reserved",
        ", ".join(
            part for part in (f"Reserved {what}".rstrip(), said.name or "", reserved.way) if part
        ),
        "",
        reference.protocol.name,
        names=() if number is None else spellings(number),
    )


def _facts(reference: ReferenceView, folder: str) -> Iterator[Entry]:
    """Yield the parts of frames, the ends of the line, the sources, and the versions."""
    name, page = reference.protocol.name, f"{folder}index.html"
    for envelope in reference.envelopes:
        for part in envelope.parts:
            where = f"Part of {envelope.what}"
            yield Entry("field", part.name, f"{page}#frame", where, part.text, name)
        address = envelope.envelope.address
        if address is None:
            continue
        for key, value in address.field.values.items():
            where = f"{value.value} in {address.name} of {envelope.what}"
            names = spellings(value.value)
            yield Entry("value", key, f"{page}#frame", where, sentences(value.about), name, names)
    for end in reference.endpoints:
        about = sentences(end.about, *(note.text for note in end.notes))
        yield Entry("page", end.name, page, "End of the line", about, name)
    for key, source in reference.sources.items():
        about = sentences(source.title, source.about)
        yield Entry("page", key, f"{page}#source-{key}", f"Source, {source.kind}", about, name)
    for release in reference.releases:
        yield Entry(
            "page",
            f"Version {release.version}",
            f"{folder}changelog.html#v{anchor(release.version)}",
            "Changes",
            sentences(*release.changes),
            name,
            names=(release.version,),
        )
