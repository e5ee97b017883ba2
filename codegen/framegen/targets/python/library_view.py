"""The library as a whole as the templates show it: messages, imports and exports."""

from __future__ import annotations

import textwrap
from dataclasses import dataclass
from typing import TYPE_CHECKING

from framewire.edition import EDITION
from framewire.frame.free_name import free_name
from framewire.recording.layout import EVENT_COLUMNS

from framegen.language.spec import Distribution
from framegen.model.apart import begun
from framegen.model.client_names import client_names
from framegen.targets.python.checksum_view import checksums_of
from framegen.targets.python.envelope_view import EnvelopeView
from framegen.targets.python.escape import Bracketed, literal
from framegen.targets.python.exports import (
    HOMES,
    OF_ADDRESSES,
    OF_BROADCASTS,
    OF_FAILURES,
    export_order,
    homes_of_client,
    import_from,
    import_order,
)
from framegen.targets.python.imports import SHARED
from framegen.targets.python.list_view import ListView
from framegen.targets.python.lookalike_view import LookalikeView
from framegen.targets.python.message_view import MessageView
from framegen.targets.python.notes import noted
from framegen.targets.python.proof_view import proof_in_place
from framegen.targets.python.spelling import direction_member
from framegen.targets.python.text_view import PackedView
from framegen.targets.python.union_view import UnionView, type_alias, unions

if TYPE_CHECKING:
    from framegen.language.spec import Link
    from framegen.language.values import Direction
    from framegen.model.model import Model
    from framegen.targets.python.checksum_view import ChecksumView
    from framegen.targets.python.element_view import ElementView
    from framegen.targets.python.proof_view import ProofView

_NO_DISTRIBUTION = Distribution.model_validate({})


@dataclass(frozen=True, slots=True)
class DirectionView:
    """One member of the Direction enumeration."""

    direction: Direction

    @property
    def member(self) -> str:
        return direction_member(self.direction)

    @property
    def assigned(self) -> str:
        """What it is made of: its value, who sends and who receives."""
        ends = self.direction.key, self.direction.sender, self.direction.receiver
        return Bracketed(f"{self.member} = (", [*map(literal, ends)], ")").fitted(4)


