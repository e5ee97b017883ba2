"""The reference in Markdown, as forges and editors show it."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

from framegen.targets.docs.escape import Safe, address, code, markdown, named, verbatim
from framegen.targets.templates import environment

if TYPE_CHECKING:
    from jinja2 import Environment

    from framegen.targets.docs.reference import ReferenceView

_TEMPLATES = Path(__file__).parent / "templates"


def markdown_files(reference: ReferenceView) -> dict[str, str]:
    """Render every page that is there in Markdown, by path below the root."""
    templates = _environment()
    return {
        page.markdown: templates.get_template(f"{page.template}.md.jinja").render(
            reference=reference, page=page, message=page.message
        )
        for page in [*reference.pages, *reference.message_pages]
        if page.in_markdown
    }


@cache
def _environment() -> Environment:
    # Escaped unless it is Safe: what a template prints is escaped where autoescape would do it.
    made = environment(_TEMPLATES, "markdown", autoescape=False, finalize=markdown)
    made.filters |= {
        "address": address,
        "code": code,
        "named": named,
        "safe": Safe,
        "verbatim": verbatim,
    }
    return made
