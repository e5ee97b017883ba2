"""The live fields on the pages of messages, in a real browser: used, and looked at after use."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from framegen.cli import main
from playwright.sync_api import Browser, Locator
from playwright.sync_api import Page as Tab

from tests.factories import BUSSERVO, compiled_file, vectors_of
from tests.protocols.specs import FILES
from tests.unit.site import looks
from tests.unit.site.browser import Visit, needs_chromium, site_on_disk, texts
from tests.unit.site.reference import reference
from tests.world.conftest import visiting

SERVO_MOVE = "messages/ServoMove.html"
MESSAGES = [f"messages/{name}.html" for name in reference("busservo").model.messages]

pytestmark = needs_chromium


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return site_on_disk(tmp_path_factory.mktemp("live"))


@pytest.fixture
def visit(browser: Browser, folder: Path) -> Iterator[Visit]:
    with visiting(browser, folder, viewport={"width": 380, "height": 800}) as visit:
        yield visit


def hex_of(tab: Tab) -> str:
    return tab.locator("#live-hex").input_value()


def field(tab: Tab, label: str) -> Locator:
    return tab.locator(f"#live-fields input[name={label}]")


def status_of(tab: Tab) -> str:
    return " ".join(tab.locator("#live-status").inner_text().split())


def shown(tab: Tab) -> list[str]:
    return texts(tab.locator("#live-strip .bytes"))


def test_bytes_follow_the_fields(visit: Visit) -> None:
    tab = visit.open(SERVO_MOVE)
    assert hex_of(tab) == "55 55 08 03 01 E8 03 01 20 03"
    field(tab, "time_ms").fill("800")
    field(tab, "position").fill("0x1F4")
    assert hex_of(tab) == "55 55 08 03 01 20 03 01 F4 01"
    assert shown(tab) == ["55 55", "08", "03", "01", "20 03", "01", "F4 01"]
    assert status_of(tab) == "ServoMove, host to controller: 10 bytes."
    assert "hex=5555080301200301F401" in (tab.locator("#live-open").get_attribute("href") or "")


def test_fields_follow_the_bytes(visit: Visit) -> None:
    tab = visit.open(SERVO_MOVE)
    hex_of_c = "0x55,0x55,0x0B,0x03,0x02,0x20,0x03,0x02,0x20,0x03,0x09,0x21,0x03"
    tab.locator("#live-hex").fill(hex_of_c)
    assert field(tab, "time_ms").input_value() == "800"
    found = [each.input_value() for each in field(tab, "position").all()]
    assert found == ["800", "801"]


def test_items_are_added_and_taken_out_by_keyboard_alone(visit: Visit) -> None:
    tab = visit.open(SERVO_MOVE)
    add = tab.get_by_role("button", name="Add an item")
    assert tab.get_by_role("button", name="Remove item 1 of targets").is_disabled()
    add.focus()
    tab.keyboard.press("Enter")
    # The new item is at hand, with the values of the one before it.
    tab.keyboard.press("ControlOrMeta+A")
    tab.keyboard.type("7")
    assert hex_of(tab) == "55 55 0B 03 02 E8 03 01 20 03 07 20 03"
    tab.get_by_role("button", name="Remove item 1 of targets").focus()
    tab.keyboard.press("Enter")
    assert hex_of(tab) == "55 55 08 03 01 E8 03 07 20 03"
    assert tab.evaluate(
        "document.activeElement.closest('.items li') !== null || "
        "document.activeElement.textContent === 'Add an item'"
    )


def test_named_values_are_chosen_and_said(visit: Visit) -> None:
    tab = visit.open("messages/ActionGroupRun.html")
    choice = tab.get_by_label("times by name")
    choice.select_option("unlimited")
    assert hex_of(tab).endswith(" 00 00")
    field(tab, "times").fill("3")
    assert choice.input_value() == ""
    field(tab, "times").fill("unlimited")
    assert hex_of(tab).endswith(" 00 00")
    assert choice.input_value() == "unlimited"
    assert texts(tab.locator(".in-words"))[-1] == "0 (unlimited)"


@pytest.mark.parametrize(
    ("label", "text", "why"),
    [
        ("time_ms", "70000", "70000 is outside 0..65535"),
        ("position", "-1", "-1 is outside 0..65535"),
        ("position", "1:2:3", "“1:2:3” is no number: write it like 12 or 0x0C"),
        ("servo_id", "", "a number is missing: write it like 12 or 0x0C"),
    ],
)
def test_what_no_frame_can_carry_is_refused_at_its_place(
    visit: Visit, label: str, text: str, why: str
) -> None:
    tab = visit.open(SERVO_MOVE)
    wrong = field(tab, label)
    wrong.fill(text)
    assert wrong.get_attribute("aria-invalid") == "true"
    described = (wrong.get_attribute("aria-describedby") or "").split()[0]
    assert tab.locator(f"#{described}").inner_text() == why
    assert status_of(tab).startswith("No frame: ")
    assert tab.locator("#live-copy").is_disabled()
    assert not tab.locator("#live-strip").is_visible()
    wrong.fill("7")
    assert wrong.get_attribute("aria-invalid") == "false"
    assert tab.locator("#live-strip").is_visible()


def test_bytes_that_are_no_such_frame_are_refused_with_what_would_be_one(visit: Visit) -> None:
    tab = visit.open(SERVO_MOVE)
    tab.locator("#live-hex").fill("55 55 09 03 01 E8 03 01 20 03")
    assert status_of(tab).startswith(
        "Not ServoMove: length mismatch at byte 2, ServoMove has a length of 8, 11, 14 .. 254, "
        "not 9. 10 bytes have a length of 8; with that they are ServoMove"
    )
    tab.get_by_role("button", name="Take this frame").click()
    assert hex_of(tab) == "55 55 08 03 01 E8 03 01 20 03"
    for text, why in (
        ("55 55 02 07", "Not ServoMove: byte 3 is the id of another message, or of none."),
        ("55 5G", "“G” in “5G” is no hex digit"),
        ("", "Type the bytes of a frame, or change a field."),
    ):
        tab.locator("#live-hex").fill(text)
        assert status_of(tab) == why
        assert tab.locator("#live-hex").get_attribute("aria-invalid") == "true"


def test_a_frame_is_kept_while_browsing_and_opened_from_an_address(visit: Visit) -> None:
    tab = visit.open(SERVO_MOVE)
    field(tab, "time_ms").fill("800")
    tab.locator("nav.sidebar a", has_text="ActionGroupStop").first.evaluate("link => link.click()")
    tab.wait_for_url("**/ActionGroupStop.html*")
    tab = visit.open(SERVO_MOVE)
    assert field(tab, "time_ms").input_value() == "800"
    tab.get_by_role("button", name="Start again").click()
    assert hex_of(tab) == "55 55 08 03 01 E8 03 01 20 03"
    tab = visit.open(SERVO_MOVE)
    assert field(tab, "time_ms").input_value() == "1000"
    tab = visit.open(f"{SERVO_MOVE}?frame=5555080301200301F401")
    assert field(tab, "time_ms").input_value() == "800"
    tab = visit.open(f"{SERVO_MOVE}?frame=<script>alert(1)</script>")
    assert "is no hex digit" in status_of(tab)


@pytest.mark.parametrize("path", MESSAGES)
def test_every_message_begins_with_a_frame_and_keeps_its_place(visit: Visit, path: str) -> None:
    tab = visit.open(path)
    assert status_of(tab).endswith(("byte.", "bytes."))
    for each in tab.locator("#live-fields input").all():
        each.fill("9" * 40)
    for width in looks.WIDTHS:
        tab.set_viewport_size({"width": width, "height": 900})
        assert looks.faults(tab) == [], width


def test_without_a_script_there_are_no_fields(unscripted: Visit) -> None:
    assert not unscripted.open(SERVO_MOVE).locator(".live").is_visible()


# Puts a frame into the page, and takes what its fields make of it.
ROUND_TRIP = """(frame) => {
  const hex = document.getElementById("live-hex");
  const tell = (element) => element.dispatchEvent(new Event("input", { bubbles: true }));
  hex.value = frame;
  tell(hex);
  const field = document.querySelector("#live-fields input");
  const read = document.getElementById("live-status").textContent;
  hex.value = "";
  if (field) tell(field);
  else hex.value = frame;
  return [read, hex.value];
}"""


@pytest.mark.parametrize("name", ["busservo", "everything", "mavlink1", "lxservo"])
def test_fields_make_the_frame_that_they_were_read_from(
    browser: Browser, tmp_path: Path, name: str
) -> None:
    spec = {**FILES, "busservo": BUSSERVO}[name]
    assert main(["docs", str(spec), "--out", str(tmp_path)]) == 0
    compiled = compiled_file(spec)
    frames: dict[str, list[str]] = {}
    for case in vectors_of(compiled)["valid"]:
        frames.setdefault(case["message"], []).append(case["hex"])
    with visiting(browser, tmp_path / "reference" / compiled.spec.protocol.name) as visit:
        for message, cases in frames.items():
            tab = visit.open(f"messages/{message}.html")
            for case in cases:
                read, made = tab.evaluate(ROUND_TRIP, case)
                assert read.startswith(f"{message}, "), (read, case)
                assert made == case, message
