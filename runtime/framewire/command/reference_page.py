"""The reference in the terminal: the list of all messages, and the page of one."""

from __future__ import annotations

from ..explain.explanation import rows_of
from ..explain.pattern import pattern
from ..explain.slot_bytes import legal_length
from ..explain.text import to_hex
from ..explain.words import kind_in_words, listed, order_in_words
from ..frame.pluralize import describe_range, pluralize
from ..protocol.slots import Constant, List, Number, Packed, Text
from .reference_topics import erratum_lines, unknown_line

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from ..protocol.message import Message
    from ..protocol.protocol import Protocol
    from ..protocol.slots import Field
    from ..protocol.words import Example, Note
    from .sheet import Sheet

# Elements of a list in an example that are shown one by one.
_MOST_ROWS = 64
# More bytes of a slot than this are not shown one by one.
_MOST_DOTS = 8


def message_list(
    sheet: Sheet, model: Protocol, messages: Sequence[Message], *, command: str = ""
) -> None:
    """Print a line for each message, those of each direction together.

    `command` is the name of the command where these are all messages: what concerns all of them is
    printed as well.
    """
    if command:
        sheet.heading(model.title)
        sheet.paragraph(model.summary)
        sheet.paragraphs(model.description)
        sheet.paragraphs(_notes(model, model.notes))
    digits = max((len(hexed(each)) for each in messages), default=0)
    numbers = max((3, *(len(numbered(each)) for each in messages)))
    width = max(len(message.name) for message in messages)
    for direction in model.directions:
        rows = [
            (
                *((f"{numbered(each):>{numbers}}", hexed(each)) if digits else ()),
                f"{each.name:<{width}}",
                _summary(each),
            )
            for each in messages
            if each.direction == direction
        ]
        if rows:
            sheet.heading(direction)
            sheet.columns(rows)
    if command:
        _reserved(sheet, model)
        sheet.line()
        sheet.paragraph(
            f"`{command} docs MESSAGE` prints the page of one, `{command} docs WORD` lists those "
            f"that speak of something, `{command} docs errata` and `{command} docs lookalikes` "
            f"say what else is known."
        )


def numbered(message: Message) -> str:
    """Return the ids that a frame of a message holds, in decimal."""
    return ", ".join(map(str, message.seen_ids))


def hexed(message: Message) -> str:
    """Return the ids that a frame of a message holds, in hex."""
    ids = zip(message.envelope.ids, message.seen_ids, strict=True)
    return " ".join(f"0x{number:0{2 * part.size}X}" for part, number in ids)


def _reserved(sheet: Sheet, model: Protocol) -> None:
    """Print which ids and names must not be used."""
    if model.reserved:
        sheet.heading("Reserved")
    for each in model.reserved:
        number = "" if each.id is None else str(each.id)
        what = filter(None, (number, each.name, each.direction))
        sheet.paragraph(f"{', '.join(what)}: {each.why}", 2)


def _summary(message: Message) -> str:
    return f"{'Deprecated. ' if message.deprecated else ''}{message.summary}"


def message_page(sheet: Sheet, model: Protocol, message: Message) -> None:
    """Print all that is known of a message."""
    sheet.heading(message.name)
    sheet.paragraph(message.summary)
    if message.deprecated:
        sheet.paragraph(f"Deprecated: {message.deprecated}", colour="yellow")
    sheet.heading("Bytes")
    sheet.columns([("byte", "hex", "part", "value"), *_pattern(message)])
    sheet.heading("Fields")
    _fields(sheet, model, message)
    sheet.heading("About it")
    _about(sheet, model, message)
    sheet.heading("Examples")
    for number, example in enumerate(message.examples):
        if number:
            sheet.line()
        _example(sheet, model, message, example)
    _slips(sheet, model, message)
    sheet.heading("In Python")
    # What a program calls, where a client has it; the codec behind.
    for line in [*message.client, *[""] * bool(message.client), *message.python]:
        sheet.line(f"  {line}".rstrip())
    sheet.heading("On the command line")
    for line in message.shell:
        sheet.line(f"  {line}")


