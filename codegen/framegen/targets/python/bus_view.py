"""The addresses of a protocol as the clients show them: one device of many, and all at once."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framegen.targets.python.escape import Bracketed, Part, literal

if TYPE_CHECKING:
    from framegen.model.exchanges import Exchange


@dataclass(frozen=True, slots=True)
class BusView:
    """How a request says for which device it is."""

    exchange: Exchange

    @property
    def field(self) -> str:
        """The name of the address."""
        return "" if self.exchange.address is None else self.exchange.address.name

    @property
    def name(self) -> str:
        """The constant that says where it stands; empty where there are no addresses."""
        if not self.field:
            return ""
        frame = self.exchange.request.frame.name
        words = [*([] if frame == "frame" else [frame]), self.field]
        words += [] if self._senders in ([], [self.field]) else ["from", *self._senders]
        return f"_{'_'.join(words).upper()}"

    @property
    def _senders(self) -> list[str]:
        """The names of the address in the answers."""
        addresses = (each.frame.address for each in self.exchange.answers)
        return list(dict.fromkeys(each.name for each in addresses if each is not None))

    @property
    def silent(self) -> dict[str, int]:
        """The addresses that nobody answers, by name."""
        return self.exchange.silent

    @property
    def made(self) -> str:
        """The assignment of that constant."""
        senders = self._senders or [self.field]
        silent = [f"{literal(name)}: {value}" for name, value in self.exchange.silent.items()]
        items: list[Part] = [literal(self.field), *map(literal, senders)]
        items += [Bracketed("silent={", silent, "}")] if silent else []
        return Bracketed(f"{self.name} = Address(", items, ")").fitted(0)
