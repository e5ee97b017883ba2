"""The workbench in a real browser: what it shows of bytes, and what its encoder offers."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.cli import main
from framegen.language.values import to_hex
from framegen.model.codec import encode

from tests.protocols.specs import FILES, messages_of
from tests.unit.site import looks
from tests.unit.site.browser import Visit, decoded, launched, needs_chromium, site_on_disk, texts

if TYPE_CHECKING:
    from pathlib import Path


@needs_chromium
def test_the_workbench_shows_frames_noise_and_unknown_frames(tmp_path: Path) -> None:
    folder = site_on_disk(tmp_path / "the reference")
    with launched() as browser:
        visit = Visit(browser.new_context(), folder)
        tab = visit.open("decoder.html")
        tab.get_by_label("A capture").fill(
            "00 55 55 08 03 01 E8 03 01 20 03 55 55 03 63 01 55 55 02"
        )
        assert decoded(tab) == [
            "noise: bad header",
            "ServoMove",
            "unknown: unknown command",
            "noise: too short",
        ]
        tab.locator("#events [role=option]").nth(1).click()
        cells = texts(tab.locator("#event .strip li"))
        assert [" ".join(cell.split()) for cell in cells][4:6] == [
            "6 E8 03 time_ms 1000 ms low byte first",
            "8 01 targets[0].servo_id 1",
        ]
        # After use, nothing is cut off, covered, out of reach, or printed in vain.
        tab.get_by_label("A capture").fill("55 55 03 63 01 " + "A5 " * 200)
        tab.locator("#events [role=option]").last.click()
        assert looks.faults_at_widths(tab) == []
        assert looks.faults_on_paper(tab) == []
        visit.end()


@needs_chromium
def test_what_the_encoder_offers_is_the_first_example_of_each_message(tmp_path: Path) -> None:
    spec = FILES["everything"]
    assert main(["docs", str(spec), "--out", str(tmp_path)]) == 0
    with launched() as browser:
        visit = Visit(browser.new_context(), tmp_path / "reference" / "everything")
        tab = visit.open("decoder.html")
        for name, layout in messages_of("everything").items():
            example = layout.message.examples[0]
            tab.get_by_label("Message").select_option(name)
            assert tab.locator("#encoded").inner_text() == to_hex(encode(layout, example.values)), (
                name
            )
            tab.get_by_label("A capture").fill(to_hex(example.hex))
            assert any(name in each.split(" or ") for each in decoded(tab))
        visit.end()
