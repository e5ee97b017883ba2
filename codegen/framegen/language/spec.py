"""The spec as its author wrote it: every key of the language, and nothing derived.

What follows (offsets, legal lengths, wire time) is in `layout`, and whether it makes sense is for
`checks`. Only the shape is checked here: the keys, and the kind of each value. The descriptions are
what an editor shows while the spec is written.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any, Literal, TypeAlias

from pydantic import (
    BaseModel,
    ConfigDict,
    Discriminator,
    StrictBool,
    StrictInt,
    Tag,
    model_validator,
)
from pydantic import Field as Key

from framegen.language.class_names import DEFAULT_CLIENT
from framegen.language.edition import LATEST, Edition
from framegen.language.formula import Formula, LengthRule, parse_formula, sizes_of
from framegen.language.names import named_once, names_of
from framegen.language.notation import Ids, Notation, OneOf
from framegen.language.number_types import NUMBER_TYPES
from framegen.language.values import (
    Citation,
    Direction,
    Failure,
    Method,
    Range,
    Scale,
    parse_hex,
)

if TYPE_CHECKING:
    from pydantic import GetJsonSchemaHandler
    from pydantic.json_schema import JsonSchemaValue
    from pydantic_core import CoreSchema

Cite: TypeAlias = Annotated[Citation, Notation("a citation", "vendor, section 1.1", Citation.parse)]
Hex: TypeAlias = Annotated[bytes, Notation("hex", "55 55 02 07", parse_hex)]
Way: TypeAlias = Annotated[
    Direction, Notation("a direction", "host -> controller", Direction.parse)
]
Bounds: TypeAlias = Annotated[Range, Notation("a range", "0..1000", Range.parse)]
Count: TypeAlias = Annotated[Range, Notation("a count", "1..", Range.parse, number=Range.only)]
BitRange: TypeAlias = Annotated[
    Range, Notation("a range of bits", "0..6", Range.parse, number=Range.only)
]
Step: TypeAlias = Annotated[Scale, Notation("a scale", "0.001 V", Scale.parse, fractions=True)]
Length: TypeAlias = Annotated[
    LengthRule,
    Notation("a length rule", "3 * servo_count + 5", parse_formula, Formula, sizes_of),
]
Call: TypeAlias = Annotated[
    Method, Notation("a method", "read_positions(servo_ids) -> positions", Method.parse)
]
Failed: TypeAlias = Annotated[Failure, Notation("a failure", "status unless 1", Failure.parse)]
Natural: TypeAlias = Annotated[StrictInt, Key(ge=0)]
Names: TypeAlias = Annotated[
    tuple[str, ...], Notation("a name, or a list of names", "OldName", named_once, listed=names_of)
]
Order: TypeAlias = Literal["little", "big"]


class Part(BaseModel):
    """The base of all mappings of the language: no unknown keys, and frozen instances."""

    # Built when a spec is read, all at once: a part is seldom read alone.
    model_config = ConfigDict(
        extra="forbid", frozen=True, arbitrary_types_allowed=True, defer_build=True
    )


class Distribution(Part):
    """What the project file of a library says that nothing else in a spec does."""

    license: str = Key("", description="The licence, as an SPDX expression such as MIT.")
    authors: list[str] = Key([], description="Who made it.")


class Note(Part):
    """A fact that no codec can enforce."""

    text: str = Key(description="What there is to know.")
    cite: Cite = Key(description="Where it is known from.")


class Protocol(Part):
    """The protocol: its name, title, version and description."""

    name: str = Key(description="The name of the library, as it is imported.")
    title: str = Key(description="What people call the protocol.")
    version: str = Key(description='The version of this spec, in quotes: "1.0.0".')
    authority: str = Key(description="The source that decides; facts from any other are marked.")
    summary: str = Key(description="What it is for, in one line.")
    description: str = Key("", description="What a newcomer should know, in a paragraph or two.")
    notes: list[Note] = Key(
        [], description="What other sources than the one that decides know, each with its source."
    )
    client: str = Key(
        DEFAULT_CLIENT,
        description="The class of the client, in PascalCase, such as `Arm`: the one for asyncio is "
        "`AsyncArm` then, and `open_arm` and `open_async_arm` open a port.",
    )
    distribution: Distribution | None = Key(
        None,
        description="For a library that is a distribution of its own, with a project file in its "
        "folder: what that file says. Without it, the file of the whole project packs the library.",
    )


class SourceDocument(Part):
    """A document that facts are cited from."""

    title: str = Key(description="What it is called.")
    kind: Literal["document", "firmware", "implementation", "observation"] = Key(
        description="What kind of evidence it is."
    )
    about: str = Key("", description="What it holds and how far it goes.")


class Endpoint(Part):
    """An end of the line: its part, or a mapping with more."""

    about: str = Key(description="Its part.")
    notes: list[Note] = Key(
        [],
        description="What else is known of it, each with its source: shown with every message that "
        "it receives.",
    )

    @model_validator(mode="before")
    @classmethod
    def _short(cls, value: object) -> object:
        """Read `Asks.` as `{about: Asks.}`."""
        return value if isinstance(value, dict) else {"about": value}

    @classmethod
    def __get_pydantic_json_schema__(
        cls, core_schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> JsonSchemaValue:
        """Offer both ways of writing it."""
        return {**handler(core_schema), "type": ["string", "object"]}


class HidBoard(Part):
    """A kind of board that is reached by USB HID, without any serial port."""

    vendor: Annotated[StrictInt, Key(ge=0, le=0xFFFF)] = Key(
        description="The USB vendor id, such as 0x0483."
    )
    product: Annotated[StrictInt, Key(ge=0, le=0xFFFF)] = Key(description="The USB product id.")
    report_size: Annotated[StrictInt, Key(gt=0, le=1024)] = Key(
        64, description="Bytes of a report, each of which carries one frame and is padded."
    )
    about: str = Key("", description="Which boards these are.")
    cite: Cite | None = Key(None, description="Where this is known from.")

    @property
    def ids(self) -> str:
        """Vendor and product, as people write them: `0483:5750`."""
        return f"{self.vendor:04x}:{self.product:04x}"


class Link(Part):
    """The serial line."""

    baud: Annotated[StrictInt, Key(gt=0)] = Key(description="Bits per second.")
    data_bits: Annotated[Literal[5, 6, 7, 8], OneOf()] = Key(
        8, description="Data bits of a character."
    )
    parity: Literal["none", "even", "odd"] = Key("none", description="Parity bit of a character.")
    stop_bits: Annotated[Literal[1, 2], OneOf()] = Key(1, description="Stop bits of a character.")
    local_echo: StrictBool = Key(
        False, description="Whether each end receives what it sends itself, as on a single wire."
    )
    usb_hid: list[HidBoard] = Key(
        [], description="Boards that show as a USB HID device instead of a serial port."
    )
    cite: Cite | None = Key(None, description="Where this is known from.")

    @property
    def bits_per_byte(self) -> int:
        """The sum of start, data, parity and stop bits."""
        return 1 + self.data_bits + (self.parity != "none") + self.stop_bits


class Described(Part):
    """What every part of a frame can say of itself."""

    about: str = Key("", description="What it is.")
    notes: list[Note] = Key([], description="What else is known, each with its source.")


class ConstantPart(Described):
    """Bytes that never change."""

    is_: Literal["constant"] = Key(alias="is")
    bytes_: Hex = Key(alias="bytes", description="The bytes, in hex.")


class ReservedPart(Described):
    """Bytes without a meaning: always written so, and read as anything."""

    is_: Literal["reserved"] = Key(alias="is")
    bytes_: Hex = Key(alias="bytes", description="The bytes that are written, in hex.")


class LengthPart(Described):
    """The number of bytes in some parts of the frame."""

    is_: Literal["length"] = Key(alias="is")
    type: str = Key(description="The number type, such as u8.")
    counts: list[str] = Key(
        description="The parts whose bytes it counts, such as `counts: [length, body, checksum]`."
    )
    byte_order: Order | None = Key(None, description="Which byte comes first, if not as usual.")


class IdPart(Described):
    """The id of the message, or one of its ids."""

    is_: Literal["id"] = Key(alias="is")
    type: str = Key(description="The number type, such as u8.")
    sent: StrictBool = Key(
        True,
        description="Whether it is in the frame; one that is not is known to both ends, and only "
        "covered by a checksum.",
    )
    byte_order: Order | None = Key(None, description="Which byte comes first, if not as usual.")


class BodyPart(Described):
    """The place of the message's fields."""

    is_: Literal["body"] = Key(alias="is")


