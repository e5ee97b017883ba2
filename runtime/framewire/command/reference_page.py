"""The reference in the terminal: the list of all messages, and the page of one."""

from __future__ import annotations

from ..explain.explanation import rows_of
from ..explain.pattern import pattern
from ..explain.protocol import listed
from ..explain.text import to_hex
from ..frame.pluralize import describe_range, pluralize
from .reference_topics import erratum_lines, unknown_line

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from typing import Any

    from ..explain.protocol import Message, Protocol, Slot
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
        sheet.paragraph(model.said["summary"])
        sheet.paragraphs(model.said["description"])
        sheet.paragraphs(_notes(model, model.said))
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
    ids = zip(message.frame.ids, message.seen_ids, strict=True)
    return " ".join(f"0x{number:0{2 * part.size}X}" for part, number in ids)


def _reserved(sheet: Sheet, model: Protocol) -> None:
    """Print which ids and names must not be used."""
    if model.said["reserved"]:
        sheet.heading("Reserved")
    for reserved in model.said["reserved"]:
        what = [str(reserved[key]) for key in ("id", "name", "direction") if key in reserved]
        sheet.paragraph(f"{', '.join(what)}: {reserved['why']}", 2)


def _summary(message: Message) -> str:
    deprecated = "Deprecated. " if "deprecated" in message.said else ""
    return f"{deprecated}{message.said['summary']}"


def message_page(sheet: Sheet, model: Protocol, message: Message) -> None:
    """Print all that is known of a message."""
    said = message.said
    sheet.heading(message.name)
    sheet.paragraph(said["summary"])
    if "deprecated" in said:
        sheet.paragraph(f"Deprecated: {said['deprecated']}", colour="yellow")
    sheet.heading("Bytes")
    sheet.columns([("byte", "hex", "part", "value"), *_pattern(message)])
    sheet.heading("Fields")
    _fields(sheet, model, message)
    sheet.heading("About it")
    _about(sheet, model, message)
    sheet.heading("Examples")
    for number, example in enumerate(said["examples"]):
        if number:
            sheet.line()
        _example(sheet, model, message, example)
    _slips(sheet, model, message)
    sheet.heading("In Python")
    # What a program calls, where a client has it; the codec behind.
    for line in [*said.get("client", ()), *([""] if "client" in said else []), *said["python"]]:
        sheet.line(f"  {line}".rstrip())
    sheet.heading("On the command line")
    for line in said["shell"]:
        sheet.line(f"  {line}")


def _about(sheet: Sheet, model: Protocol, message: Message) -> None:
    """Print what is known of a message as a whole, and of who receives it."""
    sheet.columns([*_facts(model, message)])
    sheet.paragraphs(message.said.get("description", ""))
    sheet.paragraphs(_notes(model, message.said))
    receiver = message.direction.partition(" -> ")[2]
    sheet.paragraphs(_notes(model, model.said["endpoints"][receiver]))


def _notes(model: Protocol, said: Any) -> str:
    """Return what else is known, a paragraph each."""
    notes = (f"{note['text']} ({_cited(model, note['cite'])})" for note in said.get("notes", ()))
    return "\n\n".join(notes)


def _facts(model: Protocol, message: Message) -> Iterator[tuple[str, str]]:
    """Yield what there is to say of a message as a whole."""
    said = message.said
    yield "direction:", f"{message.direction} ({said['kind']})"
    yield from _identity(model, message)
    for label, key in (
        ("vendor's name:", "vendor_name"),
        ("goes on for:", "lasts"),
        ("asks for as many as:", "asks_for"),
    ):
        if key in said:
            yield label, said[key]
    if said["kind"] in ("command", "query"):
        yield "reply:", said.get("reply", "none is due")
    failed = f"has failed, unless {said.get('good', 0)}:"
    yield from (
        (label, said[key])
        for label, key in (("refused by:", "refusal"), (failed, "failure"))
        if key in said
    )
    for label, key in (
        ("may lead to:", "reports"),
        ("answers:", "answers"),
        ("may follow:", "reports_on"),
    ):
        if key in said:
            yield label, ", ".join(said[key])
    if "acknowledged" in said:
        yield "acknowledged by:", said["acknowledged"]
    if "class" in said:
        yield "class:", said["class"]
    if "method" in said:
        yield "sent by:", said["method"]
    yield "length rule:", _length_rule(message)
    link, size = model.said["link"], message.largest
    time = f"{1000 * size * link['bits_per_byte'] / link['baud']:.1f} ms at {link['baud']} baud"
    yield "largest frame:", f"{pluralize(size, 'byte')}, {time}"
    if "since" in said:
        yield "since:", f"version {said['since']} of the spec"
    yield "source:", _cited(model, said["cite"])


