"""The scripts and styles of a page, and the policy that allows these alone, by their digests."""

from __future__ import annotations

from base64 import b64encode
from dataclasses import dataclass
from functools import cache
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING

from markupsafe import Markup

from framegen.site.compact import compact_script, compact_style

if TYPE_CHECKING:
    from collections.abc import Sequence

_STATIC = Path(__file__).parent / "static"
# The files of the style sheet that only the pages of some templates need.
_STYLES_OF = {
    "8-fields": ("decoder", "message"),
    "8-line": ("decoder",),
    "8-workbench": ("decoder",),
}


@dataclass(frozen=True, slots=True)
class Assets:
    """The style and the scripts that go into a page, as they are."""

    style: Markup
    scripts: list[Markup]

    @property
    def policy(self) -> str:
        """The content security policy that allows these, and nothing besides."""
        scripts = " ".join(map(_digest, self.scripts)) or "'none'"
        return (
            f"default-src 'none'; style-src {_digest(self.style)}; script-src {scripts}; "
            "img-src 'self' data:; base-uri 'none'; form-action 'none'"
        )


def assets(template: str, scripts: Sequence[Sequence[str]], look: str = "") -> Assets:
    """Return what a page of a template needs; each script is made of files, without suffix.

    `look` is what the style sheet has besides.
    """
    return Assets(_style(template, look), [_compact(*names) for names in scripts])


@cache
def _style(template: str, look: str) -> Markup:
    """Return a style sheet: files of static/css, in the order of their names."""
    files = sorted((_STATIC / "css").glob("*.css"))
    texts = [
        file.read_text(encoding="utf-8")
        for file in files
        if template in _STYLES_OF.get(file.stem, (template,))
    ]
    return Markup("".join(map(compact_style, [*texts, look])))  # noqa: S704 - ours


@cache
def _compact(*names: str) -> Markup:
    return Markup(compact_script(script(*names)))  # noqa: S704 - ours


@cache
def script(*names: str) -> Markup:
    """Return files of static/js as one script."""
    files = (_STATIC / "js" / f"{name}.js" for name in names)
    return Markup("\n".join(file.read_text(encoding="utf-8") for file in files))  # noqa: S704 - ours


@cache
def _digest(text: str) -> str:
    return f"'sha256-{b64encode(sha256(text.encode()).digest()).decode()}'"