@dataclass(frozen=True, slots=True)
class LibraryView:
    """The library as a whole."""

    model: Model
    runtime: str = SHARED
    """Where the runtime is that it imports from."""

    @property
    def carries(self) -> bool:
        """Whether it is in the library itself."""
        return self.runtime != SHARED

    @property
    def version(self) -> str:
        return self.model.spec.protocol.version

    @property
    def edition(self) -> int:
        """The edition of the runtime that it is for."""
        return EDITION

    @property
    def package(self) -> str:
        return self.model.spec.protocol.name

    @property
    def envelopes(self) -> list[EnvelopeView]:
        """What stands around the fields of messages."""
        return [EnvelopeView(frame) for frame in self.model.envelopes.values()]

    @property
    def heads(self) -> str:
        """The assignment of what holds all of them."""
        names = [each.constant for each in self.envelopes]
        envelopes = Bracketed("(", names, ")", lone=",")
        proof = [self.proof.given] if self.proof else []
        return Bracketed("HEADS = Heads(", [envelopes, *proof], ")").fitted(0)

    @property
    def import_parts(self) -> list[str]:
        """The imports of what they are made of."""
        parts = {"envelope": {"Envelope"}.union(*(each.parts for each in self.envelopes))}
        parts["heads"] = {"Heads"}
        for method in checksums_of(self.model):
            parts.setdefault(method.module, set()).add(method.name)
        return [import_from(f"framewire.frame.{module}", parts[module]) for module in parts]

    @property
    def proof(self) -> ProofView | None:
        """The test of the checksum that decoders make in place, where one does for all frames."""
        return proof_in_place(self.model)

    @property
    def proven(self) -> bool:
        """Whether every frame has a checksum."""
        return all(frame.checksums for frame in self.model.envelopes.values())

    @property
    def lengthened(self) -> bool:
        """Whether a frame may be the beginning of a longer one."""
        return any(begun(self.model))

    @property
    def address(self) -> bool:
        """Whether any frame has the number of a device."""
        return any(frame.address is not None for frame in self.model.envelopes.values())

    @property
    def directions(self) -> list[DirectionView]:
        return [DirectionView(direction) for direction in self.model.ways]

    @property
    def messages(self) -> list[MessageView]:
        return [MessageView(message, self.model) for message in self.model.messages.values()]

    @property
    def deprecates(self) -> bool:
        """Whether there are messages that nobody should make any more."""
        return any(message.deprecated for message in self.messages)

    @property
    def lists(self) -> list[ListView]:
        """The lists of all messages."""
        fields = (field for message in self.messages for field in message.fields)
        return [field for field in fields if isinstance(field, ListView)]

    @property
    def lists_taken(self) -> str:
        """The types that lists are given as, to be imported; empty where there are none."""
        fields = [field for message in self.messages for field in message.fields]
        if not any(isinstance(field, ListView | PackedView) for field in fields):
            return ""
        paired = any(isinstance(field, ListView) and field.is_paired for field in fields)
        return "Iterable, Mapping" if paired else "Iterable"

    @property
    def floats(self) -> bool:
        """Whether any number is a floating-point one."""
        return any(message.floats for message in self.messages)

    @property
    def passed_nan(self) -> str:
        """What a strategy passes on, where it may generate what is no number."""
        return ", allow_nan=allow_nan" if self.floats else ""

    @property
    def columns(self) -> bool:
        """Whether any list can be read as columns."""
        return any(message.columns is not None for message in self.messages)

    @property
    def elements(self) -> list[ElementView]:
        """The classes of their elements."""
        return [each.element for each in self.lists if each.element is not None]

    @property
    def _field_classes(self) -> dict[str, str]:
        """The classes of all fields, each with its module."""
        found: dict[str, str] = {}
        for message in self.messages:
            found |= message.classes
        return found

    @property
    def message_imports(self) -> list[str]:
        """The imports of the messages' module."""
        parts = {"Message": "message", **self._field_classes}
        parts |= {"warn_deprecated": "deprecation"} if self.deprecates else {}
        parts |= {each.base: _snake(each.base) for each in self.elements}
        homes = {name: f"framewire.frame.{module}" for name, module in parts.items()}
        homes |= {"Direction": "._library"}
        homes |= {message.envelope: "._envelopes" for message in self.messages}
        return [
            import_from(home, [name for name in homes if homes[name] == home])
            for home in dict.fromkeys(homes.values())
        ]

    @property
    def unions(self) -> list[UnionView]:
        """The types of all that an end sends."""
        return unions(self.model)

    @property
    def any_message(self) -> str:
        """The assignment of the type of whatever is sent at all."""
        return type_alias("Decoded", [union.name for union in self.unions] or ["Message"])

    @property
    def import_unions(self) -> str:
        """The import of those types, where they are needed for typing alone."""
        names = ["Decoded", *(union.name for union in self.unions)]
        return import_from(".messages", names, 4)

    @property
    def every_message(self) -> str:
        """The assignment of all messages."""
        names = [message.name for message in self.messages]
        return Bracketed("MESSAGES: tuple[type[Message], ...] = (", names, ")", lone=",").fitted(0)

    @property
    def import_message_classes(self) -> str:
        return import_from(".messages", ["MESSAGES", *(each.name for each in self.messages)])

    @property
    def _homes(self) -> dict[str, str]:
        """Every exported name and its module, in the order that linters want."""
        elements = [element.name for element in self.elements]
        classes = [*(message.name for message in self.messages), *elements]
        types = [union.name for union in self.unions]
        exchanges = self.model.exchanges
        homes = HOMES | homes_of_client(client_names(self.model.spec))
        homes |= OF_ADDRESSES if any(each.address for each in exchanges) else {}
        homes |= OF_BROADCASTS if any(each.silent for each in exchanges) else {}
        homes |= OF_FAILURES if any(each.refusal or each.failure for each in exchanges) else {}
        homes |= {**dict.fromkeys([*classes, *types], ".messages")}
        return {name: homes[name] for name in sorted(homes, key=export_order)}

    @property
    def exported(self) -> list[str]:
        """Every name that the package exports, in the order that linters want."""
        return list(self._homes)

    @property
    def homes(self) -> list[str]:
        """The entries of a dict: each exported name and its module."""
        homes = {name: home.replace(SHARED, self.runtime) for name, home in self._homes.items()}
        return [f"{literal(name)}: {literal(home)}," for name, home in homes.items()]

    @property
    def exports(self) -> list[str]:
        """The imports of all exported names."""
        homes = sorted(self._homes.items(), key=lambda home: import_order(home[0]))
        return [import_from(module, [f"{name} as {name}"]) for name, module in homes]

    @property
    def doc(self) -> list[str]:
        """The docstring of the package."""
        spec, protocol = self.model.spec, self.model.spec.protocol
        said = [protocol.title, protocol.summary, protocol.description]
        return [*said, *noted(protocol.notes, spec)]

    @property
    def title(self) -> str:
        """What people call the protocol."""
        return self.model.spec.protocol.title

    @property
    def distribution(self) -> Distribution:
        """What its project file says, where it has one."""
        return self.model.spec.protocol.distribution or _NO_DISTRIBUTION

    @property
    def needs_beside(self) -> str:
        """What a package without its runtime says, if it is one that may be installed so."""
        if self.carries or self.model.spec.protocol.distribution is None:
            return ""
        return (
            f"{self.package} needs the package {self.runtime}, which comes with its project: "
            f"in a clone, pip install . ./generated/{self.package}"
        )

    @property
    def about(self) -> list[str]:
        """What the protocol is, in lines of a fenced block."""
        protocol = self.model.spec.protocol
        text = f"{protocol.title}\n\n{protocol.summary}".replace("`" * 3, "'" * 3)
        return [line for each in text.split("\n") for line in textwrap.wrap(each, 99) or [""]]

    @property
    def tables(self) -> str:
        """The tables of captures, each with the columns that are fields of its message."""
        tables = []
        for message in self.messages:
            fields = (free_name(each.name, EVENT_COLUMNS) for each in message.arguments)
            columns = ", ".join(fields)
            tables.append(f"{message.name} ({columns})" if columns else message.name)
        return ", ".join(tables)

    @property
    def lookalikes(self) -> str:
        """The tuple of the look-alikes, as code."""
        before = "LOOKALIKES = ("
        entries = [each.entry for each in self._lookalikes]
        return Bracketed(before, entries, ")", lone=",").fitted(0)

    @property
    def lookalike_methods(self) -> list[ChecksumView]:
        """What works out the checksums of look-alikes, but for the most usual one."""
        return [method for each in self._lookalikes for method in each.methods]

    @property
    def import_for_lookalikes(self) -> list[str]:
        """The imports of what recognises look-alikes."""
        parts: dict[str, set[str]] = {}
        if self._lookalikes:
            parts["framewire.codec.lookalike"] = {"Lookalike"}
        for method in self.lookalike_methods:
            parts.setdefault(f"framewire.frame.{method.module}", set()).add(method.name)
        return [import_from(module, parts[module]) for module in parts]

    @property
    def _lookalikes(self) -> list[LookalikeView]:
        spec = self.model.spec
        every = (
            LookalikeView(lookalike, self.model.lookalikes[name], spec.byte_order)
            for name, lookalike in spec.lookalikes.items()
        )
        return [each for each in every if each.is_recognisable]

    @property
    def link(self) -> Link:
        return self.model.spec.link

    @property
    def hid_argument(self) -> str:
        """Vendor, product and report size of each HID board, as an argument."""
        return Bracketed("hid_devices=(", self._hid_boards(), ")", lone=",").fitted(4, last=",")

    def _hid_boards(self) -> list[str]:
        return [
            f"(0x{board.vendor:04X}, 0x{board.product:04X}, {board.report_size})"
            for board in self.link.usb_hid
        ]


def _snake(name: str) -> str:
    """Return the module of a class of elements."""
    return {"Element": "element"}.get(name, "mixed_element")