class NamedAddress(Part):
    """An address with a meaning of its own."""

    value: Natural = Key(description="The address.")
    about: str = Key("", description="What it means.")
    silent: StrictBool = Key(
        False, description="Whether nobody answers what is sent there, as with a broadcast."
    )
    cite: Cite | None = Key(None, description="Where it is known from.")
    was: Names = Key(
        (), description="What it was called in earlier editions, `OldName`, or a list of names."
    )


class AddressPart(Described):
    """The number of a device on the line: the first argument of every message."""

    is_: Literal["address"] = Key(alias="is")
    type: str = Key(description="The number type, such as u8.")
    range: Bounds | None = Key(
        None, description="The addresses that devices have, where they are fewer than the type has."
    )
    values: dict[str, NamedAddress] = Key(
        {},
        description="Addresses with a meaning of their own, by name, inside the range or not, such "
        "as `all: {value: 254, silent: true}`.",
    )
    byte_order: Order | None = Key(None, description="Which byte comes first, if not as usual.")
    was: Names = Key(
        (), description="What it was called in earlier editions, `OldName`, or a list of names."
    )


class CounterPart(Described):
    """A running number that the sender adds to each frame."""

    is_: Literal["counter"] = Key(alias="is")
    type: str = Key(description="The number type, such as u8.")
    byte_order: Order | None = Key(None, description="Which byte comes first, if not as usual.")
    was: Names = Key(
        (), description="What it was called in earlier editions, `OldName`, or a list of names."
    )


