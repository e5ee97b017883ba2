"""Where each panel of a drawing stands: one for each channel or address of a quantity."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from .quantities import Quantity
    from .trace import Trace

QUANTITIES, PANELS = 8, 64
"""How many quantities are drawn at most, and how many panels in all."""

# So many panels stand below each other; more in two columns, or in four. Lengths are in inches.
_ONE_COLUMN, _TWO_COLUMNS = 8, 20
_WIDTHS = {1: 10.0, 2: 12.0, 4: 16.0}
_LEFT, _RIGHT, _ABOVE, _BELOW, _BETWEEN = 0.85, 0.15, 0.45, 0.75, 0.25
# What stands above a block of panels, what above and below a panel; and how high a panel is: one
# alone, and one of several.
_HEADING, _LABEL, _TICKS = 0.28, 0.2, 0.34
_ALONE, _ONE_OF_SEVERAL, _APART = 1.5, 0.85, 0.05


@dataclass(frozen=True, slots=True)
class Block:
    """A quantity, and what is drawn of it: a panel for each key, in so many columns."""

    quantity: Quantity
    traces: dict[int, Trace]
    columns: int

    @property
    def rows(self) -> int:
        """How many rows of panels it has."""
        return -(-len(self.traces) // self.columns)

    @property
    def panel_height(self) -> float:
        """How high a panel is."""
        return _ALONE if len(self.traces) == 1 else _ONE_OF_SEVERAL

    @property
    def label_height(self) -> float:
        """How high what stands above a panel is: whose it is."""
        return 0.0 if self.quantity.key is None else _LABEL

    @property
    def height(self) -> float:
        """How high it is, with its heading."""
        rows = self.rows * (self.panel_height + self.label_height)
        return _HEADING + rows + (self.rows - 1) * _APART + _TICKS


@dataclass(frozen=True, slots=True)
class Panel:
    """One panel, in inches from the left and from the top; and what stands beside it."""

    key: int
    trace: Trace
    left: float
    top: float
    width: float
    height: float
    is_leftmost: bool
    is_lowest: bool


class Page:
    """All blocks, one below the other."""

    def __init__(self, blocks: Sequence[Block]) -> None:
        self.blocks = blocks
        self.columns = max(block.columns for block in blocks)
        self.width = _WIDTHS[self.columns]
        self.height = _ABOVE + sum(block.height for block in blocks) + _BELOW

    def placed(self) -> Iterator[tuple[Block, float, list[Panel]]]:
        """Yield each block, how far from the top it begins, and its panels."""
        top = _ABOVE
        for block in self.blocks:
            yield block, top, [*self._panels(block, top + _HEADING)]
            top += block.height

    def place_of(self, panel: Panel) -> tuple[float, float, float, float]:
        """Return left, bottom, width and height of a panel, as shares of the page."""
        bottom = self.height - panel.top - panel.height
        across, up = self.width, self.height
        return panel.left / across, bottom / up, panel.width / across, panel.height / up

    def _panels(self, block: Block, top: float) -> Iterator[Panel]:
        columns, count = block.columns, len(block.traces)
        room = self.width - _LEFT - _RIGHT
        width = (room - (columns - 1) * _BETWEEN) / columns
        step = block.panel_height + block.label_height
        for number, (key, trace) in enumerate(block.traces.items()):
            row, column = divmod(number, columns)
            yield Panel(
                key,
                trace,
                _LEFT + column * (width + _BETWEEN),
                top + row * (step + _APART) + block.label_height,
                width,
                block.panel_height,
                column == 0,
                number + columns >= count,
            )


def page_of(found: Sequence[tuple[Quantity, dict[int, Trace]]]) -> tuple[Page, list[str]]:
    """Return what is drawn of some quantities, and the names of what has no room."""
    blocks, left_out = [], []
    room = PANELS
    columns = _columns(max(len(traces) for _, traces in found[:QUANTITIES]))
    for number, (quantity, traces) in enumerate(found):
        drawn = dict([*traces.items()][:room])
        room -= len(drawn)
        if number >= QUANTITIES or not drawn:
            left_out.append(quantity.name)
            room += len(drawn)
            continue
        blocks.append(Block(quantity, drawn, columns if len(drawn) > 1 else 1))
        if len(drawn) < len(traces):
            left_out.append(more_of(quantity, len(traces) - len(drawn)))
    return Page(blocks), left_out


def more_of(quantity: Quantity, count: int) -> str:
    """Return in words that so many more channels or addresses of a quantity are left out."""
    of = "" if quantity.key is None else f" {quantity.key.name}"
    return f"{quantity.name} of {count} more{of} (--ids chooses)"


def _columns(count: int) -> int:
    return 1 if count <= _ONE_COLUMN else 2 if count <= _TWO_COLUMNS else 4
