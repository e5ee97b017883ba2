"""A browser for the tests of one file, and visits to the pages in its `folder`."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from tests.unit.site.browser import Visit, launched

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from playwright.sync_api import Browser, BrowserContext


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    with launched() as running:
        yield running


@pytest.fixture(scope="module")
def context(browser: Browser) -> Iterator[BrowserContext]:
    context = browser.new_context(permissions=["clipboard-read", "clipboard-write"])
    yield context
    context.close()


@pytest.fixture
def visit(context: BrowserContext, folder: Path) -> Iterator[Visit]:
    """Yield a visit on which no error may happen, and only pages on the disk be requested."""
    visit = Visit(context, folder)
    yield visit
    visit.end()