class ChecksumPart(Described):
    """A number worked out from other parts."""

    is_: Literal["checksum"] = Key(alias="is")
    type: str = Key(description="The number type, such as u8: as wide as the method.")
    method: str = Key(
        description="How it is worked out, by its name in the catalogue, such as `inverted sum` or "
        "`crc-16/modbus`."
    )
    covers: list[str] = Key(
        description="The parts it is worked out from, in order, such as `covers: [length, body]`."
    )
    byte_order: Order | None = Key(None, description="Which byte comes first, if not as usual.")


NumberPart: TypeAlias = LengthPart | IdPart | AddressPart | CounterPart | ChecksumPart
FramePart: TypeAlias = Annotated[
    ConstantPart | ReservedPart | BodyPart | NumberPart,
    Key(discriminator="is_"),
]
Frame: TypeAlias = dict[str, FramePart]


class NamedValue(Part):
    """A number with a meaning of its own."""

    value: StrictInt = Key(description="The number.")
    about: str = Key(description="What it means.")
    absent: StrictBool = Key(
        False,
        description="Whether it says that there is nothing to tell of: users of the library then "
        "ask for `absent`, and it is never sent as if it were a value.",
    )
    cite: Cite | None = Key(None, description="Where it is known from.")
    was: Names = Key(
        (), description="What it was called in earlier editions, `OldName`, or a list of names."
    )


class Limits(Part):
    """What a client sends unless told otherwise, though a frame could carry more."""

    usual: Bounds = Key(description="The values that are sent unless told otherwise, `0..1000`.")
    others: dict[str, Bounds] = Key(
        {}, description="Values that other devices take, each by whose they are."
    )


class Bits(Part):
    """A bit of a number, or several next to each other, with a meaning of their own."""

    at: BitRange = Key(description="Which bits, the lowest being 0: `0`, or `0..6`.")
    about: str = Key("", description="What they mean.")
    was: Names = Key(
        (), description="What it was called in earlier editions, `OldName`, or a list of names."
    )

    @model_validator(mode="before")
    @classmethod
    def _short(cls, value: object) -> object:
        """Read `0..6` as `{at: 0..6}`."""
        return value if isinstance(value, dict) else {"at": value}