def _identity(model: Protocol, message: Message) -> Iterator[tuple[str, str]]:
    """Yield the ids of a message, and the name of its frame where there are several."""
    frame = message.frame
    for part, number in zip((*frame.ids, *frame.unsent), message.ids, strict=True):
        unsent = ", not sent" if part in frame.unsent else ""
        yield f"{part.name}:", f"0x{number:0{2 * part.size}X}, {number} in decimal{unsent}"
    if len(model.envelopes) > 1:
        yield "frame:", frame.name


def _length_rule(message: Message) -> str:
    length = message.frame.length
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
        names = [slot.name for slot in message.frame.slots if slot.role in ("address", "counter")]
        differ = f"frames differ in their {listed(names)} alone" if names else ""
        sheet.line(f"  None: {differ or 'the frame is always the same'}.")
    for slot in message.fields:
        if slot.role != "list":
            _field(sheet, model, slot, slot.name)
            continue
        many = f"{slot.low} of them" if slot.is_fixed else f"{slot.low}..{slot.high} of them"
        if "counter" in slot.said:
            many += f", as {slot.said['counter']} says"
        if "element" in slot.said:
            sheet.line(f"  {slot.name}  list of {slot.said['element']}, {many}")
            _said(sheet, model, slot.said)
            many = ""
        for field in slot.fields:
            _field(sheet, model, field, slot.path("i", field), many)


def _field(sheet: Sheet, model: Protocol, slot: Slot, path: str, many: str = "") -> None:
    said = slot.said
    absent = "may be absent" if said.get("optional") else ""
    words = (slot.kind, slot.order_in_words, absent, _values(slot), said.get("unit", ""), many)
    sheet.line(f"  {path}  {_joined(*words)}")
    if "scale" in said:
        step, unit, *offset = said["scale"]
        beginning = "".join(f", and 0 is {each} {unit}".rstrip() for each in offset)
        sheet.paragraph(f"{f'One step is {step} {unit}'.rstrip()}{beginning}.", 6)
    for name, (low, high, about) in said.get("bits", {}).items():
        at = f"bit {low}" if low == high else f"bits {low}..{high}"
        sheet.paragraph(f"{at}: {name}{', ' if about else ''}{about}", 6)
    _said(sheet, model, said)


def _values(slot: Slot) -> str:
    """Return the values that a field may have."""
    if slot.role == "constant":
        return f"always {to_hex(slot.data)}"
    if slot.role == "reserved":
        return f"written as {to_hex(slot.data)}, read as anything"
    if slot.role == "text":
        return f"up to {slot.size} characters"
    if slot.role == "count":
        return "as many as there are"
    if slot.role == "size":
        return "as many bytes as there are"
    return "any number" if slot.is_float else f"{slot.low}..{slot.high}"


def _said(sheet: Sheet, model: Protocol, said: Any) -> None:
    """Print what is written of a field: what it is, its values, limits and notes."""
    sheet.paragraph(said.get("about", ""), 6)
    for name, value in said.get("values", {}).items():
        cited = f" ({_cited(model, value['cite'])})" if "cite" in value else ""
        sheet.paragraph(f"{value['value']} is {name}: {value['about']}{cited}", 6)
    if "limits" in said:
        limits = said["limits"]
        others = [f"{who} take {bounds}" for who, bounds in limits["others"].items()]
        conditions = "; ".join(["unless told otherwise", *others])
        sheet.paragraph(f"A client sends {limits['usual']} {conditions}.", 6)
    if "signed_as" in said:
        sheet.paragraph(f"It can be read as {said['signed_as']}, too.", 6)
    for note in said.get("notes", ()):
        sheet.paragraph(f"{note['text']} ({_cited(model, note['cite'])})", 6)
    if "cite" in said:
        sheet.paragraph(f"Source: {_cited(model, said['cite'])}", 6)


def _example(sheet: Sheet, model: Protocol, message: Message, example: Any) -> None:
    data = bytes.fromhex(example["hex"])
    origin = _cited(model, example["cite"]) if "cite" in example else ""
    made = f"constructed: {example['constructed']}" if "constructed" in example else ""
    sheet.paragraph(f"{example['title']} ({origin or made})", 2)
    sheet.paragraph(example["hex"], 4)
    slots = [*message.lay_out(message.length_of(data) or 0)]
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
        for number, each in enumerate(model.said["errata"], 1)
        if each["message"] == message.name
    ]
    if errata:
        sheet.heading("Errata")
        for number, erratum in errata:
            erratum_lines(sheet, model, number, erratum)
    unknowns = [each for each in model.said["unknowns"] if each["message"] == message.name]
    if unknowns:
        sheet.heading("Not known")
        for unknown in unknowns:
            unknown_line(sheet, unknown)
