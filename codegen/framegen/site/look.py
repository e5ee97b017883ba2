"""What a site wears: its title, logo, colours, footer and links, as docs/site.yaml says."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from pathlib import PurePosixPath
from typing import TYPE_CHECKING
from urllib.parse import quote

from framegen.language.load import read_source
from framegen.language.site_settings import PATH, SiteSettings, load_settings, refused
from framegen.reading.findings import Finding
from framegen.site.guides.linked_files import FOLDER, PICTURES
from framegen.site.guides.links import FOLDER as GUIDES
from framegen.site.shades import BOUND, accent_style, readable, worst_contrast

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping
    from pathlib import Path

    from framegen.reading.yamltree import Tree
    from framegen.site.shades import Theme

# The settings lie beside the guides.
SITE_FILE = "site.yaml"
_KINDS = (".svg", ".png", ".jpg", ".jpeg", ".webp", ".gif", ".ico")
_MAX_BYTES = 1_000_000


@dataclass(frozen=True, slots=True)
class Look:
    """The look of a site. `pictures` are the files of its logo and icon, by path in the site."""

    settings: SiteSettings = field(default_factory=SiteSettings)
    pictures: Mapping[str, bytes] = field(default_factory=dict)

    @property
    def logo(self) -> str:
        """The path of the picture beside the title, below the root of the site; "" for none."""
        return _place(self.settings.logo or self.settings.icon)

    @property
    def icon(self) -> str:
        """The path of the icon of all pages, likewise."""
        return _place(self.settings.icon or self.settings.logo)

    @property
    def style(self) -> str:
        """What the style sheet of every page has at its end."""
        accents = self._accents
        return accent_style(accents["light"], accents["dark"]) if accents else ""

    @property
    def accent(self) -> str:
        """The accent of the light theme; "" for that of all sites."""
        return self._accents.get("light", "")

    @property
    def _accents(self) -> dict[Theme, str]:
        light, dark = self.settings.accent, self.settings.accent_dark
        if not light and not dark:
            return {}
        return {
            "light": light or readable(dark, "light"),
            "dark": dark or readable(light, "dark"),
        }

    def edit_address(self, path: str) -> str:
        """Return the address where a file of the project is edited; "" if none is set."""
        return self.settings.edit.replace(PATH, quote(path))


def read_look(docs: Path) -> Look:
    """Read the settings of a folder of guides, if it has some, and the pictures that they name.

    Raises Unusable with what is wrong in them, each with its place.
    """
    file = docs / SITE_FILE
    if not file.is_file():
        return Look()
    source = read_source(file)
    settings, tree = load_settings(source)
    findings = [*_unreadable(settings, tree), *_lost(settings, tree, docs)]
    if findings:
        raise refused(source, findings)
    names = {name for name in (settings.logo, settings.icon) if name}
    return Look(settings, {_place(name): (docs / name).read_bytes() for name in names})


def _unreadable(settings: SiteSettings, tree: Tree) -> Iterator[Finding]:
    """Yield the colours that cannot be read in their theme, each with the nearest that can."""
    themes: tuple[tuple[str, str, Theme], ...] = (
        ("accent", settings.accent, "light"),
        ("accent_dark", settings.accent_dark, "dark"),
    )
    for key, colour, theme in themes:
        ratio = worst_contrast(colour, theme) if colour else BOUND
        if ratio < BOUND:
            # Rounded down: a ratio below the bound shall not read like the bound.
            what = (
                f"`{colour}` has a contrast of {int(100 * ratio) / 100:.2f} with the backgrounds "
                f"of the {theme} theme, and words need {BOUND}"
            )
            way = "darker" if theme == "light" else "lighter"
            hint = f'the nearest {way} shade that can be read is "{readable(colour, theme)}"'
            yield Finding("site-contrast", tree.value_at((key,)), key, what, hint)


def _lost(settings: SiteSettings, tree: Tree, docs: Path) -> Iterator[Finding]:
    """Yield the pictures that cannot be part of the site."""
    for key, name in (("logo", settings.logo), ("icon", settings.icon)):
        what, hint = _fault(name, docs) if name else ("", "")
        if what:
            yield Finding("site-picture", tree.value_at((key,)), key, what, hint)


def _fault(name: str, docs: Path) -> tuple[str, str]:
    """Return what is wrong with the name of a picture, and the way out."""
    below = f"its path is that below {GUIDES}/, such as images/logo.svg"
    path = PurePosixPath(name)
    if re.search(r"[\\:]", name) or any(
        not step or step.startswith(".") for step in name.split("/")
    ):
        return f"`{name}` is no path below {GUIDES}/ with / between folders, or is hidden", below
    if path.suffix.lower() not in _KINDS:
        return f"`{name}` is no picture that browsers show", f"they show {', '.join(_KINDS)}"
    try:
        real = (docs / name).resolve()
        size = real.stat().st_size if real.is_file() else -1
    except (OSError, ValueError):
        size = -1
    if size < 0 or not real.is_relative_to(docs.resolve().parent):
        return f"there is no file {GUIDES}/{name}", below
    large = f"{GUIDES}/{name} has {size / 1e6:.1f} MB"
    return (large, "every page shows it: at most 1 MB") if size > _MAX_BYTES else ("", "")


def _place(name: str) -> str:
    """Return where a picture lies in the site, by its path below the guides."""
    if not name:
        return ""
    path = str(PurePosixPath(name))
    return path if path.startswith(f"{PICTURES}/") else f"{FOLDER}/{GUIDES}/{path}"
