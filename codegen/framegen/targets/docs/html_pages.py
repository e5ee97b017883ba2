"""The reference as static HTML pages, each complete by itself: no network, no server."""

from __future__ import annotations

from base64 import b64encode
from functools import cache
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING

from markupsafe import Markup

from framegen.output import banner
from framegen.targets.docs.data import protocol_data
from framegen.targets.docs.escape import anchor, linked, script_json
from framegen.targets.docs.site import SiteView
from framegen.targets.templates import environment

if TYPE_CHECKING:
    from collections.abc import Iterable

    from jinja2 import Environment

    from framegen.compile import Compiled
    from framegen.targets.target import Snippets

_HERE = Path(__file__).parent


def render_site(specs: Iterable[Compiled], snippets: Snippets) -> dict[str, str]:
    """Render the references of several protocols, each in a folder of its name, with an index."""
    sites = [SiteView(compiled, snippets) for compiled in specs]
    files = {f"{site.folder}/{path}": text for site in sites for path, text in _pages(site).items()}
    style = _static("style.css")
    front = _environment().get_template("front.html.jinja")
    files["index.html"] = front.render(
        sites=sites,
        banner=banner(", ".join(site.spec for site in sites)),
        style=style,
        allowed=_allowed(style, []),
    )
    return files


def _pages(site: SiteView) -> dict[str, str]:
    """Render every page of a reference, by path below its root."""
    templates = _environment()
    data = script_json(protocol_data(site.model))
    style = _static("style.css")
    files: dict[str, str] = {}
    for page in [*site.pages, *site.message_pages]:
        scripts = [_static(*(f"{name}.js" for name in names)) for names in page.scripts]
        files[page.html] = templates.get_template(f"{page.template}.html.jinja").render(
            site=site,
            page=page,
            message=page.message,
            banner=banner(site.spec),
            style=style,
            scripts=scripts,
            data=data,
            allowed=_allowed(style, scripts),
        )
    return files


@cache
def _environment() -> Environment:
    made = environment(_HERE / "templates", "html", autoescape=True)
    made.filters |= {"anchor": anchor, "linked": linked}
    return made


def _static(*names: str) -> Markup:
    """Return files that go into pages as they are, as one."""
    texts = [(_HERE / "static" / name).read_text(encoding="utf-8") for name in names]
    return Markup("\n".join(texts))  # noqa: S704 - our own


def _allowed(style: str, scripts: list[Markup]) -> dict[str, str]:
    """Return the digests of the scripts and styles that the pages' own policy allows."""
    return {
        "style": _digest(style),
        "script": " ".join(_digest(script) for script in scripts) or "'none'",
    }


def _digest(text: str) -> str:
    return f"'sha256-{b64encode(sha256(text.encode()).digest()).decode()}'"