class NumberField(Part):
    """A number; with `counted_by`, `sized_by` or a `count`, a list of them."""

    type: str = Key(
        description=f"The number type: {', '.join(NUMBER_TYPES)}; and u1 to u63, for packed "
        "numbers in a list of a fixed `count`."
    )
    about: str = Key(description="What it is.")
    unit: str = Key("", description="The unit of one step, such as ms.")
    scale: Step | None = Key(None, description="What one step is in a larger unit, or without one.")
    range: Bounds | None = Key(
        None, description="The values allowed, where they are fewer than the type holds."
    )
    limits: Limits | None = Key(
        None,
        description="What a client refuses to send unless told otherwise: a matter of safety, and "
        "not of the wire, which carries whatever `range` and type allow.",
    )
    signed_as: str | None = Key(
        None,
        description="The signed type, such as i16, as which the number can be read too: it is "
        "unsigned, and wraps round below zero.",
    )
    values: dict[str, NamedValue] = Key(
        {}, description="Numbers with a meaning of their own, by name."
    )
    bits: dict[str, Bits] = Key(
        {},
        description="Its bits with a meaning of their own, by name, such as "
        "`{low_voltage: 0, code: 1..7}`.",
    )
    always: StrictInt | None = Key(
        None, description="The only value that it has: no argument, and checked."
    )
    reserved: StrictInt | None = Key(
        None, description="What it is written as, though it is read as anything: no argument."
    )
    optional: StrictBool = Key(
        False,
        description="Whether it may be absent: only the last fields, each with those behind it.",
    )
    byte_order: Order | None = Key(None, description="Which byte comes first, if not as usual.")
    counted_by: str | None = Key(
        None, description="The earlier field that says how many of these there are."
    )
    sized_by: str | None = Key(
        None,
        description="The earlier field that says how many bytes these have, or the length part of "
        "the frame: whatever it leaves.",
    )
    count: Count | None = Key(
        None, description="How many there may be, such as 1.., or always are, such as 16."
    )
    text: Literal["ascii"] | None = Key(
        None, description="For a list of u8 that is text: in which characters."
    )
    notes: list[Note] = Key([], description="What else is known, each with its source.")
    cite: Cite | None = Key(
        None, description="Where it is known from, if not where the message is."
    )
    was: Names = Key(
        (), description="What it was called in earlier editions, `OldName`, or a list of names."
    )


class ListField(Part):
    """A list of elements that each have fields of their own."""

    element: str = Key(description="The name of one element's class.")
    about: str = Key(description="What its elements are.")
    counted_by: str | None = Key(
        None, description="The earlier field that says how many elements there are."
    )
    sized_by: str | None = Key(
        None,
        description="The earlier field that says how many bytes they have, or the length part of "
        "the frame: whatever it leaves.",
    )
    count: Count | None = Key(
        None, description="How many there may be, such as 1.., or always are, such as 3."
    )
    fields: dict[str, NumberField] = Key(
        description="The fields of one element, in the order of the frame."
    )
    notes: list[Note] = Key([], description="What else is known, each with its source.")
    cite: Cite | None = Key(
        None, description="Where it is known from, if not where the message is."
    )
    was: Names = Key(
        (), description="What it was called in earlier editions, `OldName`, or a list of names."
    )


def _kind_of_field(value: object) -> str:
    group = isinstance(value, ListField) or (
        isinstance(value, dict) and not value.keys().isdisjoint(("element", "fields"))
    )
    return "group" if group else "number"


AnyField: TypeAlias = Annotated[
    Annotated[ListField, Tag("group")] | Annotated[NumberField, Tag("number")],
    Discriminator(_kind_of_field),
]


class Example(Part):
    """One frame with its values. Every example is executed by `framegen check`."""

    title: str = Key(description="What the frame says.")
    hex: Hex = Key(description="The frame, in hex.")
    values: dict[str, Any] = Key(description="The fields of the message, without counts.")
    cite: Cite | None = Key(None, description="Where the frame was published or captured.")
    constructed: str = Key("", description="For a frame that was made up: from what.")


