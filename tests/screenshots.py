"""Take the pictures of the site that the README shows.

    python -m tests.screenshots

builds the site and writes them to docs/images. Take them again when the pages look different.
"""

from __future__ import annotations

import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from framegen.cli import main

from tests.docs.browser import launched
from tests.documents import ROOT

if TYPE_CHECKING:
    from playwright.sync_api import Browser

IMAGES = ROOT / "docs" / "images"
# A README with larger ones is slow to load.
LARGEST = 150_000


@dataclass(frozen=True)
class Screenshot:
    """A picture of the top of a page: the name of the picture, and how the page is looked at."""

    name: str
    address: str
    width: int
    height: int
    scheme: Literal["light", "dark"] = "light"


# One frame and a stray byte, so that noise is seen.
BYTES = "13%2055%2055%2004%200F%204C%201D"
SCREENSHOTS = [
    Screenshot("reference-message.png", "reference/busservo/messages/ServoMove.html", 1280, 800),
    Screenshot(
        "reference-decoder.png",
        f"reference/busservo/decoder.html?hex={BYTES}&direction=controller_to_host",
        *(1000, 940),
        scheme="dark",
    ),
    Screenshot("reference-phone.png", "reference/busservo/messages/BatteryVoltage.html", 390, 720),
]


def take(browser: Browser, site: Path, each: Screenshot) -> bytes:
    """Return a screenshot as PNG."""
    size = {"width": each.width, "height": each.height}
    context = browser.new_context(viewport=size, color_scheme=each.scheme)  # type: ignore[arg-type]
    tab = context.new_page()
    page, mark, rest = each.address.partition("?")
    tab.goto((site / page).as_uri() + mark + rest)
    picture = tab.screenshot()
    context.close()
    return picture


def write() -> int:
    """Write all pictures; return how many are too large."""
    too_large = 0
    with tempfile.TemporaryDirectory() as folder, launched() as browser:
        site = Path(folder, "site")
        assert main(["docs", "--out", str(site)]) == 0
        for each in SCREENSHOTS:
            picture = take(browser, site, each)
            (IMAGES / each.name).write_bytes(picture)
            print(f"{each.name}: {len(picture)} bytes")
            too_large += len(picture) > LARGEST
    return too_large


if __name__ == "__main__":
    sys.exit(write())
