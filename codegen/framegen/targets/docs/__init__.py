"""The reference: static pages that need no network, and a Markdown twin of them."""

from __future__ import annotations

from base64 import b64encode
from functools import cache
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING

from markupsafe import Markup

from framegen.targets.docs.data import protocol_data
from framegen.targets.docs.escape import (
    Safe,
    address,
    code,
    linked,
    markdown,
    named,
    script_json,
    verbatim,
)
from framegen.targets.docs.site import SiteView
from framegen.targets.target import Target
from framegen.targets.templates import environment

if TYPE_CHECKING:
    from collections.abc import Iterator

    from jinja2 import Environment

    from framegen.compile import Compiled
    from framegen.targets.target import Snippets

FOLDER = "docs/reference"

_HERE = Path(__file__).parent
_TEMPLATES = _HERE / "templates"
# The decoder needs a script, the cheat sheet paper, and the spec is YAML: they have no twin.
_TWINS = {
    "index.html": "README.md",
    "examples.html": "examples.md",
    "stream.html": "stream.md",
    "sequences.html": "sequences.md",
    "errata.html": "errata.md",
    "lookalikes.html": "lookalikes.md",
    "changelog.html": "changelog.md",
}


def render(compiled: Compiled, snippets: Snippets) -> dict[str, str]:
    """The files of the reference, by path below the project's root."""
    site = SiteView(compiled.source, compiled.model, compiled.tree, snippets)
    files = dict([*_html(site), *_markdown(site)])
    return {f"{FOLDER}/{path}": text for path, text in files.items()}


def _html(site: SiteView) -> Iterator[tuple[str, str]]:
    templates = _html_environment()
    data = script_json(protocol_data(site.model))
    style = _static("style.css")
    for page in [*site.pages, *site.message_pages]:
        scripts = [_static(f"{name}.js") for name in page.scripts]
        template = templates.get_template(f"{page.template}.html.jinja")
        yield (
            page.path,
            template.render(
                site=site,
                page=page,
                message=page.message,
                style=style,
                scripts=scripts,
                data=data,
                allowed=_allowed(style, scripts),
            ),
        )


def _markdown(site: SiteView) -> Iterator[tuple[str, str]]:
    templates = _markdown_environment()
    for page in [*site.pages, *site.message_pages]:
        twin = page.path.replace(".html", ".md") if page.message else _TWINS.get(page.path)
        if twin is not None:
            template = templates.get_template(f"{page.template}.md.jinja")
            yield twin, template.render(site=site, page=page, message=page.message)


@cache
def _html_environment() -> Environment:
    made = environment(_TEMPLATES, "html", autoescape=True)
    made.filters["linked"] = linked
    return made


@cache
def _markdown_environment() -> Environment:
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


def _static(name: str) -> Markup:
    """A file that goes into pages as it is."""
    return Markup((_HERE / "static" / name).read_text(encoding="utf-8"))  # noqa: S704 - our own


def _allowed(style: str, scripts: list[Markup]) -> dict[str, str]:
    """What the pages' own policy lets run: these very texts, told by their digests."""
    return {
        "style": _digest(style),
        "script": " ".join(_digest(script) for script in scripts) or "'none'",
    }


def _digest(text: str) -> str:
    return f"'sha256-{b64encode(sha256(text.encode()).digest()).decode()}'"


TARGET = Target(
    name="docs",
    about="The reference, as pages and as Markdown.",
    render=render,
    folders=lambda _model: (FOLDER,),
)
