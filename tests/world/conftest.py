"""A browser for the tests of one file, and visits to the pages in its `folder`."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, BrowserContext

from tests.unit.site.browser import Visit, launched, project_on_disk


@pytest.fixture(scope="session")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the site of this project, as `make docs` builds it; some files have another."""
    return project_on_disk(tmp_path_factory.mktemp("a stick") / "the site")


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


@pytest.fixture
def unscripted(browser: Browser, folder: Path) -> Iterator[Visit]:
    """Yield such a visit in a browser that runs no script."""
    with visiting(browser, folder, java_script_enabled=False) as visit:
        yield visit


@contextmanager
def visiting(browser: Browser, folder: Path, script: str = "", **settings: Any) -> Iterator[Visit]:
    """Yield such a visit with these settings; a script runs before those of any page."""
    context = browser.new_context(**settings)
    if script:
        context.add_init_script(script)
    visit = Visit(context, folder)
    yield visit
    visit.end()
    context.close()