def _about(sheet: Sheet, model: Protocol, message: Message) -> None:
    """Print what is known of a message as a whole, and of who receives it."""
    sheet.columns([*_facts(model, message)])
    sheet.paragraphs(message.description)
    sheet.paragraphs(_notes(model, message.notes))
    receiver = message.direction.partition(" -> ")[2]
    sheet.paragraphs(_notes(model, model.endpoints[receiver].notes))


def _notes(model: Protocol, notes: Iterable[Note]) -> str:
    """Return what else is known, a paragraph each."""
    return "\n\n".join(f"{note.text} ({_cited(model, note.cite)})" for note in notes)


def _facts(model: Protocol, message: Message) -> Iterator[tuple[str, str]]:
    """Yield what there is to say of a message as a whole."""
    due = message.kind in ("command", "query")
    link, size = model.link, message.largest
    time = f"{1000 * size * link.bits_per_byte / link.baud:.1f} ms at {link.baud} baud"
    yield "direction:", f"{message.direction} ({message.kind})"
    yield from _identity(model, message)
    facts = {
        "vendor's name:": message.vendor_name,
        "goes on for:": message.lasts,
        "asks for as many as:": message.asks_for,
        "reply:": (message.reply or "none is due") if due else "",
        "refused by:": message.refusal,
        f"has failed, unless {message.good}:": message.failure,
        "may lead to:": ", ".join(message.reports),
        "answers:": ", ".join(message.answers),
        "may follow:": ", ".join(message.reports_on),
        "acknowledged by:": message.acknowledged,
        "class:": message.class_name,
        "sent by:": message.method,
        "length rule:": _length_rule(message),
        "largest frame:": f"{pluralize(size, 'byte')}, {time}",
        "since:": message.since and f"version {message.since} of the spec",
        "source:": _cited(model, message.cite),
    }
    yield from ((label, text) for label, text in facts.items() if text)


def _identity(model: Protocol, message: Message) -> Iterator[tuple[str, str]]:
    """Yield the ids of a message, and the name of its frame where there are several."""
    frame = message.envelope
    for part, number in zip((*frame.ids, *frame.unsent), message.ids, strict=True):
        unsent = ", not sent" if part in frame.unsent else ""
        yield f"{part.name}:", f"0x{number:0{2 * part.size}X}, {number} in decimal{unsent}"
    if len(model.envelopes) > 1:
        yield "frame:", frame.name


def _length_rule(message: Message) -> str:
    length = message.envelope.length
    name = "size of the frame" if length is None else length.name
    if message.items is None:
        return f"{name} = {describe_range(message.lengths)}"
    return f"{name} = {message.formula}, so it is {describe_range(message.lengths)}"


def _cited(model: Protocol, cite: str) -> str:
    text, kind = model.source(cite)
    return f"{text} [{kind}]" if kind else text


def _pattern(message: Message) -> Iterator[tuple[str, str, str, str]]:
    """Yield the parts of any frame of the message as a row each; a list is shown once."""
    for part in pattern(message):
        data = _dots(part.size) if part.data is None else to_hex(part.data)
        yield part.place, data, part.path, _joined(part.text, part.order)


def _joined(*words: str) -> str:
    return ", ".join(filter(None, words))


def _dots(size: int) -> str:
    # The ASCII of it: not every console has the dots that pages have.
    if size > _MOST_DOTS:
        return f".. ... .. ({pluralize(size, 'byte')})"
    return " ".join([".."] * size)


def _fields(sheet: Sheet, model: Protocol, message: Message) -> None:
    if not message.fields:
        slots = message.envelope.slots
        names = [slot.name for slot in slots if slot.role in ("address", "counter")]
        differ = f"frames differ in their {listed(names)} alone" if names else ""
        sheet.line(f"  None: {differ or 'the frame is always the same'}.")
    for slot in message.fields:
        if not isinstance(slot, List):
            _field(sheet, model, slot, slot.name)
            continue
        many = f"{slot.low} of them" if slot.is_fixed else f"{slot.low}..{slot.high} of them"
        if slot.counter:
            many += f", as {slot.counter} says"
        if slot.element:
            sheet.line(f"  {slot.name}  list of {slot.element}, {many}")
            _said(sheet, model, slot)
            many = ""
        for field in slot.fields:
            _field(sheet, model, field, slot.path("i", field), many)


