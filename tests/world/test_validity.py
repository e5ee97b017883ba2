"""Every page is valid HTML, according to html-validate."""

from pathlib import Path

import pytest

from tests.unit.site.reference import SPECS, reference
from tests.unit.site.test_hostile_pages import hostile
from tests.unit.site.validity import complaints, needs_validator

pytestmark = needs_validator


@pytest.mark.parametrize("name", SPECS)
def test_every_page_is_valid(name: str, tmp_path: Path) -> None:
    pages = {path: page.text for path, page in reference(name).pages.items()}
    assert complaints(tmp_path, pages) == []


def test_every_page_of_a_hostile_spec_is_valid(tmp_path: Path) -> None:
    site = hostile()
    pages = {path: page.text for path, page in site.pages.items() if "ServoMove" in path}
    pages |= {path: site.pages[path].text for path in ("index.html", "errata.html", "decoder.html")}
    assert complaints(tmp_path, pages) == []
