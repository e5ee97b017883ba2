"""A browser for tests of the pages: headless Chromium, from the disk, with no network."""

import os
import re
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from framegen.cli import main
from playwright.sync_api import Browser, BrowserContext, Locator, sync_playwright
from playwright.sync_api import Page as Tab

from tests.timeouts import GENEROUS
from tests.unit.site.reference import ROOT, SPECS

CHROMIUM = os.environ.get("CHROMIUM") or shutil.which("chromium")
ARGUMENTS = [
    *("--no-sandbox", "--disable-gpu", "--disable-background-networking", "--no-first-run"),
    *("--disable-component-update", "--disable-sync"),
]
# How long a browser may take for anything.
MILLISECONDS = 1000 * GENEROUS

needs_chromium = pytest.mark.skipif(CHROMIUM is None, reason="chromium is not installed")


@contextmanager
def launched() -> Iterator[Browser]:
    """Start a browser."""
    with sync_playwright() as started:
        running = started.chromium.launch(
            executable_path=CHROMIUM, args=ARGUMENTS, timeout=MILLISECONDS
        )
        yield running
        running.close()


def site_on_disk(root: Path) -> Path:
    """Build the reference below `root`, as `framegen docs` does, and return its folder."""
    assert main(["docs", str(SPECS["busservo"]), "--out", str(root)]) == 0
    return root / "reference" / "busservo"


def project_on_disk(folder: Path, *options: str) -> Path:
    """Build the site of this project in a folder, as `make docs` does, and return the folder."""
    with pytest.MonkeyPatch.context() as patched:
        patched.chdir(ROOT)
        assert main(["docs", "--out", str(folder), *options]) == 0
    return folder


class Visit:
    """One tab that opens pages from the disk, and records errors on them."""

    def __init__(self, context: BrowserContext, folder: Path) -> None:
        self.folder = folder
        self.troubles: list[str] = []
        self.requests: list[str] = []
        self.tab: Tab = context.new_page()
        self.tab.set_default_timeout(MILLISECONDS)
        self.tab.on("console", lambda message: self.troubles.append(message.text))
        self.tab.on("pageerror", lambda error: self.troubles.append(str(error)))
        self.tab.on("request", lambda request: self.requests.append(request.url))

    def open(self, path: str) -> Tab:
        name, mark, rest = path.partition("?")
        self.tab.goto((self.folder / name).as_uri() + mark + rest)
        return self.tab

    def style(self, selector: str, name: str) -> str:
        script = "([selector, name]) => getComputedStyle(document.querySelector(selector))[name]"
        return str(self.tab.evaluate(script, [selector, name]))

    def end(self) -> None:
        """Close the tab; fail if it had errors, or opened anything but pages from the disk."""
        self.tab.close()
        assert self.troubles == []
        here = self.folder.parent.as_uri()
        assert [each for each in self.requests if not each.startswith(here)] == []


def arrives(tab: Tab, end: str) -> None:
    """Wait for an address with this end: a key or a click only starts the navigation."""
    tab.wait_for_url(re.compile(re.escape(end) + "$"))


def texts(found: Locator) -> list[str]:
    return [text.strip() for text in found.all_inner_texts()]


def decoded(tab: Tab) -> list[str]:
    """Return what the list of the workbench shows: names of messages, and reasons of noise."""
    rows = tab.locator("#events [role=option]")
    names = texts(rows.locator(".what b"))
    kinds = [str(row.get_attribute("class")).split()[-1] for row in rows.all()]
    both = zip(kinds, names, strict=True)
    return [name if kind == "message" else f"{kind}: {name}" for kind, name in both]