def _field(
    sheet: Sheet,
    model: Protocol,
    slot: Constant | Number | Text | Packed,
    path: str,
    many: str = "",
) -> None:
    number = slot if isinstance(slot, Number) else None
    absent = "may be absent" if number and number.optional else ""
    unit = slot.unit if isinstance(slot, (Number, Packed)) else ""
    words = (kind_in_words(slot), order_in_words(slot), absent, _values(slot), unit, many)
    sheet.line(f"  {path}  {_joined(*words)}")
    scale = slot.scale if isinstance(slot, (Number, Packed)) else None
    if scale is not None:
        step = f"One step is {scale.step} {scale.unit}".rstrip()
        zero = f", and 0 is {scale.offset} {scale.unit}".rstrip() if scale.offset else ""
        sheet.paragraph(f"{step}{zero}.", 6)
    for name, (low, high, about) in number.bits.items() if number else ():
        at = f"bit {low}" if low == high else f"bits {low}..{high}"
        sheet.paragraph(f"{at}: {name}{', ' if about else ''}{about}", 6)
    _said(sheet, model, slot)


def _values(slot: Constant | Number | Text | Packed) -> str:
    """Return the values that a field may have."""
    if isinstance(slot, Constant):
        data = to_hex(slot.data)
        is_free = slot.role == "reserved"
        return f"written as {data}, read as anything" if is_free else f"always {data}"
    if isinstance(slot, Text):
        return f"up to {slot.size} characters"
    if isinstance(slot, Number) and slot.is_counted:
        return f"as many {'bytes ' if slot.role == 'size' else ''}as there are"
    is_free = isinstance(slot, Number) and slot.is_float
    return "any number" if is_free else f"{slot.low}..{slot.high}"


def _said(sheet: Sheet, model: Protocol, slot: Field) -> None:
    """Print what is written of a field: what it is, its values, limits and notes."""
    sheet.paragraph(slot.about, 6)
    if isinstance(slot, Number):
        for name, value in slot.values.items():
            cited = f" ({_cited(model, value.cite)})" if value.cite else ""
            sheet.paragraph(f"{value.value} is {name}: {value.about}{cited}", 6)
        if slot.limits is not None:
            others = [f"{who} take {bounds}" for who, bounds in slot.limits.others.items()]
            conditions = "; ".join(["unless told otherwise", *others])
            sheet.paragraph(f"A client sends {slot.limits.usual} {conditions}.", 6)
        if slot.signed_as:
            sheet.paragraph(f"It can be read as {slot.signed_as}, too.", 6)
    for note in slot.notes:
        sheet.paragraph(_notes(model, [note]), 6)
    if slot.cite:
        sheet.paragraph(f"Source: {_cited(model, slot.cite)}", 6)


def _example(sheet: Sheet, model: Protocol, message: Message, example: Example) -> None:
    data = bytes.fromhex(example.hex)
    origin = _cited(model, example.cite) if example.cite else ""
    made = f"constructed: {example.constructed}" if example.constructed else ""
    sheet.paragraph(f"{example.title} ({origin or made})", 2)
    sheet.paragraph(example.hex, 4)
    slots = [*message.lay_out(legal_length(message, data) or 0)]
    rows = rows_of(data, slots[:_MOST_ROWS], message)
    cells = [
        (f"  {row.offset:>4}", to_hex(row.data), row.path, _joined(row.text, row.order))
        for row in rows
    ]
    sheet.columns([("  byte", "hex", "part", "value"), *cells])


def _slips(sheet: Sheet, model: Protocol, message: Message) -> None:
    """Print the errata of a message, and what is not known of it."""
    errata = [
        (number, each)
        for number, each in enumerate(model.errata, 1)
        if each.message == message.name
    ]
    if errata:
        sheet.heading("Errata")
        for number, erratum in errata:
            erratum_lines(sheet, model, number, erratum)
    unknowns = [each for each in model.unknowns if each.message == message.name]
    if unknowns:
        sheet.heading("Not known")
        for unknown in unknowns:
            unknown_line(sheet, unknown)
