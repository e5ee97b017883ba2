"""What can be found of the messages of a protocol: names, ids, fields, values, methods, frames."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.site.search.entry import Entry, sentences, spellings

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.targets.docs.field import FieldView
    from framegen.targets.docs.message import MessagePage
    from framegen.targets.docs.reference import ReferenceView


def message_entries(reference: ReferenceView, folder: str) -> Iterator[Entry]:
    """Yield the entries of every message of a reference below `folder`."""
    for message in reference.messages:
        page = f"{folder}{message.page}.html"
        yield _message(reference, message, page)
        for field in message.fields:
            yield from _field(reference, message, field, page)
        usage = "#usage" if message.snippets and message.said.examples else ""
        for name, call, what in _methods(reference, message):
            yield Entry(
                "method",
                f"{name}()",
                page + usage,
                f"Method for {message.name}",
                sentences(call, what),
                reference.protocol.name,
                names=(name,),
            )
        for example in message.examples:
            yield Entry(
                "frame",
                example.title,
                f"{page}#example-{example.number}",
                f"Documented frame of {message.name}",
                protocol=reference.protocol.name,
                hex=example.hex,
            )


def _message(reference: ReferenceView, message: MessagePage, page: str) -> Entry:
    said = message.said
    ids = [word for each in message.ids for word in spellings(each.number, len(each.hex) // 2 - 1)]
    code = (
        f" {message.hex}"
        if reference.id_name == message.kind
        else f", {reference.id_name} {message.hex}"
    )
    notes = [note.text for note in message.notes]
    return Entry(
        "message",
        message.name,
        page,
        f"{message.kind.capitalize()}{code if message.hex else ''}, {message.direction}",
        sentences(
            said.summary,
            said.description,
            *notes,
            said.deprecated,
            said.vendor_name,
            message.method,
        ),
        reference.protocol.name,
        names=(said.vendor_name, *ids) if said.vendor_name else (*ids,),
    )


def _field(
    reference: ReferenceView, message: MessagePage, field: FieldView, page: str
) -> Iterator[Entry]:
    path = f"{page}#{field.anchor}"
    plain = field.path.replace("[i]", "")
    yield Entry(
        "field",
        field.path,
        path,
        f"Field of {message.name}",
        sentences(
            field.about,
            f"{field.type} {field.range} {field.unit}",
            *field.beside,
            *(note.text for note in field.notes),
        ),
        reference.protocol.name,
        names=(plain, plain.rpartition(".")[2]),
    )
    for value in field.values:
        number = {*spellings(value.value), value.hex.lower()} - {""}
        yield Entry(
            "value",
            value.name,
            f"{page}#{value.anchor}",
            f"{value.value} in {plain} of {message.name}",
            sentences(value.about),
            reference.protocol.name,
            names=(*sorted(number),),
        )
    for bits in field.bits:
        where = f"{bits.at} in {plain} of {message.name}"
        about = sentences(bits.about)
        yield Entry("value", bits.name, path, where, about, reference.protocol.name)


def _methods(reference: ReferenceView, message: MessagePage) -> Iterator[tuple[str, str, str]]:
    """Yield the methods of a client that send a message: name, call, and what they do."""
    if message.method:
        method = message.said.method
        result = f" -> {method.result}" if method is not None and method.result else ""
        yield message.method.partition("(")[0], message.method + result, message.said.summary
    pose = reference.model.spec.pose
    if pose is not None and message.name == pose.read:
        yield pose.present, "", "Finds out which are there."
        yield pose.targets, "", "Makes targets of positions that were read."
    if pose is not None and message.name == pose.move:
        yield pose.hold, "", "Commands the positions that it reads."
