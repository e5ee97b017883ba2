"""Quantities over time, drawn: a panel for each, with a line for each channel or address."""

from __future__ import annotations

from io import BytesIO
from typing import TYPE_CHECKING, Any

from matplotlib import rc_context
from matplotlib.figure import Figure

from ..layout import described
from .trace import alone

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .quantities import Quantity
    from .trace import Trace
    from .traces import Traces

PANELS = 8
"""How many quantities are drawn at most."""

# Colours that people of any sight tell apart, and then what else there is.
_COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#b8860b", "#56b4e9", "#7a5195", "#8c564b")
_STYLES = ("-", "--", ":", "-.")
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
    made = BytesIO()
    with rc_context(_STYLE):
        figure = _drawn(panels[:PANELS], traces, title, baud)
        figure.savefig(made, format=suffix[1:], metadata=_METADATA[suffix], facecolor="white")
    left_out = [quantity.name for quantity, _ in panels[PANELS:]]
    for quantity, keys in traces.left_out.items():
        of = "" if quantity.key is None else f" {quantity.key.name}"
        left_out.append(f"{quantity.name} of {len(keys)} more{of}")
    return made.getvalue(), left_out


def _drawn(
    panels: list[tuple[Quantity, dict[int, Trace]]], traces: Traces, title: str, baud: float
) -> Figure:
    heights = [2.6 if len(lines) > 1 else 1.7 for _, lines in panels]
    figure = Figure(figsize=(10, sum(heights) + 0.9), dpi=100, layout="constrained")
    axes = figure.subplots(
        len(panels), 1, sharex=True, squeeze=False, gridspec_kw={"height_ratios": heights}
    )[:, 0]
    figure.suptitle(f"{title}: {described().title}", x=0.01, ha="left", fontsize=11)
    points = [trace.points() for _, lines in panels for trace in lines.values()]
    longest = max(float(at[-1]) for at, _ in points)
    divisor, unit = next((by, unit) for least, by, unit in _LONG if longest >= least)
    for place, (quantity, lines) in zip(axes, panels, strict=True):
        _draw(place, quantity, lines, divisor)
    if traces.has_times:
        label = f"time since the recording began ({unit})"
    else:
        label = f"time on the wire at {baud:g} baud ({unit}); the capture holds no times"
    if any(trace.is_dense for _, lines in panels for trace in lines.values()):
        label += _BANDS
    axes[-1].set_xlabel(label)
    figure.align_ylabels([*axes])
    return figure


def _draw(axes: Axes, quantity: Quantity, lines: dict[int, Trace], divisor: float) -> None:
    for number, (key, trace) in enumerate(lines.items()):
        if trace.is_dense:
            at, low, value, high = trace.band()
            colour = _COLOURS[number % len(_COLOURS)]
            axes.fill_between(at / divisor, low, high, color=colour, alpha=0.25, linewidth=0)
        else:
            at, value = trace.points()
        places = alone(value).tolist()
        is_few = trace.count <= _FEW
        axes.plot(
            at / divisor,
            value,
            color=_COLOURS[number % len(_COLOURS)],
            linestyle=_STYLES[number // len(_COLOURS) % len(_STYLES)],
            marker="." if is_few or places else "",
            markersize=5,
            markevery=None if is_few else places,
            label=str(key),
            gid=f"{quantity.name}.{key}",
        )
    _, _, unit = quantity.scale
    said = quantity.layout.described.said
    axes.set_title(_heading(quantity), loc="left", fontweight="bold", fontsize=10)
    axes.set_title(
        f"{quantity.layout.name}: {said['summary']}", loc="right", color=_FAINT, fontsize=8
    )
    axes.set_ylabel(unit)
    axes.margins(x=0.01, y=0.12)
    axes.ticklabel_format(useOffset=False, style="plain", axis="y")
    if quantity.key is not None:
        axes.legend(
            title=quantity.key.name,
            loc="center left",
            bbox_to_anchor=(1.0, 0.5),
            ncols=1 + (len(lines) - 1) // 12,
            fontsize=8,
            title_fontsize=8,
        )


def _heading(quantity: Quantity) -> str:
    """Return the name of a quantity in words, without the unit that may stand at its end."""
    words = quantity.path.rpartition(".")[2].strip("_").split("_")
    if len(words) > 1 and words[-1] == str(quantity.slot.said.get("unit", "")).lower():
        words.pop()
    return " ".join(words).capitalize()
