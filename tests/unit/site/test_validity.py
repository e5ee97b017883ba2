"""Pages are valid HTML, according to html-validate; tests/world/test_validity.py has them all."""

from pathlib import Path

from tests.unit.site.reference import reference
from tests.unit.site.validity import complaints, needs_validator

KINDS = ["index.html", "decoder.html", "stream.html", "spec.html", "messages/VentsOpen.html"]


@needs_validator
def test_a_page_of_each_kind_is_valid_and_a_broken_one_is_not(tmp_path: Path) -> None:
    site = reference("greenhouse").pages
    pages = {path: site[path].text for path in KINDS}
    broken = pages["index.html"].replace("</table>", "", 1)
    said = complaints(tmp_path, {**pages, "broken.html": broken})
    assert {each.partition(":")[0] for each in said} == {"broken.html"}
