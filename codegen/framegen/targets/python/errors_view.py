"""The errors that answers tell of, as the table of exchanges shows them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framegen.model.exchanges import snake_case
from framegen.targets.python.escape import Bracketed, Part, literal

if TYPE_CHECKING:
    from framegen.model.exchanges import Exchange
    from framegen.model.slots import Number


@dataclass(frozen=True, slots=True)
class ErrorsView:
    """How the answers to one request say that it was refused, or has failed."""

    exchange: Exchange

    @property
    def name(self) -> str:
        """The constant that says so; empty where nothing does."""
        exchange = self.exchange
        failing = exchange.reply if exchange.failure is not None else None
        told = [each.name for each in (failing, exchange.refusal) if each is not None]
        return f"_{'_OR_'.join(map(snake_case, told)).upper()}" if told else ""

    @property
    def made(self) -> str:
        """The assignment of that constant."""
        items: list[Part] = []
        if self.exchange.refusal is not None:
            items.append(f"refusal={self.exchange.refusal.name}")
        failure = self.exchange.failure
        if failure is not None:
            items.append(f"field={literal(failure.name)}")
            items += [f"good={self.exchange.good}"] if self.exchange.good else []
            items += [
                Bracketed(f"{key}={{", [f"{literal(name)}: {shown}" for name, shown in of], "}")
                for key, of in (("names", _values(failure)), ("bits", _masks(failure)))
                if of
            ]
        return Bracketed(f"{self.name} = Failures(", items, ")").fitted(0)


def _values(number: Number) -> list[tuple[str, str]]:
    return [(name, str(each.value)) for name, each in number.field.values.items()]


def _masks(number: Number) -> list[tuple[str, str]]:
    found = []
    for name, bits in number.field.bits.items():
        high = bits.at.low if bits.at.high is None else bits.at.high
        mask = (1 << high + 1) - (1 << bits.at.low)
        found.append((name, f"0x{mask:0{2 * number.size}X}"))
    return found
