"""What the templates show of the library as a whole: its messages, what it imports and exports."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framegen.language.spec import IdPart, LengthPart
from framegen.targets.python.command_lines import verbs
from framegen.targets.python.escape import Bracketed, literal
from framegen.targets.python.exports import HOMES, export_order, relative_import
from framegen.targets.python.lookalike_view import LookalikeView, byte_literal
from framegen.targets.python.message_view import MessageView
from framegen.targets.python.words import direction_member, struct_order

if TYPE_CHECKING:
    from framegen.language.spec import Link
    from framegen.language.values import Direction
    from framegen.model.model import Model
    from framegen.targets.python.command_lines import VerbView
    from framegen.targets.python.list_view import ListView


# So many bytes have room in a line.
_BYTES = 20


@dataclass(frozen=True, slots=True)
class DirectionView:
    """One member of the Direction enumeration."""

    direction: Direction

    @property
    def member(self) -> str:
        return direction_member(self.direction)

    @property
    def value(self) -> str:
        return literal(self.direction.key)

    @property
    def ends(self) -> str:
        """The entry that says who sends and who receives."""
        ends = [literal(self.direction.sender), literal(self.direction.receiver)]
        return Bracketed(f"Direction.{self.member}: (", ends, "),").fitted(4)


@dataclass(frozen=True, slots=True)
class LibraryView:
    """The library as a whole."""

    model: Model

    @property
    def version(self) -> str:
        return self.model.spec.protocol.version

    @property
    def package(self) -> str:
        return self.model.spec.protocol.name

    @property
    def directions(self) -> list[DirectionView]:
        return [DirectionView(direction) for direction in self.model.ways]

    @property
    def messages(self) -> list[MessageView]:
        return [MessageView(message, self.model) for message in self.model.messages.values()]

    @property
    def elements(self) -> list[ListView]:
        """The lists whose elements have a class of their own."""
        lists = [message.repeat for message in self.messages]
        return [repeat for repeat in lists if repeat is not None and repeat.element is not None]

    @property
    def imports(self) -> list[str]:
        """What the messages need of the standard library, by what their lists are read with."""
        chained = any(
            "chain." in message.repeat.read for message in self.messages if message.repeat
        )
        structs = [*(["Struct"] if self.elements else []), *(["iter_unpack"] if chained else [])]
        wanted = {
            "functools": ["partial"] if self.elements else [],
            "itertools": ["chain"] if chained else [],
            "struct": structs,
        }
        return [f"from {module} import {', '.join(n)}" for module, n in wanted.items() if n]

    @property
    def typing_imports(self) -> list[str]:
        """What the annotations of the messages need of the standard library."""
        lists = any(message.repeat for message in self.messages)
        fields = [field for message in self.messages for field in message.given]
        fields += [field for element in self.elements for field in element.fields]
        wanted: dict[str, dict[str, object]] = {
            "collections.abc": {"Callable": self.elements, "Iterable": lists},
            "typing": {
                "ClassVar": True,
                "Final": any(field.constants for field in fields),
                "TypeAlias": self.elements,
            },
        }
        found = {
            module: [name for name, needed in names.items() if needed]
            for module, names in wanted.items()
        }
        return [f"from {module} import {', '.join(n)}" for module, n in found.items() if n]

    @property
    def from_fields(self) -> list[str]:
        """What describes and takes in the fields."""
        lists = any(message.repeat for message in self.messages)
        numbers = any(message.numbers for message in self.messages)
        names = {"Items": lists, "Number": numbers}
        return [name for name, needed in names.items() if needed]

    @property
    def import_message_classes(self) -> str:
        return relative_import("messages", [message.name for message in self.messages])

    @property
    def _homes(self) -> dict[str, str]:
        """Every name that the package exports from its modules, in the order that linters want."""
        elements = [element.element for element in self.elements if element.element is not None]
        classes = [*(message.name for message in self.messages), *elements]
        homes = {**HOMES, **dict.fromkeys(classes, "messages")}
        return {name: homes[name] for name in sorted(homes, key=export_order)}

    @property
    def exported(self) -> list[str]:
        """Every name that the package exports, in the order that linters want."""
        return list(self._homes)

    @property
    def homes(self) -> list[str]:
        """The entries of a dict: each name that the package exports, and its module."""
        return [f"{literal(name)}: {literal(module)}," for name, module in self._homes.items()]

    @property
    def exports(self) -> list[str]:
        """The imports of all of those."""
        modules: dict[str, list[str]] = {}
        for name, module in self._homes.items():
            modules.setdefault(module, []).append(name)
        return [relative_import(module, names, 4) for module, names in sorted(modules.items())]

    @property
    def doc(self) -> list[str]:
        """The docstring of the package."""
        protocol = self.model.spec.protocol
        return [protocol.title, protocol.summary, protocol.description]

    @property
    def command_summary(self) -> str:
        """What the command is for."""
        return f"Send, read and replay frames of: {self.model.spec.protocol.title}."

    @property
    def verbs(self) -> list[VerbView]:
        """What the command can do."""
        return verbs(self.model)

    @property
    def lookalikes(self) -> str:
        """The tuple of the protocols that are easily taken for this one."""
        spec = self.model.spec
        # With neither a frame nor commands of its own, there is nothing to tell it by.
        told = [each for each in spec.lookalikes.values() if each.frame or each.commands]
        entries = [LookalikeView(lookalike, spec).entry for lookalike in told]
        before = "LOOKALIKES: tuple[Lookalike, ...] = ("
        return Bracketed(before, entries, ")", lone=",").fitted(0)

    @property
    def link(self) -> Link:
        return self.model.spec.link

    @property
    def hid_devices(self) -> str:
        """An assignment: vendor, product and the bytes of a report, of each."""
        boards = [
            f"(0x{board.vendor:04X}, 0x{board.product:04X}, {board.report_size})"
            for board in self.link.usb_hid
        ]
        before = "HID_DEVICES: tuple[tuple[int, int, int], ...] = ("
        return Bracketed(before, boards, ")", lone=",").fitted(0)

    @property
    def byte_order(self) -> str:
        return self.model.spec.byte_order

    @property
    def struct_order(self) -> str:
        return struct_order(self.byte_order)

    @property
    def header(self) -> str:
        header = self.model.frame.header
        pieces = [header[at : at + _BYTES] for at in range(0, len(header), _BYTES)]
        if len(pieces) == 1:
            return byte_literal(header)
        return "\n".join(["(", *(f"    {byte_literal(piece)}" for piece in pieces), ")"])

    @property
    def head(self) -> list[str]:
        """The expressions whose sum is the head of a frame."""
        terms: list[str] = []
        frame = self.model.frame
        for part in self.model.spec.frame.values():
            if isinstance(part, LengthPart):
                terms.append(f'length.to_bytes({frame.length.size}, "{self.byte_order}")')
            elif isinstance(part, IdPart):
                terms.append(f'command.to_bytes({frame.id.size}, "{self.byte_order}")')
        return terms
