"""Colours of a site's own: whether they can be read on its pages, and their nearest shade that can.

What stands on what is as WCAG 2 asks of text: a contrast of 4.5 and more.
"""

from __future__ import annotations

import re
from colorsys import hls_to_rgb, rgb_to_hls
from functools import cache
from pathlib import Path
from typing import Literal, TypeAlias

BOUND = 4.5
Theme: TypeAlias = Literal["light", "dark"]

_TOKENS = Path(__file__).parent / "static" / "css" / "1-tokens.css"
# Whatever links and buttons stand on.
_GROUNDS = ("paper", "raised", "tint", "to-tint", "from-tint", "good-tint", "bad-tint", "mark")
# How much of the colour its own background has, if that leaves the words on it to be read.
_PARTS = (0.14, 0.12, 0.1, 0.08, 0.06, 0.04, 0.02)


def contrast(one: str, other: str) -> float:
    """Return the contrast of two colours, from 1 to 21. Colours are # and six hex digits."""
    dark, light = sorted((_luminance(one), _luminance(other)))
    return (light + 0.05) / (dark + 0.05)


def worst_contrast(colour: str, theme: Theme) -> float:
    """Return the least contrast that a colour has with what it can stand on in a theme."""
    return min(contrast(colour, _tokens()[theme][ground]) for ground in _GROUNDS)


def readable(colour: str, theme: Theme) -> str:
    """Return the nearest shade of a colour, darker or lighter, that can be read in a theme."""
    hue, lightness, saturation = rgb_to_hls(*_parts(colour))
    step = -0.01 if theme == "light" else 0.01
    while worst_contrast(colour, theme) < BOUND:
        lightness += step
        colour = _written(hls_to_rgb(hue, min(1.0, max(0.0, lightness)), saturation))
    return colour


def accent_style(light: str, dark: str) -> str:
    """Return the style sheet that gives pages an accent of their own, on screens."""
    return (
        f"@media screen {{\n:root {{ {_accent(light, 'light')} }}\n}}\n"
        f"@media screen and (prefers-color-scheme: dark) {{\n"
        f":root {{ {_accent(dark, 'dark')} }}\n}}\n"
    )


def default_accent() -> str:
    """Return the accent of pages that have none of their own, in the light theme."""
    return _tokens()["light"]["accent"]


def _accent(colour: str, theme: Theme) -> str:
    paper = _tokens()[theme]["paper"]
    tints = (_mixed(colour, paper, part) for part in _PARTS)
    tint = next((each for each in tints if contrast(colour, each) >= BOUND), paper)
    return f"--accent: {colour}; --accent-tint: {tint};"


@cache
def _tokens() -> dict[Theme, dict[str, str]]:
    """Return the colours of both themes by name, as the style sheet sets them."""
    light, dark = _TOKENS.read_text(encoding="utf-8").split("prefers-color-scheme: dark")
    return {
        "light": dict(re.findall(r"--([\w-]+): (#[0-9a-f]{6});", light)),
        "dark": dict(re.findall(r"--([\w-]+): (#[0-9a-f]{6});", dark)),
    }


def _parts(colour: str) -> tuple[float, float, float]:
    red, green, blue = bytes.fromhex(colour[1:])
    return red / 255, green / 255, blue / 255


def _written(parts: tuple[float, float, float]) -> str:
    return "#" + bytes(round(255 * each) for each in parts).hex()


def _mixed(colour: str, ground: str, part: float) -> str:
    red, green, blue = (
        part * one + (1 - part) * other
        for one, other in zip(_parts(colour), _parts(ground), strict=True)
    )
    return _written((red, green, blue))


def _luminance(colour: str) -> float:
    red, green, blue = (
        each / 12.92 if each <= 0.04045 else ((each + 0.055) / 1.055) ** 2.4
        for each in _parts(colour)
    )
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue
