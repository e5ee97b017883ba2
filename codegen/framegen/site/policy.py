"""The scripts and styles of a page, and the policy that allows these alone, by their digests."""

from __future__ import annotations

from base64 import b64encode
from dataclasses import dataclass
from functools import cache
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING

from markupsafe import Markup

if TYPE_CHECKING:
    from collections.abc import Sequence

_STATIC = Path(__file__).parent / "static"


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


def assets(scripts: Sequence[Sequence[str]]) -> Assets:
    """Return what a page needs; each script is made of files, by name without suffix."""
    return Assets(style(), [script(*names) for names in scripts])


@cache
def style() -> Markup:
    """Return the style sheet of all pages: the files of static/css, in the order of their names."""
    files = sorted((_STATIC / "css").glob("*.css"))
    return Markup("\n".join(file.read_text(encoding="utf-8") for file in files))  # noqa: S704 - ours


@cache
def script(*names: str) -> Markup:
    """Return files of static/js as one script."""
    files = (_STATIC / "js" / f"{name}.js" for name in names)
    return Markup("\n".join(file.read_text(encoding="utf-8") for file in files))  # noqa: S704 - ours


@cache
def _digest(text: str) -> str:
    return f"'sha256-{b64encode(sha256(text.encode()).digest()).decode()}'"
