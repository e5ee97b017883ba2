"""Take the pictures of the site that the README shows.

    python -m tests.screenshots

builds the site and writes them to docs/images. Take them again when the pages look different.
"""

import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from framegen.cli import main
from playwright.sync_api import Browser

from tests.documents import ROOT
from tests.unit.site.browser import launched

IMAGES = ROOT / "docs" / "images"
# A README with larger ones is slow to load.
LARGEST = 150_000


@dataclass(frozen=True)
class Screenshot:
    """A picture of a page from its top or an anchor on: its name, and how the page is looked at."""

    name: str
    address: str
    width: int
    height: int
    scheme: Literal["light", "dark"] = "light"


# A frame and a stray byte, so that noise is seen.
BYTES = "55%2055%2004%200F%204C%201D%2013"
SCREENSHOTS = [
    Screenshot(
        "reference-message.png", "reference/busservo/messages/ServoMove.html#try", 1200, 760
    ),
    Screenshot(
        "reference-decoder.png",
        f"reference/busservo/decoder.html?hex={BYTES}&direction=controller_to_host",
        *(1000, 1040),
        scheme="dark",
    ),
    Screenshot("reference-phone.png", "reference/busservo/messages/BatteryVoltage.html", 390, 720),
]


def take(browser: Browser, site: Path, each: Screenshot) -> bytes:
    """Return a screenshot as PNG."""
    context = browser.new_context(
        viewport={"width": each.width, "height": each.height},
        color_scheme=each.scheme,
        reduced_motion="reduce",
    )
    tab = context.new_page()
    tab.goto(site.as_uri() + "/" + each.address)
    tab.wait_for_timeout(500)  # for what a script does when the page is there
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