class Message(Part):
    """One message in one direction."""

    id: Ids | None = Key(
        None,
        description="Its code, which the id part of the frame holds; where there are several, one "
        "for each by name: `{class: 5, message: 1}`.",
    )
    frame: str | None = Key(
        None, description="Which of `frames` it has, where the protocol has several."
    )
    direction: Way = Key(description="Who sends it to whom, such as `host -> controller`.")
    vendor_name: str = Key("", description="What the vendor calls it.")
    summary: str = Key(description="What it does, in one line.")
    description: str = Key("", description="What else its user should know.")
    notes: list[Note] = Key(
        [], description="What other sources than its `cite` know, each with its source."
    )
    cite: Cite = Key(description="Where it is known from.")
    reply: str | None = Key(
        None, description="The message that answers it, where it is received and understood."
    )
    refusal: str | None = Key(
        None,
        description="The message that comes instead of its `reply` where it is refused: a client "
        "raises it.",
    )
    failure: Failed | None = Key(
        None,
        description="The field of this reply that is not zero where what it answers has failed, "
        "`error`; or that has another value than the good one, `status unless 1`: a client raises "
        "it.",
    )
    echoed: dict[str, str] = Key(
        {},
        description="Fields that the reply repeats, and where it has them, such as "
        "`servo_ids: positions.servo_id`: what tells the reply to this message from others.",
    )
    asks_for: str | None = Key(
        None,
        description="The field that says how many items the list of the reply holds, a number or a "
        "list as long: a reply with another number of them answers something else.",
    )
    reports: list[str] = Key([], description="Messages that may follow it, sooner or later.")
    acknowledged: str | None = Key(
        None,
        description="The one of its `reports` that says that it was taken, with the same values in "
        "fields of the same name: a client tells whether it came in time.",
    )
    lasts: str | None = Key(
        None,
        description="The field that says how long what it starts goes on, in ms or s: a client "
        "can wait until it is over.",
    )
    method: Call | None = Key(
        None,
        description="What sends it in a client: name, order of the arguments, and the field of the "
        "reply that is returned, where it is not the whole reply.",
    )
    verb: str = Key(
        "",
        description="What sends it from a shell, one short word such as `move`, where the name of "
        "its method would be long to type.",
    )
    length: Length = Key(
        description="The value of the length part, such as `3 * servo_count + 5`, or `[2, 4]` "
        "where last fields may be absent; in a frame without one, the size of the frame."
    )
    fields: dict[str, AnyField] = Key({}, description="Its fields, in the order of the frame.")
    examples: list[Example] = Key([], description="Frames, each with what it means.")
    since: str = Key("", description="The first spec version that has it, if not the first of all.")
    deprecated: str = Key("", description="Why not to use it any more, and what to use.")
    was: Names = Key(
        (), description="What it was called in earlier editions, `OldName`, or a list of names."
    )


class Pose(Part):
    """The messages that read, command and release the positions of many actuators.

    A client then has three more methods, and the command has the verbs `stop`, `hold`, `teach` and
    `play`. Its `stop` first sends the message with that verb, where there is one.
    """

    read: str = Key(description="The message that asks for positions, by a list of numbers.")
    move: str = Key(
        description="The message that commands positions, and how many milliseconds that may take."
    )
    release: str = Key(description="The message that lets go of them, by the same list.")
    ids: Bounds = Key(description="The numbers that there can be, such as 1..253.")
    hold: str = Key(description="The method that commands the positions which it reads.")
    present: str = Key(description="The method that finds out which are there.")
    targets: str = Key(description="The method that makes targets of positions that were read.")


class Reserved(Part):
    """An id or a name that must not be used, for instance because a removed message had it."""

    id: Ids | None = Key(None, description="The code.")
    direction: Way | None = Key(
        None, description="The direction in which the code is reserved; both, if left out."
    )
    name: str | None = Key(None, description="The message name.")
    why: str = Key(description="Why it is reserved.")
    cite: Cite | None = Key(None, description="Where that is known from.")


