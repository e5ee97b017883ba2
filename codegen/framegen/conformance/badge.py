"""The conformance badge: a small SVG picture that needs nothing else."""

from __future__ import annotations

from html import escape

from framewire.command.console import visible

# How wide a character is, for want of a font: the text is fitted to it.
_CHARACTER, _MARGIN, _HEIGHT = 6.5, 8, 20
_COLOURS = {"good": "#2e7d32", "fair": "#8a6d00", "bad": "#b3261e"}
_LABEL = "#3c4043"


def badge(label: str, text: str, mood: str) -> str:
    """Draw a badge with a label and a text, in the colour of `good`, `fair` or `bad`."""
    label, text = visible(label), visible(text)
    left, right = (round(len(each) * _CHARACTER + 2 * _MARGIN) for each in (label, text))
    width = left + right
    title = escape(f"{label}: {text}")
    pieces = [
        _piece(0, left, label, _LABEL),
        _piece(left, right, text, _COLOURS[mood]),
    ]
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{_HEIGHT}" '
        f'viewBox="0 0 {width} {_HEIGHT}" role="img" aria-label="{title}">\n'
        f"<title>{title}</title>\n{''.join(pieces)}</svg>\n"
    )


def _piece(at: int, width: int, text: str, colour: str) -> str:
    return (
        f'<rect x="{at}" width="{width}" height="{_HEIGHT}" fill="{colour}"/>\n'
        f'<text x="{at + _MARGIN}" y="14" textLength="{width - 2 * _MARGIN}" '
        f'lengthAdjust="spacingAndGlyphs" font-family="Verdana, DejaVu Sans, sans-serif" '
        f'font-size="11" fill="#fff">{escape(text)}</text>\n'
    )
