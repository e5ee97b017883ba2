"""The reference: Markdown for forges and editors, and HTML pages that need no network."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.targets.docs.markdown_pages import markdown_files
from framegen.targets.docs.reference import ReferenceView
from framegen.targets.target import Comment, Target

if TYPE_CHECKING:
    from framegen.compile import Compiled
    from framegen.model.model import Model
    from framegen.targets.target import Snippets


def render(compiled: Compiled, snippets: Snippets) -> dict[str, str]:
    """Render the reference in Markdown, by path below the project's root."""
    (root,) = folders(compiled.model)
    files = markdown_files(ReferenceView(compiled, snippets))
    return {f"{root}/{path}": text for path, text in files.items()}


def folders(model: Model) -> tuple[str, ...]:
    """Return the folder of the protocol's reference."""
    return (f"docs/reference/{model.spec.protocol.name}",)


TARGET = Target(
    name="docs",
    about="The reference in Markdown; `framegen docs` makes pages of it.",
    render=render,
    folders=folders,
    comments={".md": Comment("<!-- ", " -->")},
)