class Concern(Part):
    """The fact that an erratum or an unknown is about."""

    message: str = Key(description="The message.")
    fact: Literal["id", "kind", "length"] | None = Key(
        None, description="A fact about the message itself."
    )
    parameter: Annotated[StrictInt, Key(ge=1)] | None = Key(
        None, description="What parameter byte N is, counted from 1."
    )
    example: Annotated[StrictInt, Key(ge=1)] | None = Key(
        None, description="The number of an example, counted from 1."
    )
    field: str | None = Key(None, description="A field; in an example, also `length`.")


class Erratum(Part):
    """A mistake in a document, and the evidence. `check` fails once there is no difference."""

    title: str = Key(description="What is wrong, in one line.")
    cite: Cite = Key(description="Where it is printed.")
    concerns: Concern = Key(description="The fact in question.")
    document: Any = Key(description="What the document says of it; null where it says nothing.")
    bytes_: Any = Key(alias="bytes", description="What the frames say of it.")
    here: str = Key(description="What this spec does.")
    why: str = Key(description="Why.")


class Unknown(Part):
    """A question that no source answers."""

    concerns: Concern = Key(description="What it is about.")
    what: str = Key(description="What is not known, and what this spec does meanwhile.")


class LookalikeExample(Part):
    """A frame of a look-alike."""

    title: str = Key(description="What the frame says.")
    hex: Hex = Key(description="The frame, in hex.")


class Lookalike(Part):
    """Another protocol that is easily taken for this one."""

    title: str = Key(description="What it is called.")
    about: str = Key(description="How to tell it from this one.")
    cite: Cite = Key(description="Where it is known from.")
    frame: Frame | None = Key(None, description="Its frame, if it differs.")
    commands: dict[int, str] = Key({}, description="Meanings of codes there, by code.")
    examples: list[LookalikeExample] = Key([], description="Frames of it.")


class Release(Part):
    """One version of the spec."""

    version: str = Key(description="The version.")
    changes: list[str] = Key(description="What changed.")
    breaks: dict[str, str] = Key(
        {},
        description="What it breaks on purpose: by the path in this spec, or in the one before it "
        "where it is gone, the reason: `messages.LampFade: No board has it any more.`",
    )


class Spec(Part):
    """A protocol: its frame, its messages, and what is known about them."""

    framegen: Annotated[Edition, OneOf()] = Key(
        description=f"The edition of the spec language: {LATEST} in a new spec."
    )
    protocol: Protocol = Key(description="What the protocol is.")
    sources: dict[str, SourceDocument] = Key(
        description="What facts are cited from, by short name."
    )
    endpoints: dict[str, Endpoint] = Key(
        description="The ends of the line, each with its part: first the one that the library is "
        "for, then the one that it talks to."
    )
    link: Link = Key(description="The serial line.")
    byte_order: Order = Key(description="Which byte of a number comes first.")
    frame: Frame = Key({}, description="The parts of every frame, in order.")
    frames: dict[str, Frame] = Key(
        {},
        description="Instead of `frame`, the parts of several kinds of frame by name, where the "
        "directions or the messages differ in theirs.",
    )
    messages: dict[str, Message] = Key(description="The messages, by name.")
    pose: Pose | None = Key(
        None, description="How positions are read, commanded and let go, where there are any."
    )
    reserved: list[Reserved] = Key([], description="Codes and names that must not be used.")
    errata: list[Erratum] = Key([], description="Where the documents are wrong.")
    unknowns: list[Unknown] = Key([], description="What nobody has written down.")
    lookalikes: dict[str, Lookalike] = Key({}, description="Protocols easily taken for this one.")
    history: list[Release] = Key(
        [], description="What changed from version to version of this spec."
    )

    @property
    def envelopes(self) -> dict[str, Frame]:
        """Every kind of frame by name; the only one is called `frame`."""
        return self.frames or {"frame": self.frame}

    def frame_of(self, message: Message) -> str:
        """Return the name of the kind of frame that a message has."""
        return next(iter(self.envelopes)) if message.frame is None else message.frame
