"""Reports on a comparison: one view of it, and a renderer for each format."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.report import github, json, markdown, text

if TYPE_CHECKING:
    from collections.abc import Callable

    from framegen.comparison.report.view import View

FORMATS: dict[str, Callable[[View], str]] = {
    "text": text.render,
    "json": json.render,
    "markdown": markdown.render,
    "github": github.render,
}
