"""Quantities over time, drawn: a panel for each of their channels or addresses."""

from __future__ import annotations

from dataclasses import dataclass
from io import BytesIO
from typing import TYPE_CHECKING, Any

from matplotlib import rc_context
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from .panels import more_of, page_of
from .trace import alone

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .panels import Block, Page, Panel
    from .quantities import Quantity
    from .traces import Traces

# Colours that people of any sight tell apart: one for each quantity.
_COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#b8860b", "#56b4e9", "#7a5195", "#8c564b")
_INK, _FAINT, _GRID = "#24292f", "#57606a", "#d8dee4"
_STYLE: dict[str, Any] = {
    "svg.hashsalt": "captures",
    "svg.fonttype": "none",
    "font.family": "sans-serif",
    "font.size": 9,
    "axes.edgecolor": _GRID,
    "axes.labelcolor": _FAINT,
    "axes.titlecolor": _INK,
    "text.color": _INK,
    "xtick.color": _FAINT,
    "ytick.color": _FAINT,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": _GRID,
    "grid.linewidth": 0.6,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "lines.linewidth": 1.2,
    "legend.frameon": False,
    "path.simplify": False,
}
# No date and no version: the same capture gives the same bytes.
_METADATA: dict[str, dict[str, None]] = {
    ".svg": {"Date": None, "Creator": None},
    ".png": {"Software": None},
    ".pdf": {"CreationDate": None, "Creator": None, "Producer": None},
}
# Times from so many seconds on are in minutes, and in hours.
_LONG = ((2 * 3600.0, 3600.0, "h"), (300.0, 60.0, "min"), (0.0, 1.0, "s"))
# So few points are shown as such; a line alone could hide them.
_FEW = 60
# How many steps the scale of a panel has at most: of one alone, and of one of several.
_TICKS, _FEWER_TICKS = 6, 3
_BANDS = (
    "\nwhere readings are dense, the line is their mean, and the band goes from lowest to highest"
)


def drawing(traces: Traces, suffix: str, title: str, baud: float) -> tuple[bytes, list[str]]:
    """Draw them, and return the drawing with the names of what had no room.

    `suffix` is the one of its file. Raises ValueError if there is nothing to draw.
    """
    panels = traces.panels()
    if not panels:
        raise ValueError("the capture holds no message with a number in it")
    page, left_out = page_of(panels)
    made = BytesIO()
    with rc_context(_STYLE):
        figure = _drawn(page, traces.has_times, title, baud)
        figure.savefig(made, format=suffix[1:], metadata=_METADATA[suffix], facecolor="white")
    left_out += [more_of(quantity, len(keys)) for quantity, keys in traces.left_out.items()]
    return made.getvalue(), left_out


def _drawn(page: Page, has_times: bool, title: str, baud: float) -> Figure:
    figure = Figure(figsize=(page.width, page.height), dpi=100)
    drawn = [trace for block in page.blocks for trace in block.traces.values()]
    points = [trace.points()[0] for trace in drawn]
    length = max(float(at[-1]) for at in points) - min(float(at[0]) for at in points)
    divisor, unit = next((by, unit) for least, by, unit in _LONG if length >= least)
    text = _Text(figure, page)
    text.show(title, 0.1, 0.08, fontsize=11)
    first: Axes | None = None
    for number, (block, top, panels) in enumerate(page.placed()):
        text.show(_heading(block.quantity), panels[0].left, top, fontweight="bold", fontsize=10)
        layout = block.quantity.layout
        about = f"{layout.name}: {layout.described.summary}"
        text.show(about, page.width - 0.15, top, ha="right", color=_FAINT, fontsize=8)
        beside: Axes | None = None
        for panel in panels:
            axes = figure.add_axes(page.place_of(panel), sharex=first, sharey=beside)
            first, beside = first or axes, beside or axes
            _draw(axes, block, panel, divisor, _COLOURS[number % len(_COLOURS)])
            is_last = page.columns > 1 or block is page.blocks[-1]
            axes.tick_params(
                labelleft=panel.is_leftmost, labelbottom=panel.is_lowest and is_last, length=0
            )
    if has_times:
        label = f"time since the recording began ({unit})"
    else:
        label = f"time on the wire at {baud:g} baud ({unit}); the capture holds no times"
    if any(trace.is_dense for trace in drawn):
        label += _BANDS
    text.show(label, page.width / 2, page.height - 0.55, ha="center", color=_FAINT)
    return figure


@dataclass(frozen=True, slots=True)
class _Text:
    """Text on a page, placed in inches from the left and from the top."""

    figure: Figure
    page: Page

    def show(self, text: str, left: float, top: float, **how: Any) -> None:
        """Show some."""
        across, up = left / self.page.width, 1 - top / self.page.height
        self.figure.text(across, up, text, va="top", **how)


def _draw(axes: Axes, block: Block, panel: Panel, divisor: float, colour: str) -> None:
    quantity, trace = block.quantity, panel.trace
    if trace.is_dense:
        at, low, value, high = trace.band()
        axes.fill_between(at / divisor, low, high, color=colour, alpha=0.25, linewidth=0)
    else:
        at, value = trace.points()
    places = alone(value).tolist()
    is_few = trace.count <= _FEW
    axes.plot(
        at / divisor,
        value,
        color=colour,
        marker="." if is_few or places else "",
        markersize=5,
        markevery=None if is_few else places,
        gid=f"{quantity.name}.{panel.key}",
    )
    if quantity.key is not None:
        name = f"{quantity.key.name} {panel.key}"
        axes.set_title(name, loc="left", fontsize=8, color=_FAINT, pad=3)
    if panel.is_leftmost:
        axes.set_ylabel(quantity.scale[2])
    axes.margins(x=0.01, y=0.12)
    axes.yaxis.set_major_locator(MaxNLocator(_TICKS if len(block.traces) == 1 else _FEWER_TICKS))
    axes.ticklabel_format(useOffset=False, style="plain")


def _heading(quantity: Quantity) -> str:
    """Return the name of a quantity in words, without the unit that may stand at its end."""
    words = quantity.path.rpartition(".")[2].strip("_").split("_")
    if len(words) > 1 and words[-1] == quantity.slot.unit.lower():
        words.pop()
    return " ".join(words).capitalize()
